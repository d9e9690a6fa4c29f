"""Does the paper's mechanism hold? Its forces, its one degree of freedom, its impacts, its likeness."""

from importlib.metadata import distributions

MECHANISM = PARTS["mechanism"].config
EXPERIMENTS = ["first_impacts", "rebounds", "verdicts", "beside", "slides", "space"]

# The version of the optional engine, a parameter of its rule; None where it is not installed.
ENGINE = {found.name: found.version for found in distributions()}.get("mujoco-core")

# No row says so, and the run fails without.
CHECKS |= {
    "mechanism_admissible": ["first_pull"],
    "mechanism_forces": ["solitary_column_recovered", "weight_and_inertia"],
}


rule mechanism_forces:
    output:
        table="results/tables/mechanism_forces.csv",
        findings="results/findings/mechanism_forces.json",
    params:
        settings=settings("forces", "mechanism"),
        cap=MECHANISM["caps"][MECHANISM["forces"]["structure"]],
    script:
        "steps/forces.py"


rule mechanism_three_bodies:
    input:
        records=record_paths(MECHANISM["three_bodies"]["records"], RECORDS),
    output:
        table="results/tables/mechanism_three_bodies.csv",
        findings="results/findings/mechanism_three_bodies.json",
    params:
        settings=settings("three_bodies", "mechanism"),
        cap=MECHANISM["caps"][MECHANISM["three_bodies"]["structure"]],
    script:
        "steps/three_bodies.py"


rule mechanism_admissible:
    output:
        table="results/tables/mechanism_admissible.csv",
        by_mass="results/tables/mechanism_admissible_by_mass.csv",
        findings="results/findings/mechanism_admissible.json",
    params:
        settings=settings("admissible", "mechanism"),
        cap=MECHANISM["caps"][MECHANISM["admissible"]["structure"]],
    script:
        "steps/admissible.py"


rule mechanism_dependence:
    output:
        table="results/tables/mechanism_dependence.csv",
        bays="results/tables/mechanism_bays.csv",
        findings="results/findings/mechanism_dependence.json",
    params:
        settings=settings("dependence", "mechanism"),
        cap=MECHANISM["caps"][MECHANISM["dependence"]["structure"]],
    script:
        "steps/dependence.py"


rule mechanism_records:
    input:
        records=record_paths(MECHANISM["records"]["records"], RECORDS),
    output:
        table="results/tables/mechanism_records.csv",
        findings="results/findings/mechanism_records.json",
    params:
        settings=MECHANISM["records"],
        structures=named(config["structures"], MECHANISM["records"]),
        caps=named(MECHANISM["caps"], MECHANISM["records"]),
    script:
        "steps/records.py"


rule mechanism_equivalence:
    output:
        table="results/tables/mechanism_equivalence.csv",
        drawn="results/tables/mechanism_equivalence_map.csv",
        lowest="results/tables/mechanism_lowest.csv",
        findings="results/findings/mechanism_equivalence.json",
    params:
        settings=MECHANISM["equivalence"],
    script:
        "steps/equivalence.py"


# Without the engine this runs too: it writes why nothing was tested.
rule mechanism_engine:
    output:
        table="results/tables/mechanism_{experiment}.csv",
        findings="results/findings/mechanism_{experiment}.json",
    log:
        "results/logs/mechanism_{experiment}.log",
    benchmark:
        "results/benchmarks/mechanism_{experiment}.tsv"
    wildcard_constraints:
        experiment="|".join(EXPERIMENTS),
    params:
        settings=lambda wildcards: MECHANISM["engine"][wildcards.experiment],
        structures=lambda wildcards: named(
            config["structures"], MECHANISM["engine"][wildcards.experiment]
        ),
        caps=lambda wildcards: named(
            MECHANISM["caps"], MECHANISM["engine"][wildcards.experiment]
        ),
        engine=ENGINE,
    message:
        "Study mechanism: MuJoCo, {wildcards.experiment}"
    script:
        "steps/{wildcards.experiment}.py"
