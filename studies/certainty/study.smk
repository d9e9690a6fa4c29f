"""What follows from the equation of motion, for which motion, and how surely."""

CERTAINTY = [
    "theorem",
    "lowest",
    "extensions",
    "restitution",
    "benefit",
    "intensities",
    "records",
]

PARTS["certainty"].figures.update(
    {
        "studies/certainty/figures/shapes": [
            "certainty_lowest",
            "certainty_lowest_histories",
        ],
        "studies/certainty/figures/impact_law": ["certainty_restitution"],
        "studies/certainty/figures/intensities": ["certainty_intensities"],
    }
)
PARTS["certainty"].findings.extend([f"certainty_{name}" for name in CERTAINTY])


rule certainty_theorem:
    input:
        code("studies/certainty/steps/theorem.py"),
    output:
        table="results/tables/certainty_theorem.csv",
        findings="results/findings/certainty_theorem.json",
    log:
        "results/logs/certainty_theorem.log",
    benchmark:
        "results/benchmarks/certainty_theorem.tsv"
    params:
        case=case("theorem", "certainty"),
    message:
        "Study certainty: no reversal without an impact"
    script:
        "steps/theorem.py"


rule certainty_lowest:
    input:
        code("studies/certainty/steps/lowest.py"),
    output:
        table="results/tables/certainty_lowest.csv",
        histories="results/tables/certainty_lowest_histories.csv",
        findings="results/findings/certainty_lowest.json",
    log:
        "results/logs/certainty_lowest.log",
    benchmark:
        "results/benchmarks/certainty_lowest.tsv"
    params:
        case=case("lowest", "certainty"),
        solver=config["solver"],
    message:
        "Study certainty: a pulse that needs less to overturn the heavier frame"
    script:
        "steps/lowest.py"


rule certainty_extensions:
    input:
        code("studies/certainty/steps/extensions.py"),
        records=[
            RECORDS[name]
            for pair in case("extensions", "certainty")["pairs"]
            for name in (pair["horizontal"], pair["vertical"])
        ],
    output:
        table="results/tables/certainty_extensions.csv",
        findings="results/findings/certainty_extensions.json",
    log:
        "results/logs/certainty_extensions.log",
    benchmark:
        "results/benchmarks/certainty_extensions.tsv"
    params:
        case=case("extensions", "certainty"),
    message:
        "Study certainty: similarity, several columns, vertical acceleration"
    script:
        "steps/extensions.py"


rule certainty_restitution:
    input:
        code("studies/certainty/steps/restitution.py"),
    output:
        table="results/tables/certainty_restitution.csv",
        findings="results/findings/certainty_restitution.json",
    log:
        "results/logs/certainty_restitution.log",
    benchmark:
        "results/benchmarks/certainty_restitution.tsv"
    params:
        case=case("restitution", "certainty"),
        ensemble=MOTIONS,
    message:
        "Study certainty: how much depends on the impact law"
    script:
        "steps/restitution.py"


rule certainty_benefit:
    input:
        code("studies/certainty/steps/benefit.py"),
    output:
        table="results/tables/certainty_benefit.csv",
        findings="results/findings/certainty_benefit.json",
    log:
        "results/logs/certainty_benefit.log",
    benchmark:
        "results/benchmarks/certainty_benefit.tsv"
    params:
        case=case("benefit", "certainty"),
        ensemble=MOTIONS,
    message:
        "Study certainty: the benefit of the cap beam if the column loses more at impacts"
    script:
        "steps/benefit.py"


rule certainty_intensities:
    input:
        code("studies/certainty/steps/intensities.py"),
    output:
        table="results/tables/certainty_intensities.csv",
        findings="results/findings/certainty_intensities.json",
    log:
        "results/logs/certainty_intensities.log",
    benchmark:
        "results/benchmarks/certainty_intensities.tsv"
    params:
        case=case("intensities", "certainty"),
        ensemble=MOTIONS,
        structures=named(config["structures"], case("intensities", "certainty")),
    message:
        "Study certainty: probability of overturning at stated intensities"
    script:
        "steps/intensities.py"


rule certainty_records:
    input:
        code("studies/certainty/steps/records.py"),
        records=record_paths(case("records", "certainty")["records"], RECORDS),
    output:
        table="results/tables/certainty_records.csv",
        findings="results/findings/certainty_records.json",
    log:
        "results/logs/certainty_records.log",
    benchmark:
        "results/benchmarks/certainty_records.tsv"
    params:
        case=case("records", "certainty"),
        structures=named(config["structures"], case("records", "certainty")),
    message:
        "Study certainty: the records as measured"
    script:
        "steps/records.py"
