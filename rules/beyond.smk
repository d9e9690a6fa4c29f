"""What we add to the paper's results."""

# First half: motions, break_even, records ------------------------------------------------------------


# Second half: friction, engine -----------------------------------------------------------------------


rule friction:
    output:
        pulses="results/tables/friction_pulses.csv",
        by_mass="results/tables/friction_by_mass.csv",
        findings="results/findings/friction.json",
    log:
        "results/logs/friction.log",
    params:
        code=code(
            "src/steps/beyond/friction.py",
            "src/steps/shared/__init__.py",
            "src/steps/shared/histories.py",
        )
        | CORE
        | library("forces", "second"),
        settings=PAPER["friction"],
        structures=PAPER["structures"],
    script:
        "../src/steps/beyond/friction.py"


rule engine:
    output:
        restitution="results/tables/engine_restitution.csv",
        outcomes="results/tables/engine_outcomes.csv",
        findings="results/findings/engine.json",
    log:
        "results/logs/engine.log",
    params:
        code=code("src/steps/beyond/engine.py", "src/steps/beyond/boxes.py")
        | CORE
        | library("forces"),
        settings=PAPER["engine"],
        structures=PAPER["structures"],
    script:
        "../src/steps/beyond/engine.py"
