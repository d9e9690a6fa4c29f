"""Is a heavier cap always more stable? The half about pulses."""

# The grid that is asked for, in place of all that could be.
REVERSALS = case("pulses", "reversals").copy()
REVERSALS |= REVERSALS.pop("grids")[REVERSALS.pop("grid")]

PARTS["reversals"].figures.update(
    {
        "studies/reversals/figures/where": ["reversals_map", "reversals_areas"],
        "studies/reversals/figures/counterexample": ["reversals_histories"],
        "studies/reversals/figures/lowest": ["reversals_spectra"],
        "studies/reversals/figures/why": ["reversals_map", "reversals_why"],
        "studies/reversals/figures/enough": ["reversals_enough"],
    }
)
PARTS["reversals"].findings.extend(["reversals_pulses", "reversals_enough"])


scattergather:
    reversals=REVERSALS["shards"],


rule reversals_shard:
    input:
        code("studies/reversals/steps/pulses_shard.py"),
    output:
        table="results/shards/reversals_{scatteritem}.csv",
    log:
        "results/logs/reversals_shard_{scatteritem}.log",
    benchmark:
        "results/benchmarks/reversals_shard_{scatteritem}.tsv"
    params:
        case=REVERSALS,
    message:
        "Study reversals: spectra of every pair of p̂ and √r, shard {wildcards.scatteritem}"
    script:
        "steps/pulses_shard.py"


rule reversals_pulses:
    input:
        code("studies/reversals/steps/pulses.py"),
        shards=gather.reversals("results/shards/reversals_{scatteritem}.csv"),
    output:
        spectra="results/tables/reversals_spectra.csv",
        areas="results/tables/reversals_areas.csv",
        why="results/tables/reversals_why.csv",
        drawn="results/tables/reversals_map.csv",
        histories="results/tables/reversals_histories.csv",
        findings="results/findings/reversals_pulses.json",
    log:
        "results/logs/reversals_pulses.log",
    benchmark:
        "results/benchmarks/reversals_pulses.tsv"
    params:
        case=REVERSALS | case("reading", "reversals"),
        solver=config["solver"],
    message:
        "Study reversals: where a heavier cap harms, and why"
    script:
        "steps/pulses.py"


rule reversals_enough:
    input:
        code("studies/reversals/steps/enough.py"),
        spectra="results/tables/reversals_spectra.csv",
    output:
        table="results/tables/reversals_enough.csv",
        findings="results/findings/reversals_enough.json",
    log:
        "results/logs/reversals_enough.log",
    benchmark:
        "results/benchmarks/reversals_enough.tsv"
    params:
        case=REVERSALS | case("enough", "reversals"),
    message:
        "Study reversals: how heavy a cap is enough"
    script:
        "steps/enough.py"


# The half about ground motions.
include: "motions.smk"
