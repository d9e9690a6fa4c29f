"""A new claim of the paper, which is judged at once: `make claim NAME=my_claim`.

It gets a row of the ledger, a function of the library, a step that calls it, and a rule. A claim
that the ledger has is left as it is.
"""

import sys
from pathlib import Path

from replication.commands.new_study import check_name, names_of
from replication.inputs.parts import PAPER, ledger_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.calls import OF_NO_ROW
from replication.judging.ledger import read_ledger

LONGEST = 30
"""Letters of a name: so few that no line that contains it needs another break."""
RULES = "src/steps/paper.smk"
"""Where the paper's rules are, unless they are in the Snakefile itself, before its studies."""

STUDIES = '\nfor name in config["studies"]:'
ROW = """\
- id: {name}
  where: "BLANK: the page, and the equation or figure"
  statement: "BLANK: the claim of the paper in your words."
  printed: 3.14
  tolerance: 0.005
  because: the rounding of the print
  function: {library}.{name}.{name}
  rule: {name}
  finding: {name}
  expected: confirmed
"""
RULE = """

rule {name}:
    output:
        findings="results/findings/{name}.json",
    script:
        "{name}.py"
"""
STEP = '''"""Compute what the claim {name} is judged by."""

from replication.workbench import run, value
from {library}.{name} import {name}


def main() -> dict:
    fine, coarse = {name}(1000), {name}(500)
    return {{"{name}": value(fine, error=abs(fine - coarse))}}


if __name__ == "__main__":
    run(snakemake, lambda job: main())
'''
FUNCTION = '''"""The claim {name}: at first it is π, which your equation replaces."""

import numpy as np


def {name}(intervals: int) -> float:
    """Return the integral of 4/(1 + x²) from 0 to 1, by the trapezoidal rule."""
    x = np.linspace(0.0, 1.0, intervals + 1)
    return float(np.trapezoid(4.0 / (1.0 + x**2), x))
'''


def create(name: str, root: Path = Path()) -> list[str]:
    """Write what a new claim needs, and return the paths; none if a ledger has the claim.

    Raises
    ------
    ValueError
        For a name that is taken, means something else or cannot be one.
    """
    studies = read_yaml(root / "config/config.yaml")["studies"]
    if name in {row.id for row in read_ledger(root / ledger_of(p) for p in [PAPER, *studies])}:
        return []
    check_name(name, root, LONGEST)
    packages = {path.parent.name for path in (root / "src").glob("*/__init__.py")}
    library, *_ = sorted(packages - {*OF_NO_ROW})
    if name in names_of(root) | {path.stem for path in root.glob("src/*/*.py")}:
        raise ValueError(f"NAME is {name!r}, as a rule, result or module is; expected a new name")
    modules = {f"src/{library}/{name}.py": FUNCTION, f"src/steps/{name}.py": STEP}
    rules = RULES if (root / RULES).exists() else "Snakefile"
    new = {ledger_of(PAPER): ROW, **modules, rules: RULE}
    for path, text in new.items():
        written = text.format(name=name, library=library)
        before = (root / path).read_text(encoding="utf-8") if (root / path).exists() else ""
        if path == "Snakefile":
            first, studies, rest = before.partition(STUDIES)
            script = written.replace('script:\n        "', 'script:\n        "src/steps/')
            written = first.rstrip("\n") + "\n" + script + "\n" + studies + rest
        else:
            written = before + written
        (root / path).write_text(written, encoding="utf-8")
    return [*new]


if __name__ == "__main__":
    try:
        written = create(sys.argv[1])
    except ValueError as error:
        sys.exit(f"make claim: {error}")
    if written:
        print(f"{sys.argv[1]} is a new claim. Make it yours, and run the same command again:")
        print(*(f"  {path}" for path in written), sep="\n")
        print("To take it back, delete the modules, the row and the rule.", flush=True)
