"""Every result of Makris & Vassiliou (2014): config → steps → results → figures, claims → report.

The rules below are the paper's, in its order; those of a study are in its folder. What every
replication does with its results (figures, notebooks, verdicts, documents, the RO-Crate) is in
src/replication/rules.smk. A rule says only what is special about it: its script, what it takes and
what it makes. `complete` adds the rest: the modules that the script imports as inputs, so that a
change of code repeats the jobs that it concerns; the first line of the script as message; a log
and a benchmark. `settings` passes a section of config/config.yaml as parameters.
"""


include: "src/replication/common.smk"


from steps.inputs import check_inputs, record_files, record_paths

read_strictly("config/config.yaml")


configfile: "config/config.yaml"


check_inputs(config, config_files(), "config/config.schema.yaml")
RECORDS = record_files()

# The paper, and its follow-up studies, each a folder (studies/FOLLOW-UP.md).
PARTS = parts(partial(check_inputs, structures=config["structures"]))


include: "src/steps/common.smk"


# The paper's rules --------------------------------------------------------------------------------

PARTS[PAPER].data.append(RECORDS["el_centro_1940_NS"])

# Findings that no claim rests on, and without which no claim is worth much.
CHECKS = {
    "equations": ["theorems_hold", "text_mass_ratio"],
    "allen_histories": ["peaks_over_alpha"],
    "trilith": ["thresholds_bracketed"],
    "trilith_states": ["second_route"],
    "vase": ["second_route"],
    "uplift_limits": ["forces_by_second_routes"],
    "portal": ["second_route"],
    "verification": [
        "routes_agree",
        "published_numbers",
        "library_follows_the_derivation",
    ],
    "spectra": ["sample_agrees"],
    "spectra_dimensional": ["published_amplitude"],
    "rocking_spectra": ["second_route"],
}


# The overturning spectra are split into so many jobs, which an executor may spread over machines.
scattergather:
    spectra=config["spectra"]["shards"],


# The kernel is compiled once ---------------------------------------------------------------------


rule kernel:
    output:
        touch("results/kernel.compiled"),
    priority: 1000
    script:
        "src/steps/kernel.py"


# The derivation: Eqs. (1)–(25) -------------------------------------------------------------------


rule equations:
    output:
        table="results/tables/equations.csv",
        theorems="results/tables/theorems.csv",
        findings="results/findings/equations.json",
    script:
        "src/steps/equations.py"


# 1. How p̂ and R̂ depend on γ: Eqs. (23), (24) ---------------------------------------------------


rule mass_ratio:
    output:
        table="results/tables/mass_ratio.csv",
        findings="results/findings/mass_ratio.json",
    params:
        settings=config["mass_ratio"],
    script:
        "src/steps/mass_ratio.py"


# 2. Restitution: Eq. (25) ------------------------------------------------------------------------


rule restitution:
    output:
        over_slenderness="results/tables/restitution_over_slenderness.csv",
        over_mass_ratio="results/tables/restitution_over_mass_ratio.csv",
        findings="results/findings/restitution.json",
    params:
        settings=config["restitution"],
    script:
        "src/steps/restitution.py"


# 3. Moment–rotation and free rocking: Fig. 1(b) --------------------------------------------------


rule moment_rotation:
    output:
        moments="results/tables/moment_rotation.csv",
        periods="results/tables/quarter_period.csv",
        findings="results/findings/moment_rotation.json",
    params:
        settings=settings("moment_rotation"),
    script:
        "src/steps/moment_rotation.py"


rule sketches:
    output:
        outlines="results/tables/outlines.csv",
        free_body="results/tables/free_body.csv",
    params:
        settings=settings("sketches"),
    script:
        "src/steps/sketches.py"


# 4. The trilith of Peña et al. (2008): p. 4 ------------------------------------------------------


rule trilith:
    output:
        numbers="results/tables/trilith_numbers.csv",
        nearness="results/tables/trilith_nearness.csv",
        starts="results/tables/trilith_starts.csv",
        limits="results/tables/trilith_limits.csv",
        histories="results/tables/trilith_histories.csv",
        findings="results/findings/trilith.json",
    params:
        settings=settings("trilith"),
        printed={
            claim.id: claim.printed
            for claim in read_ledger([PARTS[PAPER].claims])
            if claim.id.startswith("trilith_") and claim.printed is not None
        },
        solver=config["solver"],
    script:
        "src/steps/trilith.py"


