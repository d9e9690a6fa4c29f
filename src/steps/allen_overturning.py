"""Find the pulses for which the model of Allen et al. (1986) gives the wrong outcome."""

import math

import pandas as pd

from replication.workbench import Finding, grid, run, truth
from topheavy import Column, Pulse, RockingFrame, judge
from topheavy.massless_columns import simplified

OUTCOMES = {
    (False, False): "both survive",
    (True, True): "both overturn",
    (False, True): "falsely overturned",
    (True, False): "falsely safe",
}


def main(settings: dict) -> tuple[pd.DataFrame, dict]:
    alpha = math.radians(settings["slenderness"])
    frame = RockingFrame(Column(math.sin(alpha), math.cos(alpha)), settings["mass_ratio"])
    p = frame.column.frequency_parameter
    models = {name: simplified(frame, name) for name in ("linearised", "all")}
    rows = []
    for omega in grid(settings["frequency_ratios"]):
        for amplitude in grid(settings["amplitudes"]):
            pulse = Pulse(settings["shape"], amplitude * frame.uplift_acceleration, omega * p)
            exact = judge(frame, pulse).overturned
            rows += [
                {
                    "model": name,
                    "frequency_ratio": omega,
                    "amplitude_over_uplift": amplitude,
                    "verdict": OUTCOMES[exact, judge(block, pulse).overturned],
                }
                for name, block in models.items()
            ]
    table = pd.DataFrame(rows)
    return table, findings(table)


def findings(allen_overturning: pd.DataFrame) -> dict[str, Finding]:
    """Return the share of the pulses with each outcome, from the table of outcomes."""
    shares = allen_overturning.groupby("model").verdict.value_counts(normalize=True)
    return {
        name: truth(True, **{word.replace(" ", "_"): share for word, share in shares[name].items()})
        for name in allen_overturning.model.unique()
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
