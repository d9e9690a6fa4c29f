"""Every result of Makris & Vassiliou (2014), in the paper's order.

config → steps → results → figures, notebooks, claims → report
"""

import json
import os
import sys
from pathlib import Path

# What the scripts share: workbench and its like, and drawing. Their processes inherit this path.
SHARED = [
    str(Path(workflow.basedir, folder)) for folder in ("", "src/steps", "figures")
]
sys.path[:0] = SHARED
os.environ |= {
    "PYTHONPATH": os.pathsep.join(
        SHARED + os.getenv("PYTHONPATH", "").split(os.pathsep)
    )
}
from captions import caption_files, captioned, read_captions
from configuration import check_config, record_files
from ledger import read_ledger
from study_config import read_study_config

from replication.code import code
from replication.typeset import reads


configfile: "config/config.yaml"


# Those of --configfile, which are merged over config.yaml, come first.
check_config(
    config,
    " over ".join(dict.fromkeys(map(os.path.relpath, workflow.configfiles))),
    "config/config.schema.yaml",
)

RECORDS = record_files()


include: "src/steps/common.smk"


# The overturning spectra are dealt out to so many jobs, which an executor may spread over machines.
scattergather:
    spectra=config["spectra"]["shards"],


# Which tables each figure, named by its script, is drawn from.
FIGURES = {
    "figures/structures": ["outlines", "moment_rotation"],
    "figures/free_body": ["outlines", "free_body"],
    "figures/mass_ratio": ["mass_ratio"],
    "figures/restitution": [
        "restitution_over_slenderness",
        "restitution_over_mass_ratio",
    ],
    "figures/quarter_period": ["quarter_period"],
    "figures/trilith_map": ["trilith_map", "trilith_nearness"],
    "figures/trilith_starts": ["trilith_starts", "trilith_histories"],
    "figures/allen_histories": ["allen_histories"],
    "figures/allen_errors": ["allen_errors"],
    "figures/allen_overturning": ["allen_overturning"],
    "figures/heavier": ["heavier_histories", "heavier"],
    "figures/vase": ["vase", "vase_poses"],
    "figures/scale_effects": ["scale_effects"],
    "figures/spectra": ["spectra"],
    "figures/spectra_modes": ["spectra"],
    "figures/spectra_dimensional": ["spectra_dimensional", "spectra_published"],
    "figures/peak_maps": ["peak_maps"],
    "figures/rocking_spectra": ["rocking_spectra"],
}


# What the claims of the ledger are judged by: the findings of these rules.
FINDINGS = [
    "equations",
    "mass_ratio",
    "restitution",
    "moment_rotation",
    "trilith",
    "allen_histories",
    "allen_errors",
    "allen_overturning",
    "heavier",
    "vase",
    "scale_effects",
    "stability",
    "spectra",
    "spectra_dimensional",
    "rocking_spectra",
    "statements",
    "verification",
]

# Findings that no claim rests on, and without which no claim is worth much.
CHECKS = {
    "verification": [
        "routes_agree",
        "published_numbers",
        "library_follows_the_derivation",
    ],
    "vase": ["second_route"],
    "spectra": ["sample_agrees"],
    "spectra_dimensional": ["published_amplitude"],
    "rocking_spectra": ["second_route"],
}

NOTEBOOKS = ["derivation", "play"]
REFERENCES = sorted(map(str, Path("tests/reference").glob("*.csv")))

# Follow-up studies, each a folder: their rules add to FIGURES and FINDINGS (see FOLLOW-UP.md).
STUDIES = config["studies"]
STUDY_CONFIG = {name: read_study_config(name, config["structures"]) for name in STUDIES}
LEDGER = ["paper/claims.yaml", *(f"studies/{name}/claims.yaml" for name in STUDIES)]
CLAIMS = read_ledger(LEDGER)
SECTIONS = [f"studies/{name}/section.typ" for name in STUDIES]

for name in STUDIES:

    include: f"studies/{name}/study.smk"


rule all:
    default_target: True
    input:
        everything,
        "results/manifest.json",


onstart:
    # Every record is read before anything is computed: a bad one is told at once.
    from topheavy import read_record

    for path in RECORDS.values():
        read_record(path)


onsuccess:
    if "all" in {rule.name for rule in workflow.dag.targetrules}:
        print(Path("results/summary.txt").read_text())


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
        "src/steps/equations.py"


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
        "src/steps/mass_ratio.py"


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
        "src/steps/restitution.py"


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
        "src/steps/moment_rotation.py"


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
        "src/steps/sketches.py"


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
        solver=config["solver"],
    message:
        "The trilith: its numbers, what would have lifted it, how the table starts"
    script:
        "src/steps/trilith.py"


rule trilith_map:
    input:
        code("src/steps/trilith_map.py"),
    output:
        table="results/tables/trilith_map.csv",
    log:
        "results/logs/trilith_map.log",
    benchmark:
        "results/benchmarks/trilith_map.tsv"
    params:
        case=case("trilith_map"),
    message:
        "The trilith over amplitude and frequency of the table"
    script:
        "src/steps/trilith_map.py"


# 5. Allen et al. (1986): linearised, massless columns --------------------------------------------


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
        "src/steps/allen_histories.py"


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
        "src/steps/allen_errors.py"


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
        "src/steps/allen_overturning.py"


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
        "src/steps/heavier.py"


