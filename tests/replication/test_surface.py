"""What scripts use of the machine: workbench and drawing."""

import json
import math
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
import pytest

from figures.restitution import draw
from replication.drawing import described, letter, save, sheet
from replication.judging.findings import Findings, read_findings, write_findings
from replication.workbench import truth, value


def test_findings_are_plain_and_survive_being_written(tmp_path):
    findings = {
        "number": value(np.float64(1.5), np.float32(0.25), "m", meant_value=np.float64(2.0)),
        "fact": truth(np.bool_(True), peaks=np.array([1.0, 2.0]), name="α"),
    }
    number = {"value": 1.5, "error": 0.25, "unit": "m", "meant_value": 2.0}
    assert findings["number"].entries == number
    assert findings["fact"].entries == {"holds": True, "peaks": [1.0, 2.0], "name": "α"}
    assert type(findings["fact"].holds) is bool
    path = tmp_path / "findings.json"
    write_findings(path, Findings(findings, ("a.b",)))
    text = path.read_text(encoding="utf-8")
    entries = {name: finding.entries for name, finding in findings.items()}
    assert json.loads(text) == entries | {"called": ["a.b"]}
    assert read_findings(path) == Findings(findings, ("a.b",))
    assert "α" in text
    assert text.endswith("}\n")


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_finding_that_is_no_number_is_not_written(tmp_path, number):
    with pytest.raises(ValueError, match="JSON"):
        write_findings(tmp_path / "findings.json", Findings({"lost": value(number, 0.0)}))


ROOT = Path(__file__).resolve().parents[2]
WORDS = {"title": "Size & frequency", "alt": "Two curves, one > 1 and\n one < 1."}


@pytest.fixture
def figure():
    with plt.style.context(ROOT / "figures" / "style.mplstyle"):
        yield draw(pd.read_csv(ROOT / "tests" / "reference" / "restitution_over_slenderness.csv"))
    plt.close("all")


def test_last_bits_of_the_layout_change_no_byte(figure, tmp_path):
    save(figure, tmp_path / "one.svg", **WORDS)
    axes = figure.axes[0]
    axes.set_position(np.nextafter(axes.get_position(original=True).bounds, 1.0))
    save(figure, tmp_path / "other.svg", **WORDS)
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "other.svg").read_bytes()


@pytest.mark.parametrize(
    ("svg", "title", "alt"), [("<svg >", "", "b"), ("<svg >", "a", " "), ("<p>", "a", "b")]
)
def test_figure_without_words_is_refused(svg, title, alt):
    with pytest.raises(ValueError, match=r"expected two texts and an SVG: write title and alt"):
        described(svg, title, alt)


def test_letters_of_a_drawing_run_on_from_the_one_above():
    figure, axes = sheet(88.0, 40.0, ncols=2)
    letter(axes, ["Size", "Frequency"], first="c")
    assert [axis.get_title() for axis in axes] == ["(c) Size", "(d) Frequency"]
    plt.close(figure)
