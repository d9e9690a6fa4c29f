"""Is a heavier cap always more stable? The half of the study about ground motions."""

PARTS["reversals"].figures["studies/reversals/figures/motions_fragility"] = [
    "reversals_fragility"
]
PARTS["reversals"].figures["studies/reversals/figures/motions_gain"] = [
    "reversals_pairs",
    "reversals_medians",
]
PARTS["reversals"].figures["studies/reversals/figures/motions_records"] = [
    "reversals_records"
]
PARTS["reversals"].figures["studies/reversals/figures/motions_vase"] = [
    "reversals_vase",
    "reversals_uplift",
]
PARTS["reversals"].findings.extend(
    [
        "reversals_records",
        "reversals_motions",
        "reversals_check",
        "reversals_vase",
        "reversals_uplift",
    ]
)

MOTIONS = case("motions_ensemble", "reversals")


scattergather:
    reversals_motions=MOTIONS["runs"][MOTIONS["run"]]["shards"],


rule reversals_records:
    input:
        code("studies/reversals/steps/motions_records.py"),
        records=record_paths(case("motions_records", "reversals")["records"], RECORDS),
    output:
        table="results/tables/reversals_records.csv",
        counts="results/tables/reversals_by_record.csv",
        findings="results/findings/reversals_records.json",
    log:
        "results/logs/reversals_records.log",
    benchmark:
        "results/benchmarks/reversals_records.tsv"
    params:
        case=case("motions_records", "reversals"),
        solver=config["solver"],
    message:
        "Study reversals: real records, from uplift to collapse"
    script:
        "steps/motions_records.py"


rule reversals_motions_shard:
    input:
        code("studies/reversals/steps/motions_shard.py"),
    output:
        table="results/shards/reversals_motions_{scatteritem}.csv",
    log:
        "results/logs/reversals_motions_shard_{scatteritem}.log",
    benchmark:
        "results/benchmarks/reversals_motions_shard_{scatteritem}.tsv"
    params:
        case=MOTIONS,
        structures=named(config["structures"], MOTIONS),
    message:
        "Study reversals: synthetic motions, shard {wildcards.scatteritem}"
    script:
        "steps/motions_shard.py"


rule reversals_motions:
    input:
        code("studies/reversals/steps/motions_fragility.py"),
        shards=gather.reversals_motions(
            "results/shards/reversals_motions_{scatteritem}.csv"
        ),
    output:
        fragility="results/tables/reversals_fragility.csv",
        pairs="results/tables/reversals_pairs.csv",
        medians="results/tables/reversals_medians.csv",
        findings="results/findings/reversals_motions.json",
    log:
        "results/logs/reversals_motions.log",
    benchmark:
        "results/benchmarks/reversals_motions.tsv"
    params:
        case=MOTIONS,
        structures=named(config["structures"], MOTIONS),
    message:
        "Study reversals: fragility, and how often the heavier falls alone"
    script:
        "steps/motions_fragility.py"


rule reversals_check:
    input:
        code("studies/reversals/steps/motions_check.py"),
        shards=gather.reversals_motions(
            "results/shards/reversals_motions_{scatteritem}.csv"
        ),
    output:
        findings="results/findings/reversals_check.json",
    log:
        "results/logs/reversals_check.log",
    benchmark:
        "results/benchmarks/reversals_check.tsv"
    params:
        case=MOTIONS,
        structures=named(config["structures"], MOTIONS),
        solver=config["solver"],
    message:
        "Study reversals: a sample of the ensemble, judged again"
    script:
        "steps/motions_check.py"


rule reversals_vase:
    input:
        code("studies/reversals/steps/motions_vase.py"),
    output:
        fragility="results/tables/reversals_vase.csv",
        ranks="results/tables/reversals_vase_ranks.csv",
        findings="results/findings/reversals_vase.json",
    log:
        "results/logs/reversals_vase.log",
    benchmark:
        "results/benchmarks/reversals_vase.tsv"
    params:
        case=case("motions_vase", "reversals"),
        ensemble=MOTIONS,
        solver=config["solver"],
    message:
        "Study reversals: the fixed mass and the frame under synthetic motions"
    script:
        "steps/motions_vase.py"


rule reversals_uplift:
    input:
        code("studies/reversals/steps/motions_uplift.py"),
    output:
        table="results/tables/reversals_uplift.csv",
        findings="results/findings/reversals_uplift.json",
    log:
        "results/logs/reversals_uplift.log",
    benchmark:
        "results/benchmarks/reversals_uplift.tsv"
    params:
        case=case("motions_uplift", "reversals"),
        ensemble=MOTIONS,
    message:
        "Study reversals: the forces that uplift limits under synthetic motions"
    script:
        "steps/motions_uplift.py"
