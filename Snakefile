"""Every result of Makris & Vassiliou (2014), in the paper's order.

config → steps → results → figures, notebooks, claims → report
"""

import sys
from pathlib import Path

sys.path.insert(0, "src/steps")
from configuration import check_config


configfile: "config/config.yaml"


check_config(config, "config/config.yaml", "config/config.schema.yaml")

# Code that Snakemake does not see through a script's imports, so that a change reruns its users.
WORKBENCH = ["src/steps/workbench.py"]
LIBRARY = [*map(str, sorted(Path("src/topheavy").glob("*.py"))), *WORKBENCH]
DERIVATION = [*map(str, sorted(Path("src/topheavy/derivation").glob("*.py"))), *WORKBENCH]

# Which tables each figure is drawn from.
FIGURES = {
    "structures": ["outlines", "moment_rotation"],
    "free_body": ["outlines", "free_body"],
    "mass_ratio": ["mass_ratio"],
    "restitution": ["restitution_over_slenderness", "restitution_over_mass_ratio"],
    "quarter_period": ["quarter_period"],
    "trilith_map": ["trilith_map", "trilith_nearness"],
    "trilith_starts": ["trilith_starts", "trilith_histories"],
    "allen_histories": ["allen_histories"],
    "allen_errors": ["allen_errors"],
    "allen_overturning": ["allen_overturning"],
    "heavier": ["heavier_histories", "heavier"],
    "scale_effects": ["scale_effects"],
}


rule all:
    input:
        expand("results/tables/{t}.csv", t=["equations", "mass_ratio","restitution_over_slenderness","moment_rotation","trilith_nearness","trilith_map","allen_histories","allen_errors","allen_overturning","heavier","scale_effects"]),


# The derivation: Eqs. (1)–(25) -------------------------------------------------------------------


rule equations:
    input:
        DERIVATION,
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
        LIBRARY,
    output:
        table="results/tables/mass_ratio.csv",
        findings="results/findings/mass_ratio.json",
    params:
        case=config["mass_ratio"],
    log:
        "results/logs/mass_ratio.log",
    benchmark:
        "results/benchmarks/mass_ratio.tsv"
    message:
        "p̂ and R̂ over γ"
    script:
        "src/steps/mass_ratio.py"


# 2. Restitution: Eq. (25) ------------------------------------------------------------------------


rule restitution:
    input:
        LIBRARY,
    output:
        over_slenderness="results/tables/restitution_over_slenderness.csv",
        over_mass_ratio="results/tables/restitution_over_mass_ratio.csv",
        findings="results/findings/restitution.json",
    params:
        case=config["restitution"],
    log:
        "results/logs/restitution.log",
    benchmark:
        "results/benchmarks/restitution.tsv"
    message:
        "√r over slenderness and γ"
    script:
        "src/steps/restitution.py"


# 3. Moment–rotation and free rocking: Fig. 1(b) --------------------------------------------------


rule moment_rotation:
    input:
        LIBRARY,
    output:
        moments="results/tables/moment_rotation.csv",
        periods="results/tables/quarter_period.csv",
        findings="results/findings/moment_rotation.json",
    params:
        case=config["moment_rotation"],
        structures=config["structures"],
    log:
        "results/logs/moment_rotation.log",
    benchmark:
        "results/benchmarks/moment_rotation.tsv"
    message:
        "Moment–rotation and the period of free rocking"
    script:
        "src/steps/moment_rotation.py"


# 4. The trilith of Peña et al. (2008): p. 3 ------------------------------------------------------


rule trilith:
    input:
        LIBRARY,
    output:
        nearness="results/tables/trilith_nearness.csv",
        starts="results/tables/trilith_starts.csv",
        histories="results/tables/trilith_histories.csv",
        findings="results/findings/trilith.json",
    params:
        case=config["trilith"],
        structures=config["structures"],
        solver=config["solver"],
    log:
        "results/logs/trilith.log",
    benchmark:
        "results/benchmarks/trilith.tsv"
    message:
        "The trilith: its numbers, what would have lifted it, how the table starts"
    script:
        "src/steps/trilith.py"


rule trilith_map:
    input:
        LIBRARY,
    output:
        table="results/tables/trilith_map.csv",
    params:
        case=config["trilith_map"],
        structures=config["structures"],
    log:
        "results/logs/trilith_map.log",
    benchmark:
        "results/benchmarks/trilith_map.tsv"
    message:
        "The trilith over amplitude and frequency of the table"
    script:
        "src/steps/trilith_map.py"


# 5. Allen et al. (1986): linearised, massless columns --------------------------------------------


rule allen_histories:
    input:
        LIBRARY,
        record=f"data/records/{config['allen_histories']['record']['file']}.AT2",
    output:
        table="results/tables/allen_histories.csv",
        findings="results/findings/allen_histories.json",
    params:
        case=config["allen_histories"],
        structures=config["structures"],
        solver=config["solver"],
    log:
        "results/logs/allen_histories.log",
    benchmark:
        "results/benchmarks/allen_histories.tsv"
    message:
        "Allen et al.: histories under a pulse and a record"
    script:
        "src/steps/allen_histories.py"


rule allen_errors:
    input:
        LIBRARY,
    output:
        table="results/tables/allen_errors.csv",
        findings="results/findings/allen_errors.json",
    params:
        case=config["allen_errors"],
    log:
        "results/logs/allen_errors.log",
    benchmark:
        "results/benchmarks/allen_errors.tsv"
    message:
        "Allen et al.: error of the peak rotation"
    script:
        "src/steps/allen_errors.py"


rule allen_overturning:
    input:
        LIBRARY,
    output:
        table="results/tables/allen_overturning.csv",
        findings="results/findings/allen_overturning.json",
    params:
        case=config["allen_overturning"],
    log:
        "results/logs/allen_overturning.log",
    benchmark:
        "results/benchmarks/allen_overturning.tsv"
    message:
        "Allen et al.: overturning misjudged"
    script:
        "src/steps/allen_overturning.py"


# 6. Top-heavy is more stable: the conclusions ----------------------------------------------------


rule heavier:
    input:
        LIBRARY,
    output:
        histories="results/tables/heavier_histories.csv",
        summary="results/tables/heavier.csv",
        findings="results/findings/heavier.json",
    params:
        case=config["heavier"],
        structures=config["structures"],
        solver=config["solver"],
    log:
        "results/logs/heavier.log",
    benchmark:
        "results/benchmarks/heavier.tsv"
    message:
        "The same pulse under heavier and heavier caps"
    script:
        "src/steps/heavier.py"


rule scale_effects:
    input:
        LIBRARY,
    output:
        table="results/tables/scale_effects.csv",
        findings="results/findings/scale_effects.json",
    params:
        case=config["scale_effects"],
        structures=config["structures"],
        solver=config["solver"],
    log:
        "results/logs/scale_effects.log",
    benchmark:
        "results/benchmarks/scale_effects.tsv"
    message:
        "Housner's two scale effects"
    script:
        "src/steps/scale_effects.py"
