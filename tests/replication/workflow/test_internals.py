"""What the machine uses of Snakemake beyond its interface: there, and in one module."""

import re
from functools import reduce
from importlib import import_module
from pathlib import Path

import pytest
from snakemake.exceptions import WorkflowError

from replication.workflow import internals
from replication.workflow.provenance import workflow_jobs

MACHINE = Path(internals.__file__).parents[1]
RULE = """
from replication.workflow.completion import complete
rule all:
    input:
        "out.csv",
rule plain:
    output:
        "out.csv",
    script:
        "plain.py"
complete(workflow)
"""


@pytest.mark.parametrize("path", internals.USED)
def test_snakemake_still_has_what_is_used_of_its_classes(path):
    import_module("snakemake.api")  # its modules import each other in a circle, from here on
    module, _, names = path.partition(":")
    assert reduce(getattr, names.split("."), import_module(module)) is not None


@pytest.mark.parametrize("name", internals.MODIFIERS)
def test_snakemake_still_has_what_is_set_on_rules(name, tmp_path, plant, monkeypatch):
    """Without a modifier Snakemake refuses a path: so it is read, and not only set."""
    monkeypatch.chdir(plant(tmp_path, {"Snakefile": RULE, "plain.py": ""}))
    assert len(workflow_jobs(targets=["all"])) == 2
    others = tuple(other for other in internals.MODIFIERS if other != name)
    monkeypatch.setattr(internals, "MODIFIERS", others)
    with pytest.raises((AssertionError, WorkflowError)):
        workflow_jobs(targets=["all"])


def test_no_other_module_reaches_into_snakemake():
    inside = r"PersistenceBase|JobScheduler|SnakemakeApi|ExecMode|_workflow\b|\.dag\.|_modifier\b"
    inside += "|is_producer|expand_input"
    files = [*MACHINE.rglob("*.py"), *MACHINE.rglob("*.smk")]
    users = {path.name for path in files if re.search(inside, path.read_text("utf-8"))}
    assert users == {"internals.py", "provenance.py"}  # it lists the jobs of a planned workflow
