"""How much amplitude a heavier cap buys, under one pulse: a study to begin with."""

PARTS["skeleton"].figures.update(
    {
        "studies/skeleton/figures/gain": ["skeleton_gain"],
    }
)
PARTS["skeleton"].findings.append("skeleton_gain")


rule skeleton_gain:
    input:
        code("studies/skeleton/steps/gain.py"),
    output:
        table="results/tables/skeleton_gain.csv",
        findings="results/findings/skeleton_gain.json",
    log:
        "results/logs/skeleton_gain.log",
    benchmark:
        "results/benchmarks/skeleton_gain.tsv"
    params:
        case=case("gain", "skeleton"),
        solver=config["solver"],
    message:
        "Study skeleton: the lowest amplitude that overturns"
    script:
        "steps/gain.py"
