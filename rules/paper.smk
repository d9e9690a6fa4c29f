"""The paper's results, in its order."""

# First part: kernel, equations, parameters, trilith, allen, statements, verification ---------------


rule kernel:
    output:
        touch("results/kernel.compiled"),
    log:
        "results/logs/kernel.log",
    priority: 4
    params:
        code=code("src/steps/kernel.py"),
    message:
        "Compiling the solver, once for all jobs"
    script:
        "../src/steps/kernel.py"


rule equations:
    output:
        equations="results/tables/equations.csv",
        theorems="results/tables/theorems.csv",
        findings="results/findings/equations.json",
    log:
        "results/logs/equations.log",
    priority: 3
    params:
        code=code("src/steps/equations.py"),
    message:
        "Equations of the paper: each printed one, and the theorems"
    script:
        "../src/steps/equations.py"


rule parameters:
    input:
        kernel="results/kernel.compiled",
    output:
        mass_ratio=shown("results/tables/mass_ratio.csv"),
        restitution="results/tables/restitution.csv",
        moment_rotation="results/tables/moment_rotation.csv",
        four_structures="results/tables/four_structures.csv",
        findings="results/findings/parameters.json",
    log:
        "results/logs/parameters.log",
    priority: 3
    params:
        code=code("src/steps/parameters.py"),
        settings=PAPER["parameters"],
        structures=PAPER["structures"],
    message:
        "Results of the paper: p̂ and R̂ over γ, √r over α, moments over rotation"
    script:
        "../src/steps/parameters.py"


rule trilith:
    input:
        kernel="results/kernel.compiled",
    output:
        trilith_numbers=shown("results/tables/trilith_numbers.csv"),
        trilith_thresholds="results/tables/trilith_thresholds.csv",
        trilith_starts="results/tables/trilith_starts.csv",
        trilith_histories="results/tables/trilith_histories.csv",
        trilith_map="results/tables/trilith_map.csv",
        findings="results/findings/trilith.json",
    log:
        "results/logs/trilith.log",
    priority: 3
    params:
        code=code("src/steps/trilith.py"),
        settings=PAPER["trilith"],
        structures=PAPER["structures"],
        solver=PAPER["solver"],
    message:
        "Results of the paper: the trilith"
    script:
        "../src/steps/trilith.py"


rule allen:
    input:
        record="data/records/el_centro_1940_NS.AT2",
        kernel="results/kernel.compiled",
    output:
        allen_histories="results/tables/allen_histories.csv",
        allen_errors=shown("results/tables/allen_errors.csv"),
        allen_maps="results/tables/allen_maps.csv",
        findings="results/findings/allen.json",
    log:
        "results/logs/allen.log",
    priority: 3
    params:
        code=code("src/steps/allen.py"),
        settings=PAPER["allen"],
        structures=PAPER["structures"],
        solver=PAPER["solver"],
        counts=["exact", "linearised", "all"],  # of outcomes
    message:
        "Results of the paper: the comparison with Allen et al."
    script:
        "../src/steps/allen.py"


rule statements:
    input:
        kernel="results/kernel.compiled",
    output:
        three_bodies="results/tables/three_bodies.csv",
        statements="results/tables/statements.csv",
        findings="results/findings/statements.json",
    log:
        "results/logs/statements.log",
    params:
        code=code("src/steps/statements.py"),
        settings=PAPER["statements"],
        structures=PAPER["structures"],
    message:
        "Results of the paper: its statements in words, and three rigid bodies"
    script:
        "../src/steps/statements.py"


rule verification:
    input:
        kernel="results/kernel.compiled",
    output:
        verification_routes="results/tables/verification_routes.csv",
        verification_published="results/tables/verification_published.csv",
        verification_closed_forms="results/tables/verification_closed_forms.csv",
        verification_order="results/tables/verification_order.csv",
        findings="results/findings/verification.json",
    log:
        "results/logs/verification.log",
    params:
        code=code("src/steps/verification.py"),
        settings=PAPER["verification"],
        solver=PAPER["solver"],
        counts=["order_lost", "lighter_first", "samples_beyond_alpha"],  # of outcomes
    message:
        "Comparing solvers with each other and with the literature"
    script:
        "../src/steps/verification.py"


# Second part: spectra, vase, proven, uplift; the animation and the page ----------------------------


scattergather:
    spectra=PAPER["spectra"]["shards"],


