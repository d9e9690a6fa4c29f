"""A claim that one command begins: four files, in the style that lint demands."""

import shutil
import subprocess
import sys

import pytest
import yaml

from replication.commands.draft_schema import add_missing
from replication.commands.new_claim import LONGEST, create
from replication.commands.new_paper import TEMPLATE
from replication.inputs.configuration import check_config


@pytest.fixture
def paper(tmp_path):
    shutil.copytree(TEMPLATE, tmp_path / "far", ignore=shutil.ignore_patterns("tests"))
    for path in (TEMPLATE.parents[2] / ".gitignore", TEMPLATE.parent / "make/ruff.toml"):
        shutil.copy(path, tmp_path / "far")
    (tmp_path / "far/src/replication").symlink_to(TEMPLATE.parent)  # so that ruff knows it
    return tmp_path / "far"


@pytest.mark.parametrize("length", [1, 12, LONGEST])
def test_new_claim_fits_together_in_the_style_that_lint_demands(paper, monkeypatch, length):
    monkeypatch.chdir(paper)
    name = "n" + "o" * (length - 1)
    paths = create(name)
    *_, row = yaml.safe_load((paper / "paper/claims.yaml").read_text("utf-8"))
    assert (row["id"], row["function"]) == (name, f"theory.{name}.{name}")
    assert create(name) == []
    for end, *command in (
        (".py", "ruff", "check"),
        (".py", "ruff", "format"),
        (".smk", "snakefmt"),
    ):
        check = [] if "check" in command else ["--check"]
        files = [path for path in paths if path.endswith(end)]
        subprocess.run([sys.executable, "-m", *command, *check, *files], check=True)


def test_rule_of_a_new_claim_stands_in_the_snakefile_that_has_the_others(paper):
    rules = paper / "src/steps/paper.smk"
    snakefile = paper / "Snakefile"
    text = snakefile.read_text("utf-8").replace('include: "src/steps/paper.smk"\n', "")
    snakefile.write_text(text, "utf-8")
    rules.unlink()
    assert "Snakefile" in create("probe", paper)
    before, after = snakefile.read_text("utf-8").split('\nfor name in config["studies"]:')
    assert "rule probe:" in before
    assert '    script:\n        "src/steps/probe.py"\n' in before
    assert after == text.split('\nfor name in config["studies"]:')[1]
    check = [sys.executable, "-m", "snakefmt", "--check", str(snakefile)]
    subprocess.run(check, check=True, capture_output=True)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("", "expected a lower-case letter"),
        ("a" * (LONGEST + 1), "at most"),
        ("true", "which YAML reads as True"),
        ("lambda", "a keyword of Python"),
        ("equations", "as a rule, result or module is"),
        ("motion", "as a rule, result or module is"),
        ("verdict", "as a rule, result or module is"),
    ],
)
def test_name_that_cannot_be_one_changes_nothing(paper, name, told):
    before = {path: path.read_bytes() for path in paper.rglob("*.*") if path.is_file()}
    with pytest.raises(ValueError, match=told):
        create(name, paper)
    assert before == {path: path.read_bytes() for path in paper.rglob("*.*") if path.is_file()}


def test_schema_is_drafted_from_values(paper):
    config, schema = paper / "config/config.yaml", paper / "config/config.schema.yaml"
    new = {"mass": {"lengths": [0.5, 1.0], "count": 3, "fixed": True, "name": "far"}}
    text = config.read_text("utf-8")
    config.write_text(f"{text}\n{yaml.safe_dump(new)}", "utf-8")
    whole = yaml.safe_load(config.read_text("utf-8"))
    with pytest.raises(ValueError, match=r"unknown key 'mass'.* `make schema` drafts"):
        check_config(whole, str(config), str(schema))
    assert add_missing(config) == ["mass"]
    assert add_missing(config) == []
    check_config(whole, str(config), str(schema))
    drafted = yaml.safe_load(schema.read_text("utf-8"))["properties"]["mass"]
    assert drafted["lengths"]["description"].startswith("BLANK:")
    assert drafted["lengths"]["items"]["unit"].startswith("BLANK:")
    for wrong in ({"count": 3.5}, {"fixed": 1}, {"lengths": ["long"]}, {"width": 1.0}):
        with pytest.raises(ValueError, match="mass"):
            check_config(whole | {"mass": new["mass"] | wrong}, str(config), str(schema))
