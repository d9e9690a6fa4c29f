"""How many intervals an integral requires: a study to begin with."""


rule skeleton_limit:
    output:
        table="results/tables/skeleton_limit.csv",
        findings="results/findings/skeleton_limit.json",
    params:
        settings=PARTS["skeleton"].config["limit"],
    script:
        "steps/limit.py"
