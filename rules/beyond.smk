"""What we add to the paper's results."""

# First half: motions, break_even, records ------------------------------------------------------------

HORIZONTAL, UPWARD = components("data/records")


scattergather:
    motions=PAPER["motions"]["shards"],


rule motions_shard:
    input:
        kernel="results/kernel.compiled",
    output:
        outcomes="results/shards/motions_{scatteritem}.npz",
    log:
        "results/logs/motions_{scatteritem}.log",
    priority: 1
    params:
        code=code("src/steps/shared/sweep.py", rule="motions_shard"),
        shard="{scatteritem}",
        settings=PAPER["motions"],
        break_even=PAPER["break_even"],
        structures=PAPER["structures"],
    message:
        "Synthetic ground motions, part {wildcards.scatteritem}"
    script:
        "../src/steps/shared/sweep.py"


rule motions:
    input:
        shards=gather.motions("results/shards/motions_{scatteritem}.npz"),
    output:
        probabilities=shown("results/tables/motions.csv"),
        gains=shown("results/tables/motions_gains.csv"),
        pairs="results/tables/motions_pairs.csv",
        harmonic="results/tables/motions_harmonic.csv",
        fragility="results/tables/motions_fragility.csv",
        rotations="results/tables/motions_rotations.csv",
        findings="results/findings/motions.json",
    log:
        "results/logs/motions.log",
    priority: 1
    params:
        code=code("src/steps/beyond/motions.py"),
        settings=PAPER["motions"],
        structures=PAPER["structures"],
        counts=["only_frame"],  # of outcomes
    message:
        "Synthetic ground motions: probabilities and gains"
    script:
        "../src/steps/beyond/motions.py"


rule break_even:
    input:
        shards=gather.motions("results/shards/motions_{scatteritem}.npz"),
    output:
        ends="results/tables/break_even.csv",
        benefits="results/tables/break_even_benefit.csv",
        findings="results/findings/break_even.json",
    log:
        "results/logs/break_even.log",
    params:
        code=code("src/steps/beyond/break_even.py"),
        settings=PAPER["break_even"],
        motions=PAPER["motions"],
        structures=PAPER["structures"],
    message:
        "The reduction of √r at which the benefit ends"
    script:
        "../src/steps/beyond/break_even.py"


rule records:
    input:
        components=HORIZONTAL,
        kernel="results/kernel.compiled",
    output:
        table="results/tables/records.csv",
        structures="results/tables/records_structures.csv",
        capacity="results/tables/records_capacity.csv",
        findings="results/findings/records.json",
    log:
        "results/logs/records.log",
    params:
        code=code("src/steps/beyond/records.py"),
        settings=PAPER["records"],
        solver=PAPER["solver"],
        structures=PAPER["structures"],
        counts=["only_lighter", "only_heavier"],  # of outcomes
    message:
        "Measured ground motions"
    script:
        "../src/steps/beyond/records.py"


# Second half: friction, designers, engine -----------------------------------------------------------------------


rule friction:
    input:
        kernel="results/kernel.compiled",
    output:
        pulses="results/tables/friction_pulses.csv",
        by_mass="results/tables/friction_by_mass.csv",
        findings="results/findings/friction.json",
    log:
        "results/logs/friction.log",
    params:
        code=code("src/steps/beyond/friction.py"),
        settings=PAPER["friction"],
        structures=PAPER["structures"],
        counts=["survived"],  # of outcomes
    message:
        "Required coefficients of friction"
    script:
        "../src/steps/beyond/friction.py"


rule contacts:
    input:
        "results/tables/vase.csv",
        "results/tables/four_structures.csv",
        "results/tables/spectra_histories.csv",
        "results/tables/spectra_falls.csv",
        "results/tables/spectra_two_pulses.csv",
    output:
        contacts="results/tables/contacts.csv",
        maps="results/tables/contacts_maps.csv",
        findings="results/findings/contacts.json",
    log:
        "results/logs/contacts.log",
    params:
        code=code("src/steps/beyond/contacts.py"),
        settings=PAPER["contacts"],
        structures=PAPER["structures"],
        of_vase=PAPER["vase"],
        of_maps=PAPER["spectra"],
    message:
        "Contacts along the quoted motions"
    script:
        "../src/steps/beyond/contacts.py"


rule worst_found:
    input:
        kernel="results/kernel.compiled",
        cases="data/worst_found.yaml",
        sentences="paper/sentences.yaml",
    output:
        worst=shown("results/tables/worst_found.csv"),
        motions="results/tables/worst_found_motions.csv",
        findings="results/findings/worst_found.json",
    log:
        "results/logs/worst_found.log",
    params:
        code=code("src/steps/beyond/worst_found.py"),
        spec=PAPER["spectra"]["cycles"],
        contacts=PAPER["contacts"],
        column=PAPER["structures"]["temple"],
    message:
        "The worst motions found against each sentence"
    script:
        "../src/steps/beyond/worst_found.py"


rule designers:
    input:
        "results/tables/motions_gains.csv",
        "results/tables/motions_rotations.csv",
        "results/tables/uplift.csv",
        "results/tables/friction_by_mass.csv",
    output:
        table=shown("results/tables/designers.csv"),
        findings="results/findings/designers.json",
    log:
        "results/logs/designers.log",
    params:
        code=code("src/steps/beyond/designers.py"),
        settings=PAPER["designers"],
        friction=PAPER["friction"],
        structures=PAPER["structures"],
    message:
        "The table for designers"
    script:
        "../src/steps/beyond/designers.py"


rule engine:
    input:
        kernel="results/kernel.compiled",
    output:
        restitution="results/tables/engine_restitution.csv",
        outcomes="results/tables/engine_outcomes.csv",
        across="results/tables/engine_across.csv",
        findings="results/findings/engine.json",
    log:
        "results/logs/engine.log",
    priority: 1
    params:
        code=code("src/steps/beyond/engine.py"),
        settings=PAPER["engine"],
        structures=PAPER["structures"],
    message:
        "Structures in general rigid-body engines (pymunk, MuJoCo)"
    script:
        "../src/steps/beyond/engine.py"


rule colonnades:
    input:
        kernel="results/kernel.compiled",
    output:
        table="results/tables/colonnades.csv",
        findings="results/findings/colonnades.json",
    log:
        "results/logs/colonnades.log",
    params:
        code=code("src/steps/beyond/colonnades.py"),
        settings=PAPER["colonnades"],
        structures=PAPER["structures"],
    message:
        "Colonnades with one stone per bay (pymunk)"
    script:
        "../src/steps/beyond/colonnades.py"


rule gaps:
    output:
        table="results/tables/gaps.csv",
        findings="results/findings/gaps.json",
    log:
        "results/logs/gaps.log",
    priority: 1
    params:
        code=code("src/steps/beyond/gaps.py"),
        settings=PAPER["gaps"],
        trilith=PAPER["trilith"],
        structures=PAPER["structures"],
    message:
        "The trilith with gaps in its contacts (MuJoCo)"
    script:
        "../src/steps/beyond/gaps.py"


rule test_plan:
    input:
        kernel="results/kernel.compiled",
    output:
        table="results/tables/test_plan.csv",
        findings="results/findings/test_plan.json",
    log:
        "results/logs/test_plan.log",
    params:
        code=code("src/steps/beyond/test_plan.py"),
        settings=PAPER["test_plan"],
    message:
        "The shake-table test that could refute the answer"
    script:
        "../src/steps/beyond/test_plan.py"
