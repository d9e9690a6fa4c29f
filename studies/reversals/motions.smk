"""Is a heavier cap always more stable? The half of the study about ground motions."""

MOTIONS = settings("motions_ensemble", "reversals")


UPLIFT = settings("motions_uplift", "reversals").copy()
# No parameter: the rows are the same, however many shards there are.
UPLIFT_SHARDS = UPLIFT.pop("shards")

# The second solver, SciPy, on samples: no row says so, and the run fails without.
CHECKS |= {
    "reversals_records": ["second_route"],
    "reversals_uplift": ["uplift_second_route"],
    "reversals_vase": ["vase_second_route"],
}


scattergather:
    reversals_motions=MOTIONS["runs"][MOTIONS["run"]]["shards"],
    reversals_uplift=UPLIFT_SHARDS,


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


rule reversals_motions_shard:
    output:
        table="results/shards/reversals_motions_{scatteritem}.csv",
    params:
        settings=MOTIONS,
        structures=named(config["structures"], MOTIONS),
    script:
        "steps/motions_shard.py"


rule reversals_motions:
    input:
        shards=gather.reversals_motions(
            "results/shards/reversals_motions_{scatteritem}.csv"
        ),
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
        shards=gather.reversals_motions(
            "results/shards/reversals_motions_{scatteritem}.csv"
        ),
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
    output:
        fragility="results/tables/reversals_vase.csv",
        ranks="results/tables/reversals_vase_ranks.csv",
        findings="results/findings/reversals_vase.json",
    params:
        settings=settings("motions_vase", "reversals"),
        ensemble=MOTIONS,
        solver=config["solver"],
    script:
        "steps/motions_vase.py"


rule reversals_uplift_shard:
    output:
        table="results/shards/reversals_uplift_{scatteritem}.csv",
    params:
        settings=UPLIFT,
        ensemble=MOTIONS,
    script:
        "steps/motions_uplift_shard.py"


rule reversals_uplift:
    input:
        shards=gather.reversals_uplift(
            "results/shards/reversals_uplift_{scatteritem}.csv"
        ),
    output:
        table="results/tables/reversals_uplift.csv",
        findings="results/findings/reversals_uplift.json",
    params:
        settings=UPLIFT,
        ensemble=MOTIONS,
    script:
        "steps/motions_uplift.py"
