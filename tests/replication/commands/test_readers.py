"""A finding, a key or a column without a reader is named; one with any of its readers is not."""

import json

import pytest
import yaml

from replication.commands.readers import MOST, faults
from replication.judging.readers import in_typst

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
