"""Is a heavier cap always more stable? The half of the study about ground motions."""

FIGURES["studies/reversals/figures/motions_fragility"] = ["reversals_fragility"]
FIGURES["studies/reversals/figures/motions_gain"] = [
    "reversals_pairs",
    "reversals_medians",
]
FIGURES["studies/reversals/figures/motions_records"] = ["reversals_records"]
FINDINGS += ["reversals_records", "reversals_motions", "reversals_check"]

MOTIONS = study_case("reversals", "motions_ensemble")


scattergather:
    reversals_motions=MOTIONS["runs"][MOTIONS["run"]]["shards"],


rule reversals_records:
    input:
        code("studies/reversals/steps/motions_records.py"),
        records=[
            RECORDS[name]
            for name in study_case("reversals", "motions_records")["records"]
        ],
    output:
        table="results/tables/reversals_records.csv",
        counts="results/tables/reversals_by_record.csv",
        findings="results/findings/reversals_records.json",
    log:
        "results/logs/reversals_records.log",
    benchmark:
        "results/benchmarks/reversals_records.tsv"
    params:
        case=study_case("reversals", "motions_records"),
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
