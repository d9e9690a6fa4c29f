"""How the cost of the study `reversals` grows: motions, lines of its grid, shards, the gather.

Sizes a factor of ten apart, each in a process of its own, by hand (a quarter of an hour on a
core). It writes docs/scale.csv, from which profiles/slurm/README.md extrapolates.
"""

import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from replication.inputs.strict_yaml import read_yaml
from replication.kill.tree_copy import copy_tree

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT))  # for the studies
SEED = 18
SHARDS = (10, 100, 1000, 10000)


def config() -> tuple[dict, dict]:
    """Return the study's config and the structures."""
    study = read_yaml(ROOT / "studies/reversals/config.yaml")
    return study, read_yaml(ROOT / "config/config.yaml")["structures"]


def motions(part: int) -> tuple[int, int]:
    """Compute one of `part` shards of the ensemble; return its motions and its histories."""
    from steps.shared.sweep import sweep
    from studies.reversals.under import frames_and_columns

    study, structures = config()
    asked = frames_and_columns(study["motions_ensemble"], structures)
    found = sweep(asked, study["motions_ensemble"], f"1-of-{part}")
    outcomes = [of for name, of in found.items() if name.endswith("outcomes")]
    return max(map(len, outcomes)), sum(of.size for of in outcomes)


def grid(part: int) -> tuple[int, int]:
    """Compute one of `part` shards of the spectra; return its lines and its least histories."""
    from steps.shared.spectrum import solve
    from studies.reversals.steps.pulses_shard import lines

    settings = config()[0]["pulses"]
    settings |= settings["grids"][settings["grid"]]
    mine, reach = lines(settings, f"1-of-{part}"), settings["amplitudes"]
    solve(mine, settings)
    steps = (reach["highest"] - reach["lowest"]) / reach["resolution"]
    return len(mine), round(len(mine) * steps)


def gather(number: int) -> tuple[int, int]:
    """Read random outcomes of so many motions of each scenario; return motions and histories.

    The motions overturn at lognormal intensities.
    """
    from steps.shared.sweep import Swept
    from studies.reversals.steps.motions_fragility import main
    from studies.reversals.under import frames_and_columns, intensities
    from topheavy.synthetic.ensemble import first_draws

    study, structures = config()
    settings, random = study["motions_ensemble"], np.random.default_rng(SEED)
    settings["runs"][settings["run"]]["motions"] = number
    answered = {}
    for name, asked in frames_and_columns(settings, structures).items():
        draws = first_draws(settings, asked.motions)
        gammas = [one.labels["mass_ratio"] or one.labels["as_large_as"] for one in asked.subjects]
        capacity = random.normal(0.0, 0.3, (len(draws), 1)) + 0.1 * np.minimum(gammas, 2.0)
        capacity += random.normal(0.0, 0.05, capacity.shape)
        fell = np.log(intensities(settings)) > capacity[..., None]
        answered[name] = Swept(draws, np.ones(len(draws)), fell)
    main(settings, structures, answered)
    return 4 * number, sum(one.outcomes.size for one in answered.values())


def graph(shards: int) -> tuple[int, int]:
    """Let Snakemake plan a run with so many shards of the ensemble; return the shards."""
    with tempfile.TemporaryDirectory() as folder:
        tree = Path(folder, "tree")
        copy_tree(tree)
        over = f"motions_ensemble: {{ runs: {{ default: {{ shards: {shards} }} }} }}\n"
        (tree / "studies/reversals/shards.yaml").write_text(over, encoding="utf-8")
        paper = Path(tree, "config/shards.yaml")
        paper.write_text("studies: [reversals]\n", encoding="utf-8")
        subprocess.run(
            [sys.executable, "-m", "snakemake", "--cores=1", "--dry-run", "--quiet=all"]
            + ["--configfile", str(paper), "--", "results/findings/reversals_motions.json"],
            cwd=tree,
            env=os.environ | {"PYTHONPATH": f"{tree / 'src'}:{tree}"},
            check=True,
            stdout=subprocess.DEVNULL,
        )
    return shards, 0


RUNS = {
    motions: (100, 10, 1),
    grid: (100, 10, 1),
    gather: (50, 500, 5000, 50000),
    graph: SHARDS,
}


def measured(name: str, size: str) -> None:
    """Run one of RUNS in this process, and print its row of the table."""
    start = time.perf_counter()
    number, histories = {run.__name__: run for run in RUNS}[name](int(size))
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    spent = used[name == "graph"]
    print(
        name,
        number,
        histories,
        round(spent.ru_utime + spent.ru_stime, 1),
        round(time.perf_counter() - start, 1),
        round(spent.ru_maxrss / 1024),
        sep=",",
    )


def row(name: str, size: int) -> str:
    """Return the row that a process of its own prints."""
    command = [sys.executable, __file__, name, str(size)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout.splitlines()[-1]


def main() -> None:
    for run in (motions, grid):
        row(run.__name__, RUNS[run][0])  # compiles the kernel
    table = ["what,size,histories,cpu_seconds,seconds,memory_mb"]
    for run, sizes in RUNS.items():
        for size in sizes:
            table.append(row(run.__name__, size))
            print(table[-1], flush=True)
    Path(ROOT, "docs/scale.csv").write_text("\n".join(table) + "\n", encoding="utf-8")


if __name__ == "__main__":
    match sys.argv[1:]:
        case []:
            main()
        case [name, size]:
            measured(name, size)
