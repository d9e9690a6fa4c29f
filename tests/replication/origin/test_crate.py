"""The crate of a run, and the software that it names."""

import json
import os
import platform
import re
import shutil
import subprocess
import tomllib
from dataclasses import replace
from importlib import metadata
from pathlib import Path

import pytest

from replication.inputs.config_keys import Key
from replication.judging.claim import Claim
from replication.judging.ledger import with_verdict
from replication.origin.recorded import CRATE, read_crate
from replication.origin.software import installed
from replication.rules import crate as rule
from replication.workflow.provenance import Job

ROOT = Path(__file__).parents[3]
FILES = {
    "Snakefile": "rule peaks:\n",
    "uv.lock": "lock",
    rule.MACHINE: "1.2.0",
    "src/peaks.py": "compute()\n",
    "src/beside.py": "help()\n",
    "figures/peaks.py": "draw()\n",
    "results/peaks.csv": "1\n",
    "results/findings/peaks.json": "{}\n",
    "results/costs.csv": "2\n",
    "figures/peaks.svg": "<svg/>\n",
}
STEP = Job(
    "peaks_of_all",  # claims name the findings
    scripts=("src/peaks.py",),
    inputs=("src/beside.py",),
    outputs=("results/peaks.csv", "results/findings/peaks.json"),
    findings=("results/findings/peaks.json",),
    logs=("results/logs/peaks.log",),
)
FIGURE = Job(
    "figure",
    scripts=("figures/peaks.py",),
    inputs=("results/peaks.csv",),
    outputs=("figures/peaks.svg",),
)
COSTS = Job("costs", scripts=("src/peaks.py",), outputs=("results/costs.csv",))
LAST = Job("crate", inputs=("Snakefile", "uv.lock", rule.MACHINE), outputs=(CRATE,))
KEYS = {
    "": [Key("column.height", "its height", "m", (6.0,))],
    "wind": [Key("ratios", "mass ratio", "1", ([0.0, float("inf")],))],
}
PROJECT = {"description": "On peaks", "version": "0.1.0"}
CITATION = {
    "title": "Peaks again",
    "authors": [{"family-names": "Doe", "given-names": "Jo"}, {"name": "The team"}],
    "date-released": "2026-01-02",
    "license": ["MIT"],
    "references": [{"title": "Peaks", "authors": [{"name": "An author"}], "doi": "10.1000/1"}],
}
UNTESTED = Claim(id="peak_is_low", where="p. 3", statement="The peak is low.", expected="confirmed")
CLAIM = replace(with_verdict(UNTESTED, {}), verdict="confirmed", rule="peaks")


@pytest.fixture
def made(tmp_path, plant, monkeypatch):
    """The crate of a step, a figure drawn from it, and what a run costs."""
    monkeypatch.chdir(plant(tmp_path, FILES))
    return rule.main(
        [STEP, FIGURE, COSTS, LAST],
        ["results/costs.csv"],
        KEYS,
        [CLAIM, replace(CLAIM, id="ours", study="ours", rule="", verdict="not tested")],
        {"numpy": "2.4.6"},
        "1.2.0",
        PROJECT,
        CITATION,
    )


@pytest.fixture
def entities(made):
    return {entity["@id"]: entity for entity in made["@graph"]}


@pytest.mark.parametrize("text", ["{", "{}", '{"@graph": []}', "[]"])
def test_file_that_is_no_crate_of_a_run_is_refused(tmp_path, text):
    (tmp_path / "crate.json").write_text(text)
    with pytest.raises(ValueError, match=r"is not the RO-Crate of a run .* make reproduce"):
        read_crate(tmp_path / "crate.json")


def test_parameter_has_meaning_unit_and_value(entities):
    assert entities["#parameter/column.height"]["description"] == "its height"
    assert entities["#value/column.height"]["value"] == 6.0
    assert entities["#value/column.height"]["unitText"] == "m"
    assert entities["#value/wind.ratios"]["value"] == "[0.0, .inf]"  # JSON has no infinity