rule vase:
    input:
        code("src/steps/vase.py"),
        records=[RECORDS[name] for name in config["vase"]["records"]],
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
        "src/steps/vase.py"


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
        "src/steps/scale_effects.py"


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
        "src/steps/stability.py"


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
    threads: 2
    params:
        case=config["spectra"],
    message:
        "Overturning spectra, shard {wildcards.scatteritem}"
    script:
        "src/steps/spectra_shard.py"


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
        "src/steps/spectra.py"


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
    threads: 2
    params:
        case=config["spectra_dimensional"],
        structures=named(config["structures"], config["spectra_dimensional"]),
        solver=config["solver"],
    message:
        "Overturning spectra of the trilith and of a bridge"
    script:
        "src/steps/spectra_dimensional.py"


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
        "src/steps/peak_maps.py"


rule rocking_spectra:
    input:
        code("src/steps/rocking_spectra.py"),
        records=[RECORDS[name] for name in config["rocking_spectra"]["records"]],
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
        "src/steps/rocking_spectra.py"


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
        "src/steps/statements.py"


# What the paper leaves open ------------------------------------------------------------------------


rule assumptions:
    input:
        code("src/steps/assumptions/run.py"),
        assumptions="paper/assumptions.yaml",
        ledger="paper/claims.yaml",
        records=[RECORDS[name] for name in config["assumptions"]["records"]],
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
        "src/steps/assumptions/run.py"


# Figures -----------------------------------------------------------------------------------------


rule figure:
    input:
        lambda wildcards: code(f"{wildcards.figure}.py"),
        tables=lambda wildcards: expand(
            "results/tables/{table}.csv", table=FIGURES[wildcards.figure]
        ),
        style="figures/style.mplstyle",
    output:
        shown("{figure}.svg"),
    log:
        "results/logs/{figure}.log",
    wildcard_constraints:
        figure="|".join(FIGURES),
    message:
        "Figure {wildcards.figure}"
    script:
        "{wildcards.figure}.py"


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
        "src/steps/verification.py"


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
        "The column topples, the frame stands: the moving picture"
    script:
        "src/steps/animation.py"


rule notebook:
    input:
        code("src/steps/notebook.py"),
        notebook="notebooks/{name}.ipynb",
        record="data/records/el_centro_1940_NS.AT2",
    output:
        executed="results/notebooks/{name}.ipynb",
        page="results/notebooks/{name}.html",
    log:
        "results/logs/notebook_{name}.log",
    benchmark:
        "results/benchmarks/notebook_{name}.tsv"
    message:
        "Executing the notebook {wildcards.name}"
    script:
        "src/steps/notebook.py"


# The ledger judged, and the end of the run -------------------------------------------------------


rule claims:
    input:
        code("src/steps/claims.py"),
        ledger=LEDGER,
        findings=expand("results/findings/{name}.json", name=FINDINGS),
    output:
        "results/claims.json",
    log:
        "results/logs/claims.log",
    message:
        "Judging every claim"
    script:
        "src/steps/claims.py"


rule compare:
    input:
        code("src/steps/compare.py"),
        tables=[
            path.replace("tests/reference", "results/tables") for path in REFERENCES
        ],
        references=REFERENCES,
        config="tests/reference/config.yaml",
    output:
        table="results/comparison.csv",
        config="results/config.yaml",
    log:
        "results/logs/compare.log",
    params:
        config=config,
    message:
        "Comparing the tables with the reference tables"
    script:
        "src/steps/compare.py"


rule verdict:
    input:
        code("src/steps/verdict.py"),
        claims="results/claims.json",
        comparison="results/comparison.csv",
        findings=expand("results/findings/{rule}.json", rule=CHECKS),
    output:
        "results/summary.txt",
    log:
        "results/logs/verdict.log",
    params:
        checks=CHECKS,
    message:
        "Holding the verdicts against what is expected of them"
    script:
        "src/steps/verdict.py"


rule costs:
    input:
        code("src/steps/costs.py"),
        expand("results/findings/{name}.json", name=FINDINGS),
        expand(
            "results/notebooks/{name}.{kind}", name=NOTEBOOKS, kind=["ipynb", "html"]
        ),
        "results/tables/trilith_map.csv",
    output:
        "results/costs.csv",
    log:
        "results/logs/costs.log",
    message:
        "Adding up what the run cost"
    script:
        "src/steps/costs.py"


rule report:
    input:
        code("src/steps/report.py"),
        reads("paper/report.typ", *SECTIONS),
        expand("results/findings/{name}.json", name=FINDINGS),
        expand("{figure}.svg", figure=FIGURES),
    output:
        "paper/report.pdf",
    log:
        "results/logs/report.log",
    benchmark:
        "results/benchmarks/report.tsv"
    params:
        source="paper/report.typ",
        studies=STUDIES,
    message:
        "Compiling the report"
    script:
        "src/steps/report.py"


# The audit: what was made and by what, each claim by itself ---------------------------------------


rule manifest:
    input:
        code("src/steps/manifest.py"),
        everything,
        configuration="config/config.yaml",
        lock="uv.lock",
    output:
        "results/manifest.json",
    log:
        "results/logs/manifest.log",
    params:
        # what a run measures, and what make html and make benchmark write
        differs_each_run=[
            *rules.costs.output,
            "results/report.html",
            "results/benchmark",
        ],
    message:
        "Listing every output with its checksum"
    script:
        "src/steps/manifest.py"


# `snakemake --cores 2 claim_<id>` computes what the claim needs, and says how it came out.
for claim in CLAIMS:

    rule:
        name:
            f"claim_{claim['id']}"
        input:
            code("src/steps/claim.py"),
            findings=f"results/findings/{claim['rule']}.json" if "rule" in claim else [],
        log:
            f"results/logs/claim_{claim['id']}.log",
        params:
            claim=claim,
        message:
            f"Judging {claim['id']}"
        script:
            "src/steps/claim.py"
