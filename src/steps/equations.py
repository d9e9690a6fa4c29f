"""Every equation of the paper, as printed, put to the test of its own premises."""

from dataclasses import asdict

import pandas as pd
from workbench import log_to, truth, write_findings, write_table

from topheavy.derivation import check_printed, theorems


def main() -> tuple[pd.DataFrame, dict]:
    checks = check_printed()
    findings = {check.id: truth(check.follows, meant_holds=check.meant_follows) for check in checks}
    findings |= {theorem.id: truth(theorem.holds) for theorem in theorems()}
    return pd.DataFrame([asdict(check) for check in checks]), findings


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        table, findings = main()
        write_table(snakemake.output.table, table)
        write_findings(snakemake.output.findings, findings)