def test_citation_without_a_date_is_refused():
    citation = {name: value for name, value in CITATION.items() if name != "date-released"}
    with pytest.raises(ValueError, match=r"CITATION.cff has no date-released"):
        rule.about.root(citation, {"description": "", "version": ""})


def test_every_output_of_the_workflow_but_the_costs_is_listed(jobs, monkeypatch, tmp_path):
    monkeypatch.setattr(rule.entities, "checksum", lambda path: "")
    crate = rule.main(jobs, ["results/costs.csv"], {}, [], {}, "", PROJECT, CITATION)
    (tmp_path / "crate.json").write_text(json.dumps(crate))
    listed = read_crate(tmp_path / "crate.json")
    made = {path for job in jobs for path in job.outputs}
    assert made - set(listed.rules) == {"results/costs.csv", CRATE}
    given = {path for job in jobs for path in (*job.inputs, *job.scripts)}
    assert given - set(listed.checksums) == {"results/costs.csv", CRATE}
    assert listed.folders == ["results"]


REQUIRED = {"./": "license", "#run": "instrument", "#parameter/column.height": "additionalType"}
"""By entity, a property that the profile requires."""


def test_crate_is_valid_and_not_without_required_properties(tmp_path, made, entities):
    """The validator has an environment of its own, which takes seconds."""
    uv = os.environ.get("UV") or shutil.which("uv")  # `uv run` tells where it is
    if not uv:
        pytest.skip("there is no uv, which installs the validator of RO-Crates")

    def validate(crate):
        (tmp_path / Path(CRATE).name).write_text(json.dumps(crate))
        group = ["--quiet", "--isolated", "--locked", "--only-group", "crate", "--project", ROOT]
        script = ROOT / "src/replication/ci/validate_crate.py"
        command = [uv, "run", *group, "python", script, tmp_path]
        done = subprocess.run(command, capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    assert validate(made) == (0, f"{Path.cwd()} is a valid Workflow Run RO-Crate\n")
    for entity, name in REQUIRED.items():
        del entities[entity][name]
    code, said = validate(made)
    assert code == 1
    for name in REQUIRED.values():
        assert re.search(f"MUST have an? `?{name}`? ?", said), said


LOCK = {
    "package": [
        {
            "name": "peaks",
            "source": {"editable": "."},
            "dependencies": [{"name": "numpy"}, {"name": "jsonschema", "extra": ["format"]}],
            "dev-dependencies": {"dev": [{"name": "pytest"}], "engine": [{"name": "sympy"}]},
        },
        {"name": "numpy", "source": {}, "dependencies": [{"name": "nowhere-installed"}]},
        {"name": "nowhere-installed", "source": {}},
        {
            "name": "jsonschema",
            "source": {},
            "dependencies": [{"name": "attrs"}],
            "optional-dependencies": {"format": [{"name": "idna"}], "other": [{"name": "ruff"}]},
        },
        *({"name": name, "source": {}} for name in ("attrs", "idna", "pytest", "ruff", "sympy")),
    ]
}


def test_installed_dependencies_are_told_and_none_of_tests():
    names = ["python", "attrs", "idna", "jsonschema", "numpy"]
    assert list(installed(LOCK)) == names
    assert list(installed(LOCK, ["engine"])) == [*names, "sympy"]


def test_versions_are_those_that_are_installed():
    found = installed(LOCK)
    assert found["python"] == platform.python_version()
    assert found["numpy"] == metadata.version("numpy")


def test_packages_that_compute_are_among_ours():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    lock = tomllib.loads((ROOT / "uv.lock").read_text(encoding="utf-8"))
    groups = project["tool"]["replication"]["groups"]
    found = installed(lock, groups)
    assert {"numpy", "scipy", "snakemake", "rocrate"} <= set(found)
    assert not {"pytest", "ruff", "roc-validator"} & set(found)
    assert set(groups) <= set(project["dependency-groups"])
