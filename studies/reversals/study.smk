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
    message:
        "Study reversals: spectra of every pair of p̂ and √r, shard {wildcards.scatteritem}"
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
    message:
        "Study reversals: where a heavier cap harms, and why"
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
    message:
        "Study reversals: a reversal of each pair of γ, proven"
    script:
        "steps/proven.py"


rule reversals_enough:
    input:
        spectra="results/tables/reversals_spectra.csv",
    output:
        table="results/tables/reversals_enough.csv",
        findings="results/findings/reversals_enough.json",
    params:
        settings=REVERSALS | settings("enough", "reversals"),
    message:
        "Study reversals: how heavy a cap is enough"
    script:
        "steps/enough.py"


# The half about ground motions.
include: "motions.smk"
