"""How much amplitude a heavier cap buys, under one pulse: a study to begin with."""


rule skeleton_gain:
    output:
        table="results/tables/skeleton_gain.csv",
        findings="results/findings/skeleton_gain.json",
    params:
        settings=settings("gain", "skeleton"),
        solver=config["solver"],
    script:
        "steps/gain.py"
