"""What follows from the equation of motion, for which motion, and how surely."""

# The synthetic motions of the study that this one needs.
ENSEMBLE = settings("motions_ensemble", *PARTS["certainty"].config["needs"])
RATES = settings("rates", "certainty")
BREAK_EVEN = settings("break_even", "certainty")
INTENSITIES = settings("intensities", "certainty")

# The second solver, SciPy, on samples: no row says so, and the run fails without.
CHECKS |= {
    "certainty_benefit": ["second_route"],
    "certainty_intensities": ["second_route"],
    "certainty_reach": ["reach_by_scipy"],
    "certainty_rescaled": ["rescaled_by_scipy"],
    "certainty_theorem": ["second_route"],
}


scattergather:
    certainty_sweep=ENSEMBLE["runs"][ENSEMBLE["run"]]["shards"],


# All that the steps ask of the motions, in one sweep.
rule certainty_sweep_shard:
    output:
        "results/shards/certainty_{scatteritem}.npz",
    params:
        asked={
            "rates": RATES,
            "break_even": BREAK_EVEN,
            "intensities": INTENSITIES,
            "structures": named(config["structures"], INTENSITIES),
            "benefit": settings("benefit", "certainty"),
            "shares": settings("shares", "certainty"),
        },
        ensemble=ENSEMBLE,
    script:
        "steps/sweep.py"


SWEPT = gather.certainty_sweep("results/shards/certainty_{scatteritem}.npz")


rule certainty_theorem:
    output:
        table="results/tables/certainty_theorem.csv",
        findings="results/findings/certainty_theorem.json",
    params:
        settings=settings("theorem", "certainty"),
    script:
        "steps/theorem.py"


rule certainty_lowest:
    output:
        table="results/tables/certainty_lowest.csv",
        histories="results/tables/certainty_lowest_histories.csv",
        findings="results/findings/certainty_lowest.json",
    params:
        settings=settings("lowest", "certainty"),
        solver=config["solver"],
    script:
        "steps/lowest.py"


rule certainty_extensions:
    input:
        records=[
            RECORDS[name]
            for pair in settings("extensions", "certainty")["pairs"]
            for name in (pair["horizontal"], pair["vertical"])
        ],
    output:
        table="results/tables/certainty_extensions.csv",
        proofs="results/tables/certainty_proofs.csv",
        similar="results/tables/certainty_similar.csv",
        lobes="results/tables/certainty_lobes.csv",
        findings="results/findings/certainty_extensions.json",
    params:
        settings=settings("extensions", "certainty"),
    script:
        "steps/extensions.py"


rule certainty_restitution:
    output:
        table="results/tables/certainty_restitution.csv",
        findings="results/findings/certainty_restitution.json",
    params:
        settings=settings("restitution", "certainty"),
    script:
        "steps/restitution.py"


rule certainty_benefit:
    input:
        shards=SWEPT,
    output:
        table="results/tables/certainty_benefit.csv",
        findings="results/findings/certainty_benefit.json",
    params:
        settings=settings("benefit", "certainty"),
        ensemble=ENSEMBLE,
    script:
        "steps/benefit.py"


rule certainty_intensities:
    input:
        shards=SWEPT,
    output:
        table="results/tables/certainty_intensities.csv",
        findings="results/findings/certainty_intensities.json",
    params:
        settings=INTENSITIES,
        ensemble=ENSEMBLE,
        structures=named(config["structures"], INTENSITIES),
    script:
        "steps/intensities.py"


rule certainty_rates_check:
    input:
        shards=SWEPT,
    output:
        table="results/tables/certainty_rates_check.csv",
        findings="results/findings/certainty_rates_check.json",
    params:
        settings=RATES,
        ensemble=ENSEMBLE,
        solver=config["solver"],
    script:
        "steps/rates_check.py"


rule certainty_rates:
    input:
        shards=SWEPT,
    output:
        motions="results/tables/certainty_motions.csv",
        rates="results/tables/certainty_rates.csv",
        scales="results/tables/certainty_scales.csv",
        findings="results/findings/certainty_rates.json",
    params:
        settings=RATES,
        ensemble=ENSEMBLE,
    script:
        "steps/rates.py"


rule certainty_break_even:
    input:
        shards=SWEPT,
    output:
        table="results/tables/certainty_break_even.csv",
        median="results/tables/certainty_break_even_median.csv",
        measured="results/tables/certainty_measured.csv",
        findings="results/findings/certainty_break_even.json",
    params:
        settings=BREAK_EVEN,
        ensemble=ENSEMBLE,
    script:
        "steps/break_even.py"


rule certainty_records:
    input:
        records=record_paths(settings("records", "certainty")["records"], RECORDS),
    output:
        table="results/tables/certainty_records.csv",
        findings="results/findings/certainty_records.json",
    params:
        settings=settings("records", "certainty"),
        structures=named(config["structures"], settings("records", "certainty")),
    script:
        "steps/records.py"


rule certainty_rescaled:
    input:
        known="results/tables/certainty_records.csv",
        records=record_paths(settings("records", "certainty")["records"], RECORDS),
    output:
        table="results/tables/certainty_rescaled.csv",
        findings="results/findings/certainty_rescaled.json",
    params:
        settings=settings("records", "certainty"),
        spec=PARTS["certainty"].config["rescaled"],
        structures=named(config["structures"], settings("records", "certainty")),
    script:
        "steps/rescaled.py"


rule certainty_proven:
    input:
        known="results/tables/certainty_records.csv",
        records=record_paths(settings("records", "certainty")["records"], RECORDS),
    output:
        table="results/tables/certainty_proven.csv",
        certificates="results/certificates/certainty_proven.jsonl",
        findings="results/findings/certainty_proven.json",
    params:
        settings=settings("lowest", "certainty"),
        columns=settings("records", "certainty")["columns"],
        structures=named(config["structures"], settings("records", "certainty")),
    script:
        "steps/proven.py"


rule certainty_reach:
    input:
        records=record_paths(settings("reach", "certainty")["records"], RECORDS),
    output:
        table="results/tables/certainty_reach.csv",
        findings="results/findings/certainty_reach.json",
    params:
        settings=settings("reach", "certainty"),
        ensemble=ENSEMBLE,
    script:
        "steps/reach.py"


rule certainty_shares:
    input:
        shards=SWEPT,
    output:
        table="results/tables/certainty_shares.csv",
        findings="results/findings/certainty_shares.json",
    params:
        settings=settings("shares", "certainty"),
        ensemble=ENSEMBLE,
    script:
        "steps/shares.py"
