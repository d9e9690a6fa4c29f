"""The ledger judged: every row against what the workflow found."""

import json
from pathlib import Path
from typing import Any

from ledger import finding_of, read_ledger

from replication.workbench import run
from topheavy.claims import judge


def main(ledger: list[dict], findings: dict[str, dict]) -> list[dict]:
    rows = []
    for claim in ledger:
        finding = finding_of(claim, findings.get(claim.get("rule"), {}))
        verdict = judge(claim, finding)
        found = finding or {}
        rows.append(
            {
                "id": claim["id"],
                "study": claim["study"],
                "where": claim["where"],
                "equation": claim.get("equation"),
                "statement": claim["statement"],
                "printed": claim.get("printed"),
                "computed": found.get("value", found.get("holds")),
                "meant": found.get("meant_value"),
                "error": found.get("error"),
                "unit": claim.get("unit", ""),
                "tolerance": claim.get("tolerance"),
                "verdict": verdict,
                "expected": claim["expected"],
                "not_tested": found.get("not_tested", ""),
                "remark": found.get("not_tested", claim.get("remark", "")),
                "function": claim.get("function", ""),
                "rule": claim.get("rule", ""),
            }
        )
        print(f"{claim['id']}: {verdict} (expected {claim['expected']})")
    return rows


def work(job: Any) -> None:
    findings = {
        Path(path).stem: json.loads(Path(path).read_text(encoding="utf-8"))
        for path in job.input.findings
    }
    rows = main(read_ledger(job.input.ledger), findings)
    text = json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False)
    Path(job.output[0]).write_text(text + "\n", encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, work)