rule trilith_states:
    output:
        table="results/tables/trilith_states.csv",
        sample="results/tables/trilith_sample.csv",
        findings="results/findings/trilith_states.json",
    params:
        settings=settings("trilith"),
        states=config["trilith_states"],
    script:
        "src/steps/trilith_states.py"


rule trilith_orbit:
    input:
        states="results/tables/trilith_states.csv",
    output:
        table="results/tables/trilith_orbit.csv",
        findings="results/findings/trilith_orbit.json",
    params:
        settings=settings("trilith"),
    script:
        "src/steps/trilith_orbit.py"


rule trilith_map:
    output:
        table="results/tables/trilith_map.csv",
        uplift="results/tables/trilith_uplift.csv",
    params:
        settings=settings("trilith_map"),
    script:
        "src/steps/trilith_map.py"


# 5. Allen et al. (1986): linearised, columns without mass --------------------------------------------


rule allen_histories:
    input:
        record=RECORDS[config["allen_histories"]["record"]["file"]],
    output:
        table="results/tables/allen_histories.csv",
        peaks="results/tables/allen_peaks.csv",
        findings="results/findings/allen_histories.json",
    params:
        settings=settings("allen_histories"),
        solver=config["solver"],
    script:
        "src/steps/allen_histories.py"


rule allen_errors:
    output:
        table="results/tables/allen_errors.csv",
        findings="results/findings/allen_errors.json",
    params:
        settings=config["allen_errors"],
    script:
        "src/steps/allen_errors.py"


rule allen_overturning:
    output:
        table="results/tables/allen_overturning.csv",
        findings="results/findings/allen_overturning.json",
    params:
        settings=config["allen_overturning"],
    script:
        "src/steps/allen_overturning.py"


# 6. Top-heavy is more stable: the conclusions ----------------------------------------------------


rule heavier:
    output:
        histories="results/tables/heavier_histories.csv",
        summary="results/tables/heavier.csv",
        findings="results/findings/heavier.json",
    params:
        settings=settings("heavier"),
        solver=config["solver"],
    script:
        "src/steps/heavier.py"


rule vase:
    input:
        records=record_paths(config["vase"]["records"], RECORDS),
    output:
        summary="results/tables/vase.csv",
        motions="results/tables/vase_motions.csv",
        exceptions="results/tables/vase_exceptions.csv",
        shares="results/tables/vase_shares.csv",
        poses="results/tables/vase_poses.csv",
        findings="results/findings/vase.json",
    params:
        settings=settings("vase"),
        solver=config["solver"],
    script:
        "src/steps/vase.py"


rule uplift_limits:
    input:
        records=record_paths(config["uplift_limits"]["records"], RECORDS),
    output:
        table="results/tables/uplift_limits.csv",
        ratios="results/tables/uplift_ratios.csv",
        slopes="results/tables/uplift_slopes.csv",
        routes="results/tables/uplift_routes.csv",
        findings="results/findings/uplift_limits.json",
    params:
        settings=settings("uplift_limits"),
    script:
        "src/steps/uplift_limits.py"


rule portal:
    input:
        records=record_paths(config["portal"]["records"], RECORDS),
    output:
        forces="results/tables/portal_forces.csv",
        columns="results/tables/portal_columns.csv",
        findings="results/findings/portal.json",
    params:
        settings=settings("portal"),
        vase=config["vase"],
    script:
        "src/steps/portal.py"


rule scale_effects:
    output:
        table="results/tables/scale_effects.csv",
        outcomes="results/tables/scale_outcomes.csv",
        findings="results/findings/scale_effects.json",
    params:
        settings=settings("scale_effects"),
        solver=config["solver"],
    script:
        "src/steps/scale_effects.py"


rule stability:
    output:
        minima="results/tables/stability_minima.csv",
        runs="results/tables/stability_runs.csv",
        findings="results/findings/stability.json",
    params:
        settings=settings("stability"),
        solver=config["solver"],
    script:
        "src/steps/stability.py"


# 7. Overturning and rocking spectra ---------------------------------------------------------------


rule spectra_shard:
    output:
        table="results/shards/spectra_{scatteritem}.csv",
    params:
        settings=config["spectra"],
    script:
        "src/steps/spectra_shard.py"


