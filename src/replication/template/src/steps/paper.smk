"""The results of the paper, in the paper's order."""

# Findings that no claim rests on, and that have to hold all the same.
CHECKS = {"period": ["routes_agree"]}


rule equations:
    output:
        findings="results/findings/equations.json",
    script:
        "equations.py"


rule period:
    output:
        table="results/tables/period.csv",
        findings="results/findings/period.json",
    params:
        settings=config["period"],
    script:
        "period.py"
