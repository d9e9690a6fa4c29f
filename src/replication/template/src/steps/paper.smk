"""The results of the paper, in the paper's order."""

PARTS[PAPER].figures["figures/period"] = ["period"]
PARTS[PAPER].findings.extend(["equations", "period"])

# Findings that no claim rests on, and that have to hold all the same.
CHECKS = {"period": ["routes_agree"]}


rule equations:
    input:
        code("src/steps/equations.py"),
    output:
        findings="results/findings/equations.json",
    log:
        "results/logs/equations.log",
    benchmark:
        "results/benchmarks/equations.tsv"
    message:
        "Deriving the equations"
    script:
        "equations.py"


rule period:
    input:
        code("src/steps/period.py"),
    output:
        table="results/tables/period.csv",
        findings="results/findings/period.json",
    log:
        "results/logs/period.log",
    benchmark:
        "results/benchmarks/period.tsv"
    params:
        case=config["period"],
    message:
        "The period over the amplitude"
    script:
        "period.py"
