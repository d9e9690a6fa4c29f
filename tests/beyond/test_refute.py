"""Sentences as data, motions that contradict them or not, and the worst cases."""

import math

import numpy as np
import pandas as pd
import pytest
import yaml

import refute
from replication.config import read_yaml
from steps.beyond import worst_found
from steps.shared import lobes, sentences
from tests.cases import COLUMN, CONFIG
from topheavy import Record

SPEC = CONFIG["spectra"]["cycles"] | {"draws": 2}
ENTRY, HEIGHT = read_yaml(refute.CASES)[0], COLUMN.half_height
CASE = worst_found.case_of(ENTRY, HEIGHT)


def test_a_sentence_compares_the_pairs_that_it_speaks_of():
    known = sentences.read_sentences()
    gammas = [0.0, 1.0, math.inf]
    assert known["frame_over_column"].pairs(gammas) == [(0.0, 1.0), (0.0, math.inf)]
    assert known["heavier_over_lighter"].pairs(gammas) == [(1.0, math.inf)]
    assert {case["sentence"] for case in read_yaml(refute.CASES)} == {*known}


def test_lobes_in_words_are_signed_and_may_have_a_pause():
    first, second = refute.lobes_in_words("+0.9 0.3; -0.8 0.2 0.1")
    assert first == (1.0, 0.9, 0.3, 0.0)
    assert second == (-1.0, 0.8, 0.2, 0.1)
    with pytest.raises(ValueError, match=r"lobe 2 is '0.9', .*; expected its length"):
        refute.lobes_in_words("+0.9 0.3; 0.9")


def test_half_the_range_of_the_velocity_is_that_of_its_integral():
    assert lobes.half_range(Record(0.1, [0.0, 1.0, -1.0, 0.0])) == pytest.approx(0.5 * 0.981 * 0.5)


def test_a_case_keeps_its_fall_and_another_value_stops_the_step():
    row = worst_found.row_of_case(ENTRY, CASE, SPEC, CONFIG["contacts"], HEIGHT)
    assert row["strict"] == pytest.approx(ENTRY["fall"], abs=1e-4)
    assert row["heavier_from"] < row["lighter_from"]
    assert row["heavier_width"] >= SPEC["wide"]
    assert row["least_vertical"] > 0.0
    with pytest.raises(SystemExit, match=r"has a fall of 0\.\d+; expected 0.9"):
        worst_found.row_of_case(ENTRY | {"fall": 0.9}, CASE, SPEC, CONFIG["contacts"], HEIGHT)


def test_a_motion_contradicts_a_sentence_or_none(monkeypatch):
    monkeypatch.setitem(CONFIG["motions"], "structures", ["temple"])
    lines = "\n".join(refute.answer("+1.5 0.3; -1.5 0.3", CONFIG))
    assert lines.count("not contradicted, up to a peak of 4.5 g tan α") == 2
    narrow = {"half_width": CASE.column.half_width, "half_height": HEIGHT}
    monkeypatch.setitem(CONFIG["structures"], "temple", narrow)
    words = [f"{lobe.sign * lobe.length:+} {lobe.amplitude} {lobe.pause}" for lobe in CASE.lobes]
    lines = "\n".join(refute.answer("; ".join(words), CONFIG))
    assert "contradicted by" in lines
    assert "an example" in lines


def test_a_search_finds_a_case_that_its_draws_keep(monkeypatch):
    random = np.random.default_rng(1)
    assert refute.varied(ENTRY, random)["lobes"] != ENTRY["lobes"]
    value, comparison = refute.kept_fall(CASE, 0.0, 0, 1, SPEC)
    assert value == comparison.fall.strict > 0.0
    assert refute.kept_fall(CASE, value, 4, 1, SPEC)[0] == -1.0
    monkeypatch.setattr(refute, "strict_falls", lambda *_: iter([0.1, 0.001, 0.2, math.nan]))
    assert refute.kept_fall(CASE, 0.0, 4, 1, SPEC)[0] == 0.001


def test_only_a_worse_case_is_added(tmp_path, monkeypatch):
    path, case = tmp_path / "found.yaml", tmp_path / "case.yaml"
    path.write_text(f"# head\n{refute.in_yaml([ENTRY])}")
    monkeypatch.setattr(refute, "CASES", str(path))
    row = {"stays": 0.5}
    monkeypatch.setattr(refute, "row_of_case", lambda entry, *_: row | {"strict": entry["fall"]})
    case.write_text(refute.in_yaml(ENTRY))
    assert "not added" in refute.add(str(case), CONFIG)
    case.write_text(refute.in_yaml(ENTRY | {"fall": 0.5}))
    assert "has it" in refute.add(str(case), CONFIG)
    assert path.read_text().startswith("# head\n")
    assert yaml.safe_load(path.read_text())[0]["fall"] == 0.5


def test_the_quoted_case_is_the_one_that_remains_in_most_draws():
    row = {"sentence": "frame_over_column", "strict": 0.05, "stays": 0.5}
    row |= {"lighter": 0.0, "heavier": 0.25}
    rows = [row, row | {"strict": 0.03, "stays": 0.9}]
    found = worst_found.findings(pd.DataFrame(rows))
    assert found["steadiest_frame_over_column"]["strict"] == 0.03
    assert found["steadiest_heavier_over_lighter"] == {"holds": True}