rule spectra:
    input:
        shards=gather.spectra("results/shards/spectra_{scatteritem}.csv"),
    output:
        table="results/tables/spectra.csv",
        areas="results/tables/spectra_areas.csv",
        sample="results/tables/spectra_sample.csv",
        findings="results/findings/spectra.json",
    params:
        settings=config["spectra"],
        solver=config["solver"],
    script:
        "src/steps/spectra.py"


rule proven:
    input:
        vase="results/tables/vase.csv",
        spectra="results/tables/spectra.csv",
    output:
        table="results/tables/proven.csv",
        certificates="results/certificates/proven.jsonl",
        findings="results/findings/proven.json",
    params:
        settings=settings("vase"),
        spectra=config["spectra"],
    script:
        "src/steps/proven.py"


rule proven_below:
    input:
        proven="results/tables/proven.csv",
    output:
        table="results/tables/proven_below_structures.csv",
        certificates="results/certificates/proven_below.jsonl",
        findings="results/findings/proven_below.json",
    params:
        settings=settings("vase"),
        mass_ratios=config["proven_below"]["mass_ratios"],
    script:
        "src/steps/proven_below.py"


rule spectra_dimensional:
    output:
        table="results/tables/spectra_dimensional.csv",
        published="results/tables/spectra_published.csv",
        findings="results/findings/spectra_dimensional.json",
    params:
        settings=config["spectra_dimensional"],
        structures=named(config["structures"], config["spectra_dimensional"]),
        solver=config["solver"],
    script:
        "src/steps/spectra_dimensional.py"


rule peak_maps:
    output:
        table="results/tables/peak_maps.csv",
    params:
        settings=settings("peak_maps"),
    script:
        "src/steps/peak_maps.py"


rule rocking_spectra:
    input:
        records=record_paths(config["rocking_spectra"]["records"], RECORDS),
    output:
        table="results/tables/rocking_spectra.csv",
        findings="results/findings/rocking_spectra.json",
    params:
        settings=settings("rocking_spectra"),
        solver=config["solver"],
    script:
        "src/steps/rocking_spectra.py"


# What the paper says in words ---------------------------------------------------------------------


rule statements:
    output:
        table="results/tables/statements.csv",
        findings="results/findings/statements.json",
    params:
        settings=settings("statements"),
        solver=config["solver"],
    script:
        "src/steps/statements.py"


# What the paper leaves open ------------------------------------------------------------------------


rule assumptions:
    input:
        assumptions="paper/assumptions.yaml",
        ledger=PARTS[PAPER].claims,
        records=record_paths(config["assumptions"]["records"], RECORDS),
    output:
        table="results/tables/assumptions.csv",
    params:
        sections={
            name: settings(name)
            for name in [
                "trilith",
                "heavier",
                "scale_effects",
                "stability",
                "statements",
                "uplift_limits",
                "rocking_spectra",
            ]
        }
        | {
            name: config[name]
            for name in ["assumptions", "restitution", "allen_errors"]
        },
        solver=config["solver"],
    script:
        "src/steps/assumptions/run.py"


# How far the numbers can be trusted --------------------------------------------------------------


rule verification:
    output:
        routes="results/tables/verification_routes.csv",
        convergence="results/tables/verification_convergence.csv",
        published="results/tables/verification_published.csv",
        findings="results/findings/verification.json",
    params:
        settings=config["verification"],
        solver=config["solver"],
    script:
        "src/steps/verification.py"


# Pictures, notebooks -----------------------------------------------------------------------------


rule animation:
    input:
        style="figures/style.mplstyle",
    output:
        "results/animation.gif",
        shown("results/animation.png"),
    params:
        settings=settings("animation"),
    script:
        "src/steps/animation.py"


rule explorer:
    input:
        sorted(str(path) for path in Path("src/explorer").rglob("*") if path.is_file()),
        record=RECORDS["el_centro_1940_NS"],
    output:
        "results/explorer.html",
    script:
        "src/steps/explorer.py"


# The studies, and what follows from all results -----------------------------------------------------


for name in config["studies"]:

    include: f"studies/{name}/study.smk"


complete(workflow)


include: "src/replication/rules.smk"


after_the_kernel()


rule all:
    default_target: True
    input:
        everything,
        CRATE,


onstart:
    begin()
    # Every record is read before anything is computed: a bad one is told at once.
    from topheavy import read_record

    for path in RECORDS.values():
        read_record(path)
    # With its limit of 100 jobs a second Snakemake looks for jobs again, every second, once for each
    # job that has begun: a tenth of the run's processor time.
    workflow.scheduler.job_rate_limiter = None
