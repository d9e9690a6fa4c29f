"""The published table of verdicts."""

import json
import re
from dataclasses import replace
from pathlib import Path

import pytest

import steps.publish
from replication.inputs.checksums import sha256
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
)
from replication.workbench import value
from tests.cases import ROOT

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
SIZE = Findings({"size": value(0.41483702538308, 1e-16)}, ("topheavy.bodies.structures.Column",))
ROW = with_verdict(CLAIM, {"trilith": SIZE}, ROOT)
OURS = replace(ROW, id="ours", study="pendulums", verdict="refuted")


def cells(**changes) -> list[str]:
    """The cells of the row that a claim becomes."""
    last = verdict_table([replace(ROW, **changes)])[-1]
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", last)[1:-1]]


def page(*rows) -> str:
    return verdict_page(rows, Path("tests/reference"))


# Pages -------------------------------------------------------------------------------------------


def test_paper_studies_and_numbers_that_a_run_gives_again_have_a_table_each():
    again = replace(ROW, id="again", study=REPRODUCED)
    whole = page(ROW, OURS, again)
    assert "A slip or misprint may be a fault of the text that we worked from" in whole
    assert whole.endswith("|\n")
    study, paper, numbers = sorted(whole.split("## ")[1:], reverse=True)
    for part, head, name in (
        (study, "The study `pendulums`\n", "ours"),
        (paper, "The paper\n", "trilith_size"),
        (numbers, "Numbers of ours", "again"),
    ):
        assert part.startswith(head)
        assert re.findall(r'id="(\w+)"', part) == [name]
    assert count_table([ROW, again]) == count_table([ROW])


@pytest.mark.parametrize(
    ("changes", "shown"),
    [
        ({"verdict": "qualified", "condition": "one lobe"}, "on condition: one lobe"),
        ({"verdict": "qualified"}, "in another convention"),
        *(({"verdict": one}, "as meant") for one in ("slip", "misprint")),
        ({"verdict": "refuted"}, ""),
    ],
)
def test_no_qualified_claim_is_said_not_to_hold(changes, shown):
    assert cells(computed=False, **changes)[2] == shown


def test_findings_are_rounded_an_error_the_most():
    found = {"value": 1 / 3, "error": 1.23456e-9, "list": [2 / 3, "x", True], "n": 7}
    shown = {"value": 0.333333333, "error": 1.2e-9, "list": [0.666666667, "x", True], "n": 7}
    assert rounded({"a": found}) == {"a": shown}


# What is published -------------------------------------------------------------------------------


def test_findings_of_rules_that_are_gone_and_of_a_run_that_tested_less_are_not_published(
    tmp_path, plant
):
    made, published = tmp_path / "made", tmp_path / "published"
    plant(tmp_path, {"made/new.json": '{"a": {"holds": true}}', "published/gone.json": "{}"})
    publish_findings(made, published)
    assert [path.name for path in published.iterdir()] == ["new.json"]
    plant(made, {"new.json": '{"not_tested": "no engine"}'})
    says = r"new.json: nothing was tested \(no engine\); expected a full"
    with pytest.raises(ValueError, match=says):
        publish_findings(made, published)
    assert "holds" in (published / "new.json").read_text(encoding="utf-8")


def test_results_of_another_config_are_not_published(tmp_path, monkeypatch, plant):
    monkeypatch.chdir(tmp_path)
    text = "spectra: {{points: {}}}\nsolver: {{tightened: 1.0e-12}}\n"
    plant(tmp_path, {"results/config.yaml": text.format(3), "config/config.yaml": text.format(11)})
    plant(tmp_path, {"results/claims.json": "[]"})
    with pytest.raises(SystemExit, match="another config, which differs in spectra; expected"):
        steps.publish.main()
    assert not (tmp_path / "docs").exists()


