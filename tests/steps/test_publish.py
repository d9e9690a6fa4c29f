"""The published table of verdicts."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

from replication.judging.claim import Claim
from replication.judging.findings import Findings
from replication.judging.ledger import REPRODUCED, with_verdict
from replication.origin.recorded import Crate
from replication.pages import edition as publishing
from replication.pages.edition import (
    count_table,
    publish,
    publish_findings,
    rounded,
    verdict_page,
    verdict_table,
    with_counts,
)
from replication.workbench import value
from steps.publish import main

CLAIM = Claim(
    id="trilith_size",
    where="p. 3",
    statement="the size of the column",
    printed=0.415,
    unit="m",
    tolerance=5e-4,
    finding="size",
    function="topheavy.Column",
    rule="trilith",
    expected="confirmed",
)
SIZE = Findings({"size": value(0.41483702538308, 1e-16)}, ("topheavy.structures.Column",))
ROW = with_verdict(CLAIM, {"trilith": SIZE})


def cells(**changes) -> list[str]:
    """The cells of the row that a claim becomes."""
    last = verdict_table([replace(ROW, **changes)])[-1]
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", last)[1:-1]]


def page(*rows) -> str:
    return verdict_page(rows, Path("tests/reference"))


def test_claim_becomes_a_row_under_the_heads_of_its_columns():
    lines = verdict_table([ROW])
    heads = [cell.strip() for cell in lines[-3].split("|")[1:-1]]
    shown = dict(zip(heads, cells(), strict=True))
    anchor, link = '<a id="trilith_size"></a>', "<br><sub>[trilith_size](#trilith_size)</sub>"
    assert shown["claim, in our words"] == f"{anchor}the size of the column{link}"
    assert shown["verdict"] == "confirmed<br>printed 0.415 m<br>computed 0.4148 m"
    assert shown["condition, remark"] == ""
    assert shown["where"] == "p. 3"
    assert set(lines[-2]) == {"|", "-"}


def test_every_claim_has_its_row_in_order():
    lines = verdict_table([replace(ROW, id=name) for name in ("b", "a", "c")])
    assert [line.split('"')[1] for line in lines[-3:]] == ["b", "a", "c"]


@pytest.mark.parametrize(
    ("computed", "unit", "shown"),
    [
        (True, "", ""),
        (False, "", ""),
        (None, "", ""),
        (None, "m", ""),
        (1.5, "", "1.5000"),
        (3, "g", "3.0000 g"),
        (0, "", "0.0000"),
        ("more", "", "more"),
    ],
)
def test_value_is_shown_as_what_it_is(computed, unit, shown):
    assert cells(computed=computed, unit=unit)[1].partition("<br>computed ")[2] == shown


@pytest.mark.parametrize("column", ["statement", "remark", "where"])
def test_bar_in_the_text_does_not_end_the_cell(column):
    shown = cells(**{column: "max|θ| grows"})
    assert len(shown) == 4
    assert any(r"max\|θ\| grows" in cell for cell in shown)


def test_page_ends_with_one_newline():
    assert page(ROW).endswith("|\n")
    assert not page(ROW).endswith("\n\n")


def test_page_says_that_a_fault_of_the_print_may_be_ours():
    assert "A slip or misprint may be a fault of the text that we worked from" in page(ROW)


OURS = replace(ROW, id="ours", study="pendulums", verdict="refuted")


def test_paper_and_studies_have_a_table_each():
    paper, study = page(ROW, OURS).split("## ")[1:]
    assert paper.startswith("The paper\n")
    assert study.startswith("The study `pendulums`\n")
    assert 'id="trilith_size"' in paper
    assert 'id="ours"' not in paper
    assert 'id="ours"' in study


@pytest.mark.parametrize(
    ("changes", "shown"),
    [
        (
            {"verdict": "qualified", "condition": "the pulse has one lobe"},
            "on condition: the pulse has one lobe",
        ),
        ({"verdict": "qualified"}, "in another convention"),
        ({"verdict": "slip"}, "as meant"),
        ({"verdict": "misprint"}, "as meant"),
        ({"verdict": "refuted"}, ""),
    ],
)
def test_no_qualified_claim_is_said_not_to_hold(changes, shown):
    assert cells(computed=False, **changes)[2] == shown


def test_numbers_that_a_new_run_gives_again_are_listed_apart_and_not_counted():
    again = replace(ROW, id="again", study=REPRODUCED)
    assert 'id="again"' in page(ROW, again).split("## Numbers of ours")[1]
    assert count_table([ROW, again]) == count_table([ROW])


def test_counts_are_of_the_paper_and_of_each_study():
    head, _, paper, study = count_table([ROW, OURS, OURS])
    assert head == (
        "| | confirmed | qualified | slip | misprint | refuted | by definition | not tested |"
    )
    assert paper == "| paper | 1 | 0 | 0 | 0 | 0 | 0 | 0 |"
    assert study == "| study `pendulums` | 0 | 0 | 0 | 0 | 2 | 0 | 0 |"


def test_table_of_counts_in_a_page_is_replaced_and_nothing_else():
    old = "\n".join(["Before.", "", *count_table([ROW]), "", "| other | table |", ""])
    new = with_counts(old, [ROW, OURS])
    assert new == "\n".join(["Before.", "", *count_table([ROW, OURS]), "", "| other | table |", ""])
    assert with_counts(new, [ROW, OURS]) == new
    with pytest.raises(ValueError, match=r"has 0 lines .* expected one"):
        with_counts("nothing", [ROW])


def test_findings_are_rounded_an_error_the_most():
    found = {"a": {"value": 1 / 3, "error": 1.23456e-9, "list": [2 / 3, "x", True], "n": 7}}
    assert rounded(found) == {
        "a": {"value": 0.333333333, "error": 1.2e-9, "list": [0.666666667, "x", True], "n": 7}
    }


def test_findings_of_rules_that_are_gone_are_published_no_more(tmp_path):
    made, published = tmp_path / "made", tmp_path / "published"
    for folder, name in ((made, "new"), (published, "gone")):
        folder.mkdir()
        (folder / f"{name}.json").write_text('{"a": {"holds": true}}', encoding="utf-8")
    publish_findings(made, published)
    assert [path.name for path in published.iterdir()] == ["new.json"]


def test_run_that_tested_less_is_not_published(tmp_path):
    made, published = tmp_path / "made", tmp_path / "published"
    for folder, text in ((made, '{"not_tested": "no engine"}'), (published, "{}")):
        folder.mkdir()
        (folder / "a.json").write_text(text, encoding="utf-8")
    with pytest.raises(
        ValueError, match=r"a.json: nothing was tested \(no engine\); expected a full"
    ):
        publish_findings(made, published)
    assert (published / "a.json").read_text(encoding="utf-8") == "{}"


def test_number_without_a_unit_leaves_no_gap():
    assert "printed 0.415<br>computed 0.4148 |" in verdict_table([replace(ROW, unit="")])[-1]


def test_results_of_another_config_are_not_published(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for folder, points in (("results", 3), ("config", 11)):
        (tmp_path / folder).mkdir()
        text = f"spectra: {{points: {points}}}\nsolver: {{tightened: 1.0e-12}}\n"
        (tmp_path / folder / "config.yaml").write_text(text, encoding="utf-8")
    (tmp_path / "results" / "claims.json").write_text("[]", encoding="utf-8")
    with pytest.raises(SystemExit, match="another config, which differs in spectra; expected"):
        main()
    assert not (tmp_path / "docs").exists()


@pytest.fixture
def finished(tmp_path, monkeypatch):
    """A finished run with one table, and an edition with a table that is gone."""
    monkeypatch.chdir(tmp_path)
    for path, text in {
        "results/config.yaml": "studies: []\n",
        "results/origins.json": "{}\n",
        "config/config.yaml": "studies: []\n",
        "results/claims.json": "[]",
        "results/costs.csv": "rule,seconds\n",
        "results/tables/new.csv": "x\n1\n",
        "results/findings/rule.json": json.dumps({"size": {"holds": True}, "called": []}),
        "tests/reference/old.csv": "x\n1\n",
        "paper/claims.yaml": "- {id: a, where: p. 1, statement: So., expected: not tested}\n",
        "README.md": "\n".join(count_table([])),
    }.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    crate = Crate({}, {"results/findings/rule.json": "rule"}, (), "")
    monkeypatch.setattr(publishing, "read_crate", lambda: crate)
    return tmp_path


def test_findings_that_an_earlier_workflow_left_are_not_published(finished):
    (finished / "results/findings/old.json").write_text("{}", encoding="utf-8")
    with pytest.raises(SystemExit, match=r"findings/old.json is of no rule of the run; .* delete"):
        publish(["new"])
    assert not (finished / "tests/reference/findings").exists()


def test_table_that_is_gone_is_published_no_more(finished):
    publish(["new"])
    assert [path.name for path in (finished / "tests/reference").glob("*.csv")] == ["new.csv"]


@pytest.fixture
def study(finished):
    """A study of that run, which publishes a table and a picture."""
    for path, text in {
        "results/config.yaml": "studies: [ours]\n",
        "results/origins.json": "{}\n",
        "config/config.yaml": "studies: [ours]\n",
        "results/tables/ours_new.csv": "x\n2\n",
        "studies/ours/config.yaml": "{}\n",
        "studies/ours/claims.yaml": "- {id: b, where: Ours, statement: So, expected: not tested}\n",
        "studies/ours/edition.yaml": "tables: [ours_new]\npictures: {ours.svg: figures/one.svg}\n",
        "studies/ours/figures/one.svg": "<svg/>",
    }.items():
        (finished / path).parent.mkdir(parents=True, exist_ok=True)
        (finished / path).write_text(text, encoding="utf-8")
    return finished


def test_study_publishes_what_its_folder_says(study):
    publish(["new"])
    made = sorted(path.name for path in (study / "tests/reference/studies").iterdir())
    assert made == ["ours.yaml", "ours_new.csv"]
    assert (study / "docs/ours.svg").read_text(encoding="utf-8") == "<svg/>"
    for name in ("results", "config"):
        (study / name / "config.yaml").write_text("studies: []\n", encoding="utf-8")
    publish(["new"])
    assert list((study / "tests/reference/studies").iterdir()) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("tables: [ours_old]", r"ours_old.csv does not exist, and studies/ours/edition.yaml names"),
        (
            "table: [ours_new]",
            r"studies/ours/edition.yaml: table is \['ours_new'\]; expected tables",
        ),
        ("tables: ours_new", r"studies/ours/edition.yaml: tables is 'ours_new'; expected tables"),
    ],
)
def test_study_that_names_no_table_of_the_run_is_not_published(study, text, said):
    (study / "studies/ours/edition.yaml").write_text(text, encoding="utf-8")
    with pytest.raises((SystemExit, ValueError), match=said):
        publish(["new"])
    assert not (study / "tests/reference/studies").exists()


def test_table_that_the_run_did_not_make_is_not_published(finished):
    with pytest.raises(SystemExit, match=r"tables/old.csv does not exist, and .* names 'old'"):
        publish(["new", "old"])
    assert (finished / "tests/reference/old.csv").exists()
