"""The results of Makris & Vassiliou (2014), in the paper's order."""

PARTS[PAPER].figures.update(
    {
        "figures/structures": ["outlines", "moment_rotation"],
        "figures/free_body": ["outlines", "free_body"],
        "figures/mass_ratio": ["mass_ratio"],
        "figures/restitution": [
            "restitution_over_slenderness",
            "restitution_over_mass_ratio",
        ],
        "figures/quarter_period": ["quarter_period"],
        "figures/trilith_map": ["trilith_map", "trilith_uplift", "trilith_nearness"],
        "figures/trilith_starts": ["trilith_starts", "trilith_histories"],
        "figures/allen_histories": ["allen_histories"],
        "figures/allen_errors": ["allen_errors"],
        "figures/allen_overturning": ["allen_overturning"],
        "figures/vase": ["vase", "vase_poses"],
        "figures/uplift_limits": ["uplift_limits", "uplift_ratios"],
        "figures/heavier": ["heavier_histories", "heavier"],
        "figures/scale_effects": ["scale_effects"],
        "figures/spectra": ["spectra"],
        "figures/spectra_modes": ["spectra"],
        "figures/spectra_dimensional": ["spectra_dimensional", "spectra_published"],
        "figures/peak_maps": ["peak_maps"],
        "figures/rocking_spectra": ["rocking_spectra"],
    }
)
PARTS[PAPER].findings.extend(
    [
        "equations",
        "mass_ratio",
        "restitution",
        "moment_rotation",
        "trilith",
        "trilith_states",
        "allen_histories",
        "allen_errors",
        "allen_overturning",
        "heavier",
        "scale_effects",
        "stability",
        "vase",
        "uplift_limits",
        "spectra",
        "spectra_dimensional",
        "rocking_spectra",
        "statements",
        "verification",
    ]
)
PARTS[PAPER].data.append(RECORDS["el_centro_1940_NS"])

