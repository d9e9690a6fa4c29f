"""How much amplitude a heavier cap buys, under one pulse: a study to begin with."""

PARTS["certainty"].figures["studies/certainty/figures/gain"] = ["certainty_gain"]
PARTS["certainty"].findings.append("certainty_gain")


rule certainty_gain:
    input:
        code("studies/certainty/steps/gain.py"),
    output:
        table="results/tables/certainty_gain.csv",
        findings="results/findings/certainty_gain.json",
    log:
        "results/logs/certainty_gain.log",
    benchmark:
        "results/benchmarks/certainty_gain.tsv"
    params:
        case=case("gain", "certainty"),
        solver=config["solver"],
    message:
        "Study certainty: the lowest amplitude that overturns"
    script:
        "steps/gain.py"
