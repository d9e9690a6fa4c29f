"""What the run cost: wall time and memory of every rule, from Snakemake's benchmarks and the logs.

A benchmark has no memory of a job that is a fork.
"""

from pathlib import Path

import pandas as pd

from replication.workbench import PEAK, run


def main(benchmarks: list[Path], logs: Path) -> pd.DataFrame:
    rows = []
    for path in benchmarks:
        try:
            log = (logs / f"{path.stem}.log").read_text(encoding="utf-8")
        except FileNotFoundError:
            continue  # this job has just begun anew: Snakemake removes its log, not its benchmark
        _, found, peak = log.rpartition(PEAK)
        if found:  # else a rule that is no more has left its files
            seconds = pd.read_csv(path, sep="\t").iloc[-1]["s"]
            memory = float(peak.split()[0])
            rows.append({"rule": path.stem, "seconds": seconds, "memory_mb": memory})
    return pd.DataFrame(rows).sort_values("seconds", ascending=False)


def work(job) -> pd.DataFrame:
    results = Path("results")
    return main(sorted(results.glob("benchmarks/*.tsv")), results / "logs").round(1)


if __name__ == "__main__":
    run(snakemake, work)
