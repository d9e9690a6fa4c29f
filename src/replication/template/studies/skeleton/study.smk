"""How far a pendulum may swing before small-swing theory fails: a study to begin with."""

PARTS["skeleton"].figures.update(
    {
        "studies/skeleton/figures/limit": ["skeleton_limit"],
    }
)
PARTS["skeleton"].findings.append("skeleton_limit")


rule skeleton_limit:
    input:
        code("studies/skeleton/steps/limit.py"),
    output:
        table="results/tables/skeleton_limit.csv",
        findings="results/findings/skeleton_limit.json",
    log:
        "results/logs/skeleton_limit.log",
    benchmark:
        "results/benchmarks/skeleton_limit.tsv"
    params:
        case=PARTS["skeleton"].config["limit"],
    message:
        "Study skeleton: the largest amplitude of small swings"
    script:
        "steps/limit.py"