rule spectra_shard:
    input:
        kernel="results/kernel.compiled",
    output:
        spectra="results/shards/spectra_{scatteritem}.csv",
        cycles="results/shards/cycles_{scatteritem}.txt",
    log:
        "results/logs/spectra_{scatteritem}.log",
    priority: 2
    params:
        code=code("src/steps/shared/spectrum.py", rule="spectra_shard"),
        settings=PAPER["spectra"],
        shard="{scatteritem}",
    message:
        "Overturning spectra, part {wildcards.scatteritem}"
    script:
        "../src/steps/shared/spectrum.py"


rule spectra:
    input:
        shards=gather.spectra("results/shards/spectra_{scatteritem}.csv"),
        several=gather.spectra("results/shards/cycles_{scatteritem}.txt"),
    output:
        spectra=shown("results/tables/spectra.csv"),
        areas="results/tables/spectra_areas.csv",
        histories="results/tables/spectra_histories.csv",
        collapse="results/tables/spectra_collapse.csv",
        cycles="results/tables/spectra_cycles.csv",
        falls="results/tables/spectra_falls.csv",
        two_pulses="results/tables/spectra_two_pulses.csv",
        findings="results/findings/spectra.json",
    log:
        "results/logs/spectra.log",
    priority: 2
    params:
        code=code("src/steps/spectra.py"),
        settings=PAPER["spectra"],
        tightened=PAPER["solver"]["tightened"],
    message:
        "Overturning spectra: is a heavier beam more stable?"
    script:
        "../src/steps/spectra.py"


rule vase:
    input:
        kernel="results/kernel.compiled",
    output:
        vase=shown("results/tables/vase.csv"),
        motions="results/tables/vase_motions.csv",
        poses="results/tables/vase_poses.csv",
        findings="results/findings/vase.json",
    log:
        "results/logs/vase.log",
    priority: 2
    params:
        code=code("src/steps/vase.py"),
        settings=PAPER["vase"],
        column=PAPER["structures"]["temple"],
    message:
        "Minimum overturning accelerations: column, fixed mass and frame"
    script:
        "../src/steps/vase.py"


rule guarantee:
    input:
        kernel="results/kernel.compiled",
    output:
        guarantee=shown("results/tables/guarantee.csv"),
        visits="results/tables/guarantee_visits.csv",
        attack="results/tables/guarantee_attack.csv",
        motions="results/tables/guarantee_motions.csv",
        order="results/tables/guarantee_order.csv",
        findings="results/findings/guarantee.json",
    log:
        "results/logs/guarantee.log",
    params:
        code=code("src/steps/guarantee.py"),
        settings=PAPER["guarantee"],
        structures=PAPER["structures"],
    message:
        "Ground velocities below which nothing overturns"
    script:
        "../src/steps/guarantee.py"


rule proven:
    input:
        "results/tables/vase.csv",
        "results/tables/spectra_histories.csv",
    output:
        table="results/tables/proven.csv",
        findings="results/findings/proven.json",
    log:
        "results/logs/proven.log",
    priority: 2
    params:
        code=code("src/steps/proven.py"),
        column=PAPER["structures"]["temple"],
        period=PAPER["vase"]["period"],
    message:
        "Proving minima with balls of numbers"
    script:
        "../src/steps/proven.py"


rule uplift:
    input:
        kernel="results/kernel.compiled",
    output:
        table="results/tables/uplift.csv",
        findings="results/findings/uplift.json",
    log:
        "results/logs/uplift.log",
    params:
        code=code("src/steps/uplift.py"),
        settings=PAPER["uplift"],
        column=PAPER["structures"]["temple"],
    message:
        "Forces of structures that uplift"
    script:
        "../src/steps/uplift.py"


rule animation:
    input:
        style="figures/style.mplstyle",
        kernel="results/kernel.compiled",
    output:
        gif="results/animation.gif",
    log:
        "results/logs/animation.log",
    params:
        code=code("src/documents/animation.py", "figures/palette.py"),
        settings=PAPER["animation"],
        column=PAPER["structures"]["temple"],
    message:
        "Drawing the animation of README"
    script:
        "../src/documents/animation.py"


rule explorer:
    input:
        sorted(filter(os.path.isfile, glob("src/explorer/**", recursive=True))),
        record="data/records/el_centro_1940_NS.AT2",
        kernel="results/kernel.compiled",
    output:
        page="results/explorer.html",
    log:
        "results/logs/explorer.log",
    params:
        code=code("src/documents/explorer.py"),
    message:
        "Writing the page to play with"
    script:
        "../src/documents/explorer.py"
