"""The ledger judged: every row against what the workflow found."""

import json
from pathlib import Path

from ledger import finding_of, read_ledger
from workbench import log_to

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


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        ledger = read_ledger(snakemake.input.ledger)
        findings = {
            Path(path).stem: json.loads(Path(path).read_text(encoding="utf-8"))
            for path in snakemake.input.findings
        }
        text = json.dumps(main(ledger, findings), indent=1, ensure_ascii=False, allow_nan=False)
        Path(snakemake.output[0]).write_text(text + "\n", encoding="utf-8")
