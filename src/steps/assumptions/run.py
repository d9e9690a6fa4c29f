"""Replace each open choice by its alternatives, and report changed numbers and verdicts.

Each alternative of paper/assumptions.yaml replaces one of our choices. Every affected quantity is
computed again, at the library's tolerance and at the tightened one. A quantity with a claim is
judged like the claim in the ledger, but from fewer pulses than the rule of the claim uses.
"""

import math
from dataclasses import replace
from functools import cache
from typing import Any

from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim
from replication.judging.ledger import read_ledger
from replication.judging.verdicts import verdict_on
from replication.workbench import run
from steps.assumptions import held, impact, pulses, rankings, trilith
from steps.assumptions.alternatives import alternatives
from steps.assumptions.choices import Choices
from steps.assumptions.quantity import Sections
from topheavy import read_record

UNCLAIMED = Claim(id="", where="", statement="", expected="")
"""In place of the claim of a quantity that has none."""

QUANTITIES = (
    trilith.QUANTITIES
    | pulses.QUANTITIES
    | rankings.QUANTITIES
    | impact.QUANTITIES
    | held.QUANTITIES
)


def main(assumptions: list[dict], ledger: dict[str, Claim], sections: Sections, tightened: float):
    """Return the rows of the table: each quantity, ours and by each alternative that reaches it."""

    @cache
    def answer(name: str, choices: Choices) -> tuple[float, float, str]:
        """Return a quantity's number, an estimate of its error, and its verdict."""
        finer = replace(choices, tolerance=tightened, samples=2 * choices.samples - 1)
        first, again = (QUANTITIES[name].find(option, sections) for option in (choices, finer))
        claim = ledger.get(QUANTITIES[name].claim or "", UNCLAIMED)
        verdict = verdict_on(claim, first.finding)
        if verdict != verdict_on(claim, again.finding):
            raise ArithmeticError(f"{name}, {choices}: the verdict depends on the tolerance")
        told = math.isfinite(first.number) or math.isfinite(again.number)
        return first.number, abs(first.number - again.number) if told else 0.0, verdict

    rows = []
    made = alternatives(sections["assumptions"])
    for assumption in assumptions:
        for alternative in assumption["alternatives"]:
            for name in assumption["reaches"]:
                quantity = QUANTITIES[name]
                ours, error, before = answer(name, Choices())
                other, other_error, after = answer(name, made[assumption["id"]][alternative["id"]])
                claim = ledger.get(quantity.claim or "", UNCLAIMED)
                if claim is not UNCLAIMED and before != claim.expected:
                    raise ArithmeticError(f"{name}: {before}, and {claim.expected} in the ledger")
                rows.append(
                    {
                        "assumption": assumption["id"],
                        "alternative": alternative["id"],
                        "quantity": name,
                        "claim": quantity.claim or "",
                        "unit": quantity.unit,
                        "ours": ours,
                        "with_alternative": other,
                        "error": max(error, other_error),
                        "tolerance": math.nan if claim.tolerance is None else claim.tolerance,
                        "before": before,
                        "after": after,
                        "changed": before != after,
                    }
                )
                print(*rows[-1].values(), sep="; ", flush=True)
    return rows


def work(job: Any) -> list[dict]:
    assumptions = read_yaml(job.input.assumptions)["open"]
    sections = job.params.sections | {"records": [read_record(path) for path in job.input.records]}
    ledger = {claim.id: claim for claim in read_ledger([job.input.ledger])}
    return main(assumptions, ledger, sections, job.params.solver["tightened"])


if __name__ == "__main__":
    run(snakemake, work)
