"""Is a heavier cap always more stable? The half about pulses."""

# Of the grids in the config, the one that its key `grid` names.
REVERSALS = settings("pulses", "reversals").copy()
REVERSALS |= REVERSALS.pop("grids")[REVERSALS.pop("grid")]


scattergather:
    reversals=REVERSALS["shards"],


rule reversals_shard:
    output:
        table="results/shards/reversals_{scatteritem}.csv",
    params:
        settings=REVERSALS,
    script:
        "steps/pulses_shard.py"


rule reversals_pulses:
    input:
        shards=gather.reversals("results/shards/reversals_{scatteritem}.csv"),
    output:
        spectra="results/tables/reversals_spectra.csv",
        areas="results/tables/reversals_areas.csv",
        why="results/tables/reversals_why.csv",
        widths="results/tables/reversals_widths.csv",
        drawn="results/tables/reversals_map.csv",
        histories="results/tables/reversals_histories.csv",
        findings="results/findings/reversals_pulses.json",
    params:
        settings=REVERSALS | settings("reading", "reversals"),
        solver=config["solver"],
    script:
        "steps/pulses.py"


rule reversals_proven:
    input:
        spectra="results/tables/reversals_spectra.csv",
    output:
        table="results/tables/reversals_proven.csv",
        certificates="results/certificates/reversals_proven.jsonl",
        findings="results/findings/reversals_proven.json",
    params:
        settings=REVERSALS,
    script:
        "steps/proven.py"


# The half about ground motions.
include: "motions.smk"
