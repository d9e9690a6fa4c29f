"""What the run cost: wall time and memory of every rule, from Snakemake's benchmark files."""

from pathlib import Path

import pandas as pd

from replication.workbench import run


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
    run(snakemake, lambda job: main(sorted(Path("results/benchmarks").glob("*.tsv"))).round(1))
