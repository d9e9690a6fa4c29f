"""How much amplitude a heavier cap buys, under one pulse: a study to begin with."""


rule skeleton_gain:
    output:
        table="results/tables/skeleton_gain.csv",
        findings="results/findings/skeleton_gain.json",
    params:
        settings=settings("gain", "skeleton"),
        solver=config["solver"],
    message:
        "Study skeleton: the lowest amplitude that overturns"
    script:
        "steps/gain.py"