# Findings that no claim rests on, and without which no claim is worth much.
CHECKS = {
    "trilith_states": ["second_route"],
    "vase": ["second_route"],
    "uplift_limits": ["forces_by_second_routes"],
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
    input:
        code("src/steps/kernel.py"),
    output:
        touch("results/kernel.compiled"),
    log:
        "results/logs/kernel.log",
    benchmark:
        "results/benchmarks/kernel.tsv"
    priority: 1000
    message:
        "Compiling the kernel"
    script:
        "kernel.py"


# The derivation: Eqs. (1)–(25) -------------------------------------------------------------------


rule equations:
    input:
        code("src/steps/equations.py"),
    output:
        table="results/tables/equations.csv",
        findings="results/findings/equations.json",
    log:
        "results/logs/equations.log",
    benchmark:
        "results/benchmarks/equations.tsv"
    message:
        "Testing every equation as it is printed"
    script:
        "equations.py"


# 1. How p̂ and R̂ depend on γ: Eqs. (23), (24) ---------------------------------------------------


rule mass_ratio:
    input:
        code("src/steps/mass_ratio.py"),
    output:
        table="results/tables/mass_ratio.csv",
        findings="results/findings/mass_ratio.json",
    log:
        "results/logs/mass_ratio.log",
    benchmark:
        "results/benchmarks/mass_ratio.tsv"
    params:
        case=config["mass_ratio"],
    message:
        "p̂ and R̂ over γ"
    script:
        "mass_ratio.py"


# 2. Restitution: Eq. (25) ------------------------------------------------------------------------


rule restitution:
    input:
        code("src/steps/restitution.py"),
    output:
        over_slenderness="results/tables/restitution_over_slenderness.csv",
        over_mass_ratio="results/tables/restitution_over_mass_ratio.csv",
        findings="results/findings/restitution.json",
    log:
        "results/logs/restitution.log",
    benchmark:
        "results/benchmarks/restitution.tsv"
    params:
        case=config["restitution"],
    message:
        "√r over slenderness and γ"
    script:
        "restitution.py"


# 3. Moment–rotation and free rocking: Fig. 1(b) --------------------------------------------------


rule moment_rotation:
    input:
        code("src/steps/moment_rotation.py"),
    output:
        moments="results/tables/moment_rotation.csv",
        periods="results/tables/quarter_period.csv",
        findings="results/findings/moment_rotation.json",
    log:
        "results/logs/moment_rotation.log",
    benchmark:
        "results/benchmarks/moment_rotation.tsv"
    params:
        case=case("moment_rotation"),
    message:
        "Moment–rotation and the period of free rocking"
    script:
        "moment_rotation.py"


rule sketches:
    input:
        code("src/steps/sketches.py"),
    output:
        outlines="results/tables/outlines.csv",
        free_body="results/tables/free_body.csv",
    log:
        "results/logs/sketches.log",
    benchmark:
        "results/benchmarks/sketches.tsv"
    params:
        case=case("sketches"),
    message:
        "The paper's two drawings, to scale: Figs. 1 and 2"
    script:
        "sketches.py"


# 4. The trilith of Peña et al. (2008): p. 4 ------------------------------------------------------


rule trilith:
    input:
        code("src/steps/trilith.py"),
    output:
        nearness="results/tables/trilith_nearness.csv",
        starts="results/tables/trilith_starts.csv",
        histories="results/tables/trilith_histories.csv",
        findings="results/findings/trilith.json",
    log:
        "results/logs/trilith.log",
    benchmark:
        "results/benchmarks/trilith.tsv"
    params:
        case=case("trilith"),
        printed={
            claim.id: claim.printed
            for claim in read_ledger([PARTS[PAPER].claims])
            if claim.id.startswith("trilith_") and claim.printed is not None
        },
        solver=config["solver"],
    message:
        "The trilith: its numbers, what would have lifted it, how the table starts"
    script:
        "trilith.py"


rule trilith_states:
    input:
        code("src/steps/trilith_states.py"),
    output:
        table="results/tables/trilith_states.csv",
        findings="results/findings/trilith_states.json",
    log:
        "results/logs/trilith_states.log",
    benchmark:
        "results/benchmarks/trilith_states.tsv"
    params:
        case=case("trilith"),
        states=config["trilith_states"],
    message:
        "The trilith on the same shake table, if it already rocks"
    script:
        "trilith_states.py"


rule trilith_map:
    input:
        code("src/steps/trilith_map.py"),
    output:
        table="results/tables/trilith_map.csv",
        uplift="results/tables/trilith_uplift.csv",
    log:
        "results/logs/trilith_map.log",
    benchmark:
        "results/benchmarks/trilith_map.tsv"
    params:
        case=case("trilith_map"),
    message:
        "The trilith over amplitude and frequency of the table"
    script:
        "trilith_map.py"


# 5. Allen et al. (1986): linearised, columns without mass --------------------------------------------


rule allen_histories:
    input:
        code("src/steps/allen_histories.py"),
        record=RECORDS[config["allen_histories"]["record"]["file"]],
    output:
        table="results/tables/allen_histories.csv",
        findings="results/findings/allen_histories.json",
    log:
        "results/logs/allen_histories.log",
    benchmark:
        "results/benchmarks/allen_histories.tsv"
    params:
        case=case("allen_histories"),
        solver=config["solver"],
    message:
        "Allen et al.: histories under a pulse and a record"
    script:
        "allen_histories.py"


rule allen_errors:
    input:
        code("src/steps/allen_errors.py"),
    output:
        table="results/tables/allen_errors.csv",
        findings="results/findings/allen_errors.json",
    log:
        "results/logs/allen_errors.log",
    benchmark:
        "results/benchmarks/allen_errors.tsv"
    params:
        case=config["allen_errors"],
    message:
        "Allen et al.: error of the peak rotation"
    script:
        "allen_errors.py"


rule allen_overturning:
    input:
        code("src/steps/allen_overturning.py"),
    output:
        table="results/tables/allen_overturning.csv",
        findings="results/findings/allen_overturning.json",
    log:
        "results/logs/allen_overturning.log",
    benchmark:
        "results/benchmarks/allen_overturning.tsv"
    params:
        case=config["allen_overturning"],
    message:
        "Allen et al.: overturning misjudged"
    script:
        "allen_overturning.py"


# 6. Top-heavy is more stable: the conclusions ----------------------------------------------------


rule heavier:
    input:
        code("src/steps/heavier.py"),
    output:
        histories="results/tables/heavier_histories.csv",
        summary="results/tables/heavier.csv",
        findings="results/findings/heavier.json",
    log:
        "results/logs/heavier.log",
    benchmark:
        "results/benchmarks/heavier.tsv"
    params:
        case=case("heavier"),
        solver=config["solver"],
    message:
        "The same pulse under heavier and heavier caps"
    script:
        "heavier.py"


rule vase:
    input:
        code("src/steps/vase.py"),
        records=record_paths(config["vase"]["records"], RECORDS),
    output:
        summary="results/tables/vase.csv",
        motions="results/tables/vase_motions.csv",
        exceptions="results/tables/vase_exceptions.csv",
        shares="results/tables/vase_shares.csv",
        poses="results/tables/vase_poses.csv",
        findings="results/findings/vase.json",
    log:
        "results/logs/vase.log",
    benchmark:
        "results/benchmarks/vase.tsv"
    params:
        case=case("vase"),
        solver=config["solver"],
    message:
        "The same mass fixed to one column, and carried freely by two"
    script:
        "vase.py"


rule uplift_limits:
    input:
        code("src/steps/uplift_limits.py"),
        records=record_paths(config["uplift_limits"]["records"], RECORDS),
    output:
        table="results/tables/uplift_limits.csv",
        ratios="results/tables/uplift_ratios.csv",
        slopes="results/tables/uplift_slopes.csv",
        findings="results/findings/uplift_limits.json",
    log:
        "results/logs/uplift_limits.log",
    benchmark:
        "results/benchmarks/uplift_limits.tsv"
    params:
        case=case("uplift_limits"),
    message:
        "The forces of frames that rock, and of frames held against uplift"
    script:
        "uplift_limits.py"


rule scale_effects:
    input:
        code("src/steps/scale_effects.py"),
    output:
        table="results/tables/scale_effects.csv",
        findings="results/findings/scale_effects.json",
    log:
        "results/logs/scale_effects.log",
    benchmark:
        "results/benchmarks/scale_effects.tsv"
    params:
        case=case("scale_effects"),
        solver=config["solver"],
    message:
        "Housner's two scale effects"
    script:
        "scale_effects.py"


rule stability:
    input:
        code("src/steps/stability.py"),
    output:
        findings="results/findings/stability.json",
    log:
        "results/logs/stability.log",
    benchmark:
        "results/benchmarks/stability.tsv"
    params:
        case=case("stability"),
        solver=config["solver"],
    message:
        "Is the heavier, the larger always the more stable?"
    script:
        "stability.py"


# 7. Overturning and rocking spectra ---------------------------------------------------------------


rule spectra_shard:
    input:
        code("src/steps/spectra_shard.py"),
    output:
        table="results/shards/spectra_{scatteritem}.csv",
    log:
        "results/logs/spectra_shard_{scatteritem}.log",
    benchmark:
        "results/benchmarks/spectra_shard_{scatteritem}.tsv"
    params:
        case=config["spectra"],
    message:
        "Overturning spectra, shard {wildcards.scatteritem}"
    script:
        "spectra_shard.py"


rule spectra:
    input:
        code("src/steps/spectra.py"),
        shards=gather.spectra("results/shards/spectra_{scatteritem}.csv"),
    output:
        table="results/tables/spectra.csv",
        areas="results/tables/spectra_areas.csv",
        findings="results/findings/spectra.json",
    log:
        "results/logs/spectra.log",
    benchmark:
        "results/benchmarks/spectra.tsv"
    params:
        case=config["spectra"],
        solver=config["solver"],
    message:
        "What the overturning spectra say about heavier caps"
    script:
        "spectra.py"


rule spectra_dimensional:
    input:
        code("src/steps/spectra_dimensional.py"),
    output:
        table="results/tables/spectra_dimensional.csv",
        published="results/tables/spectra_published.csv",
        findings="results/findings/spectra_dimensional.json",
    log:
        "results/logs/spectra_dimensional.log",
    benchmark:
        "results/benchmarks/spectra_dimensional.tsv"
    params:
        case=config["spectra_dimensional"],
        structures=named(config["structures"], config["spectra_dimensional"]),
        solver=config["solver"],
    message:
        "Overturning spectra of the trilith and of a bridge"
    script:
        "spectra_dimensional.py"


rule peak_maps:
    input:
        code("src/steps/peak_maps.py"),
    output:
        table="results/tables/peak_maps.csv",
    log:
        "results/logs/peak_maps.log",
    benchmark:
        "results/benchmarks/peak_maps.tsv"
    params:
        case=case("peak_maps"),
    message:
        "How far they rock, over frequency and amplitude"
    script:
        "peak_maps.py"


rule rocking_spectra:
    input:
        code("src/steps/rocking_spectra.py"),
        records=record_paths(config["rocking_spectra"]["records"], RECORDS),
    output:
        table="results/tables/rocking_spectra.csv",
        findings="results/findings/rocking_spectra.json",
    log:
        "results/logs/rocking_spectra.log",
    benchmark:
        "results/benchmarks/rocking_spectra.tsv"
    params:
        case=case("rocking_spectra"),
        solver=config["solver"],
    message:
        "Real records under columns of every size"
    script:
        "rocking_spectra.py"


# What the paper says in words ---------------------------------------------------------------------


rule statements:
    input:
        code("src/steps/statements.py"),
    output:
        findings="results/findings/statements.json",
    log:
        "results/logs/statements.log",
    benchmark:
        "results/benchmarks/statements.tsv"
    params:
        case=case("statements"),
        solver=config["solver"],
    message:
        "What the paper says in words"
    script:
        "statements.py"


# What the paper leaves open ------------------------------------------------------------------------


rule assumptions:
    input:
        code("src/steps/assumptions/run.py"),
        assumptions="paper/assumptions.yaml",
        ledger=PARTS[PAPER].claims,
        records=record_paths(config["assumptions"]["records"], RECORDS),
    output:
        table="results/tables/assumptions.csv",
    log:
        "results/logs/assumptions.log",
    benchmark:
        "results/benchmarks/assumptions.tsv"
    params:
        cases={
            name: case(name)
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
    message:
        "What the paper leaves open, chosen otherwise"
    script:
        "assumptions/run.py"


# How far the numbers can be trusted --------------------------------------------------------------


rule verification:
    input:
        code("src/steps/verification.py"),
    output:
        routes="results/tables/verification_routes.csv",
        convergence="results/tables/verification_convergence.csv",
        published="results/tables/verification_published.csv",
        findings="results/findings/verification.json",
    log:
        "results/logs/verification.log",
    benchmark:
        "results/benchmarks/verification.tsv"
    params:
        case=config["verification"],
        solver=config["solver"],
    message:
        "Routes against each other, and ours against the literature"
    script:
        "verification.py"


# Pictures, notebooks -----------------------------------------------------------------------------


rule animation:
    input:
        code("src/steps/animation.py"),
        style="figures/style.mplstyle",
    output:
        "results/animation.gif",
        shown("results/animation.png"),
    log:
        "results/logs/animation.log",
    benchmark:
        "results/benchmarks/animation.tsv"
    params:
        case=case("animation"),
    message:
        "The animation: the column overturns, the frame survives"
    script:
        "animation.py"


rule explorer:
    input:
        code("src/steps/explorer.py"),
        sorted(str(path) for path in Path("explorer").rglob("*") if path.is_file()),
        record=RECORDS["el_centro_1940_NS"],
    output:
        "results/explorer.html",
    log:
        "results/logs/explorer.log",
    benchmark:
        "results/benchmarks/explorer.tsv"
    message:
        "The page to play with"
    script:
        "explorer.py"
