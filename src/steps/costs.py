"""What the run cost: wall time and memory of every rule, from Snakemake's benchmark files."""

from pathlib import Path

import pandas as pd
from workbench import log_to, write_table


def main(benchmarks: list[Path]) -> pd.DataFrame:
    rows = [
        {
            "rule": path.stem,
            "seconds": (measured := pd.read_csv(path, sep="\t").iloc[-1])["s"],
            "memory_mb": measured["max_rss"],
        }
        for path in benchmarks
    ]
    return pd.DataFrame(rows).sort_values("seconds", ascending=False)


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        table = main(sorted(Path("results/benchmarks").glob("*.tsv")))
        write_table(snakemake.output[0], table.round(1))
