"""Which numbers on motions hold under other models of motions, and what they require of contacts."""

FAMILIES = settings("motions_ensemble", "reversals")

# The second solver, SciPy, on samples: no row says so, and the run fails without.
CHECKS |= {
    "robustness_models": ["second_route"],
    "robustness_vertical": ["vertical_second_route"],
}


rule robustness_models:
    output:
        table="results/tables/robustness_models.csv",
        findings="results/findings/robustness_models.json",
    params:
        settings=settings("models", "robustness"),
        ensemble=FAMILIES,
    script:
        "steps/models.py"


rule robustness_friction:
    output:
        table="results/tables/robustness_friction.csv",
        findings="results/findings/robustness_friction.json",
    params:
        settings=settings("friction", "robustness"),
        ensemble=FAMILIES,
        cap=PARTS["mechanism"].config["caps"]["temple"],
    script:
        "steps/friction.py"


rule robustness_vertical:
    input:
        records=[
            RECORDS[name]
            for entry in settings("vertical", "robustness")["measured"]
            for name in entry.values()
        ],
    output:
        table="results/tables/robustness_vertical.csv",
        findings="results/findings/robustness_vertical.json",
    params:
        settings=settings("vertical", "robustness"),
        ensemble=FAMILIES,
    script:
        "steps/vertical.py"
