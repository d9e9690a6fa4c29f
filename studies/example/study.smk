"""Does a bent survive a record, and how much does its deck help?"""

from replication.config import Fraction, Positive, Study


class Inputs(Study):  # the keys of config.yaml beside structures and records
    scale: Positive
    lowest: Positive
    highest: Positive
    step: Positive
    windows: list[Positive]
    share: Fraction


INPUTS = SETTINGS["example"] = read_config("studies/example/config.yaml", Inputs)

PICTURES = sorted(glob("studies/example/*_figure.py"))


rule example_capacity:
    input:
        kernel="results/kernel.compiled",
    output:
        table="results/tables/example_capacity.csv",
        findings="results/findings/example_capacity.json",
    log:
        "results/logs/example_capacity.log",
    params:
        **INPUTS,
        code=code("studies/example/capacity.py", rule="example_capacity"),
    script:
        "capacity.py"


rule example_figures:
    input:
        "results/tables/example_capacity.csv",
        scripts=PICTURES,
        style="figures/style.mplstyle",
    output:
        [path.replace("_figure.py", ".svg") for path in PICTURES],
    log:
        "results/logs/example_figures.log",
    params:
        code=code("src/steps/draw.py", *PICTURES, rule="example_figures"),
    script:
        "../../src/steps/draw.py"
