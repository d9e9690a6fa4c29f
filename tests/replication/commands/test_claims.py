"""New claims, and the readers of findings."""

import json
import shutil
import subprocess
import sys

import pytest
import yaml

from replication.commands.draft_schema import add_missing
from replication.commands.new_claim import LONGEST, create
from replication.commands.new_paper import TEMPLATE
from replication.commands.readers import MOST, faults
from replication.inputs.configuration import check_config
from replication.judging.readers import in_typst


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


ROW = {
    "id": "one",
    "where": "p. 1",
    "statement": "It is one.",
    "function": "one",
    "rule": "a",
    "finding": "of_row",
    "expected": "confirmed",
}
FOUND = ["of_row", "of_text", "of_name", "of_import", "of_page", "of_check", "of_at", "of_nobody"]
TEXT = """
#let it = found("a")
#found("a").of_text #it.of_name.value #it.at("of_at").value #let other = found("a").at("of_at")
"""


@pytest.fixture
def tree(plant, tmp_path):
    """A paper of one rule; each finding but one has the reader that its name says."""
    return plant(
        tmp_path,
        {
            "Snakefile": 'CHECKS = {\n    "a": ["of_check"],\n}\n',
            "config/config.yaml": "used: 1\nalternatives: { first: 1 }\n",
            "paper/claims.yaml": yaml.safe_dump([ROW]),
            "paper/report.typ": TEXT,
            "paper/other.typ": "#it.of_import #that.of_nobody #itself.of_nobody",
            "src/steps/a.py": 'config["used"]["alternatives"]\nresults.finding("a", "of_page")\n'
            'table["width"], table[f"{name}_low"]\n',
            "src/steps/tests/test_a.py": '"of_nobody unused first height"',
            "tests/reference/findings/a.json": json.dumps(dict.fromkeys([*FOUND, "called"])),
            "tests/reference/a.csv": "width,width_low,height\n1,2,3\n",
            "paper/unread.yaml": '"config/config.yaml: alternatives.*": All are tried.\n'
            '"tests/reference/a.csv: height": Read by hand.\n',
        },
    )


@pytest.fixture
def lost(tree):
    return lambda: [fault.split(":")[0].split(" has ")[0] for fault in faults(tree)]


def test_finding_that_nothing_takes_is_named_and_no_other(lost):
    assert lost() == ["finding a.of_nobody"]


@pytest.mark.parametrize(
    ("file", "text", "name"),
    [
        ("Snakefile", "", "of_check"),
        ("paper/other.typ", "", "of_import"),
        ("src/steps/a.py", '"used", "alternatives", "width", f"{name}_low"', "of_page"),
        ("paper/report.typ", '#let it = found("a")\n#found("a").of_text it.of_name', "of_at"),
    ],
)
def test_reader_that_goes_leaves_its_finding_unread(tree, lost, file, text, name):
    (tree / file).write_text(text, encoding="utf-8")
    assert lost() == [f"finding a.{one}" for one in sorted(["of_nobody", name])]


def test_row_that_goes_leaves_its_finding_unread(tree, lost):
    (tree / "paper/claims.yaml").write_text(yaml.safe_dump([ROW | {"finding": "of_text"}]))
    assert lost() == ["finding a.of_nobody", "finding a.of_row"]


def test_key_and_column_that_no_source_names_are_named(tree):
    (tree / "paper/unread.yaml").write_text("{}")
    _, *others = faults(tree)
    assert [fault.split("; ")[0] for fault in others] == [
        "config/config.yaml: alternatives.first: no source reads this key",
        "tests/reference/a.csv: height: no source reads this column",
    ]


def test_exception_that_nothing_needs_is_named_and_there_are_few(tree, lost):
    with (tree / "paper/unread.yaml").open("a") as file:
        file.writelines(f'"config/config.yaml: gone.{n}": So it was.\n' for n in range(MOST))
    assert lost()[1:] == ["paper/unread.yaml"] * (MOST + 1)
    assert [*faults(tree)][-1].endswith(f"has {MOST + 2} entries; expected at most {MOST}")


def test_condition_on_a_name_reads_it():
    bound = [("it", "a")]
    assert [*in_typst('#if "same" in it [yes] #if "same" in its [no]', bound)] == [("a", "same")]


def test_computed_name_of_a_rule_is_refused():
    with pytest.raises(ValueError, match="computes the name of a rule"):
        [*in_typst('#let of(rule) = found("mechanism_" + rule)', [])]