@pytest.mark.parametrize(
    ("compiled_with", "others"), [("a row\n", True), ("none\n", False), (None, False)]
)
def test_supplement_that_counted_other_faults_is_not_published(
    tmp_path, monkeypatch, plant, compiled_with, others
):
    monkeypatch.chdir(tmp_path)
    table = "docs/kill_table.csv"
    plant(tmp_path, {table: "a row\n"})
    sums = {} if compiled_with is None else {table: sha256(compiled_with.encode())}
    monkeypatch.setattr(steps.publish, "publish", lambda *tables: None)
    monkeypatch.setattr(steps.publish, "read_crate", lambda: Crate(sums, {}, (), ""))
    monkeypatch.setattr(steps.publish.kill_table, "refresh", lambda: others)
    with pytest.raises(SystemExit, match=r"counts its rows; .*: make reproduce publish"):
        steps.publish.main()
    assert [path.name for path in (tmp_path / "docs").iterdir()] == ["kill_table.csv"]


@pytest.fixture
def finished(tmp_path, monkeypatch, plant):
    """A finished run with one table, and an edition with a table that is gone."""
    monkeypatch.chdir(tmp_path)
    crate = Crate({}, {"results/findings/rule.json": "rule"}, (), "")
    monkeypatch.setattr(publishing, "read_crate", lambda: crate)
    found = json.dumps({"size": {"holds": True}, "called": []})
    return plant(
        tmp_path,
        {
            **{f"{folder}/config.yaml": "studies: []\n" for folder in ("results", "config")},
            "results/origins.json": "{}\n",
            "results/claims.json": "[]",
            "results/costs.csv": "rule,seconds\n",
            "results/tables/new.csv": "x\n1\n",
            "results/findings/rule.json": found,
            "tests/reference/old.csv": "x\n1\n",
            "paper/claims.yaml": "- {id: a, where: p. 1, statement: So., expected: not tested}\n",
            "README.md": "\n".join(count_table([])),
        },
    )


def test_tables_and_findings_are_those_of_the_run(finished):
    with pytest.raises(SystemExit, match=r"tables/old.csv does not exist, and .* names 'old'"):
        publish(["new", "old"])
    assert (finished / "tests/reference/old.csv").exists()
    publish(["new"])
    assert [path.name for path in (finished / "tests/reference").glob("*.csv")] == ["new.csv"]


def test_findings_that_an_earlier_workflow_left_are_not_published(finished, plant):
    plant(finished, {"results/findings/old.json": "{}"})
    with pytest.raises(SystemExit, match=r"findings/old.json is of no rule of the run; .* delete"):
        publish(["new"])
    assert not (finished / "tests/reference/findings").exists()


@pytest.fixture
def study(finished, plant):
    """A study of that run, which publishes a table and a picture."""
    ours = "tables: [ours_new]\npictures: {ours.svg: figures/one.svg}\n"
    return plant(
        finished,
        {
            **{f"{folder}/config.yaml": "studies: [ours]\n" for folder in ("results", "config")},
            "results/tables/ours_new.csv": "x\n2\n",
            "studies/ours/config.yaml": "{}\n",
            "studies/ours/claims.yaml": "- {id: b, where: O, statement: S, expected: not tested}\n",
            "studies/ours/edition.yaml": ours,
            "studies/ours/figures/one.svg": "<svg/>",
        },
    )


def test_study_publishes_what_its_folder_says(study, plant):
    publish(["new"])
    made = sorted(path.name for path in (study / "tests/reference/studies").iterdir())
    assert made == ["ours.yaml", "ours_new.csv"]
    assert (study / "docs/ours.svg").read_text(encoding="utf-8") == "<svg/>"
    plant(study, {f"{name}/config.yaml": "studies: []\n" for name in ("results", "config")})
    publish(["new"])
    assert list((study / "tests/reference/studies").iterdir()) == []


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("tables: [ours_old]", "ours_old.csv does not exist, and studies/ours/edition.yaml names"),
        ("table: [ours_new]", r"ours/edition.yaml: table is \['ours_new'\]; expected tables"),
        ("tables: ours_new", r"studies/ours/edition.yaml: tables is 'ours_new'; expected tables"),
    ],
)
def test_study_that_names_no_table_of_the_run_is_not_published(study, plant, text, said):
    plant(study, {"studies/ours/edition.yaml": text})
    with pytest.raises((SystemExit, ValueError), match=said):
        publish(["new"])
    assert not (study / "tests/reference/studies").exists()
