"""Is a heavier cap always more stable? The half of the study about ground motions."""

MOTIONS = settings("motions_ensemble", "reversals")


UPLIFT = settings("motions_uplift", "reversals")
VASE = settings("motions_vase", "reversals")

# The second solver, SciPy, on samples: no row says so, and the run fails without.
CHECKS |= {
    "reversals_records": ["second_route"],
    "reversals_uplift": ["uplift_second_route"],
    "reversals_vase": ["vase_second_route"],
}


scattergather:
    reversals_sweep=MOTIONS["runs"][MOTIONS["run"]]["shards"],


# All that the steps ask of the motions, in one sweep.
rule reversals_sweep_shard:
    output:
        "results/shards/reversals_{scatteritem}.npz",
    params:
        asked={
            "motions": MOTIONS,
            "structures": named(config["structures"], MOTIONS),
            "vase": VASE,
        },
    script:
        "steps/motions_sweep.py"


SWEPT = gather.reversals_sweep("results/shards/reversals_{scatteritem}.npz")


rule reversals_records:
    input:
        records=record_paths(
            settings("motions_records", "reversals")["records"], RECORDS
        ),
    output:
        table="results/tables/reversals_records.csv",
        counts="results/tables/reversals_by_record.csv",
        findings="results/findings/reversals_records.json",
    params:
        settings=settings("motions_records", "reversals"),
        solver=config["solver"],
    script:
        "steps/motions_records.py"


rule reversals_motions:
    input:
        shards=SWEPT,
    output:
        fragility="results/tables/reversals_fragility.csv",
        pairs="results/tables/reversals_pairs.csv",
        medians="results/tables/reversals_medians.csv",
        findings="results/findings/reversals_motions.json",
    params:
        settings=MOTIONS,
        structures=named(config["structures"], MOTIONS),
    script:
        "steps/motions_fragility.py"


rule reversals_check:
    input:
        shards=SWEPT,
    output:
        table="results/tables/reversals_sample.csv",
        findings="results/findings/reversals_check.json",
    params:
        settings=MOTIONS,
        structures=named(config["structures"], MOTIONS),
        solver=config["solver"],
    script:
        "steps/motions_check.py"


rule reversals_vase:
    input:
        shards=SWEPT,
    output:
        fragility="results/tables/reversals_vase.csv",
        ranks="results/tables/reversals_vase_ranks.csv",
        findings="results/findings/reversals_vase.json",
    params:
        settings=VASE,
        ensemble=MOTIONS,
    script:
        "steps/motions_vase.py"


rule reversals_uplift:
    output:
        table="results/tables/reversals_uplift.csv",
        findings="results/findings/reversals_uplift.json",
    params:
        settings=UPLIFT,
        ensemble=MOTIONS,
    script:
        "steps/motions_uplift.py"
