"""README's numbers, the published tables and the claims agree; the paper comes first."""

import re
from collections import Counter
from html import unescape

import matplotlib as mpl
import pandas as pd
import pytest

from documents import check
from documents.check import REFERENCE
from documents.compare import compare, departures
from documents.expect import faults
from replication.config import read_yaml
from replication.verdicts import unexpected
from tests.cases import ROOT, published
from topheavy import Column, RockingFrame, capacity, read_record

README = (ROOT / "README.md").read_text(encoding="utf-8")


def test_every_claim_has_its_expected_verdict_by_the_published_tables():
    assert unexpected(check.published(published())) == []


TABLE = {"key": [0, 1, 4, 9], "outcome": [0, 1, 1, 0], "count": [7, 8, 9, 9], "x": [1.0, 2, 3, 4]}
BOUNDS = {"relative": 1e-6, "absolute": 1e-9, "counts": 2}


@pytest.mark.parametrize(
    ("column", "content", "departs"),
    [
        ("key", [0, 1, 4, 8], "key (At positional index 3, first diff: 8 != 9)"),
        ("outcome", [1, 0, 1, 0], ""),
        ("outcome", [1, 0, 0, 0], "outcome (At positional index 0, first diff: 1 != 0)"),
        ("count", [9, 6, 9, 9], ""),
        ("count", [7, 8, 9, 12], "count (At positional index 3, first diff: 12 != 9)"),
        ("x", [1.0, 2, 3, 4.000001], ""),
        ("x", [1.0, 2, 3, 4.00001], "x (At positional index 3, first diff: 4.00001 != 4.0)"),
    ],
)
def test_column_is_compared_as_a_key_an_outcome_a_count_or_a_number(column, content, departs):
    ours, theirs = pd.DataFrame(TABLE | {column: content}), pd.DataFrame(TABLE)
    assert "; ".join(departures(ours, theirs, BOUNDS, ["outcome", "count"])) == departs


@pytest.mark.parametrize(
    ("verdict", "required", "words"),
    [
        ("agrees", True, []),
        ("differs", False, ["t.csv differs from"]),
        ("other parameters", False, []),
        ("other parameters", True, ["t.csv was not compared (other parameters)"]),
        ("not published", True, ["t.csv was not compared (not published)"]),
    ],
)
def test_run_fails_where_a_table_is_not_as_published(verdict, required, words):
    table = {"table": "t.csv", "published": "p.csv", "verdict": verdict, "departs": "x"}
    lines = faults([], [table | {"required": str(required)}])
    assert len(lines) == len(words)
    assert all(line.startswith(start) for line, start in zip(lines, words, strict=True))


def test_table_of_other_parameters_or_sources_is_not_compared(tmp_path):
    path = str(tmp_path / "vase.csv")
    pd.read_csv(ROOT / REFERENCE / "vase.csv").to_csv(path, index=False)
    (other := tmp_path / "other" / "vase.csv").parent.mkdir()
    other.write_text("structure\nbare\n", "utf-8")
    rule = {"params": {"a": 1}, "sources": {"s": "0"}, "tables": [path]}
    for change, verdict in (
        ({}, "agrees"),
        ({"params": {"a": 2}}, "other parameters"),
        ({"sources": {"s": "1"}}, "other parameters"),
        ({"tables": [str(tmp_path / "new.csv")]}, "not published"),
        ({"tables": [str(other)]}, "differs"),
    ):
        compared = compare({"vase": rule | change}, {"vase": rule}, BOUNDS)
        assert list(compared.verdict) == [verdict]


CONFIG = read_yaml(ROOT / "config/config.yaml")
TEMPLE = CONFIG["structures"]["temple"]
INPUTS = [  # names, commands, γ, sizes and pulses: no results
    "Eqs. (23) to (25)", "Eq. (25)", "1 + 2γ", "1 + 3γ", "ω = 5 p", "--cores 2 (2 to 15 minutes)",
    "Python 3.11 to 3.13", "(2 minutes)", "(6 m, beam as heavy",
    f"{2 * TEMPLE['half_height']:g} m × {2 * TEMPLE['half_width']:g} m",
    f"one-cosine pulse of {CONFIG['vase']['period']:g} s",
]  # fmt: skip


def test_numbers_of_readme_are_those_of_the_published_tables():
    found = published()
    trilith, vase, motions, spectra = (found[n] for n in ("trilith", "vase", "motions", "spectra"))
    errors = [100 * found["allen"][f"error_all_{ratio}"]["value"] for ratio in ("0.5", "2", "10")]
    gains = [
        100 * motions[f"gain_{name}"][end]
        for name in ("trilith", "temple", "tall")
        for end in ("least", "most")
    ]
    reduction = [100 * found["break_even"]["benefit_ends"][end] for end in ("low", "high")]
    falls = spectra["cycles_rise_with_mass"]
    fall = max(number for name, number in falls.items() if name.startswith("fall_"))
    sentences = [
        f"R̂ is at most {found['parameters']['limit_of_size_ratio']['value']:.1f} times R",
        f"p̂ = {trilith['frame_frequency_parameter']['value']:.2f} rad/s",
        "by {:.0f}, {:.0f} and {:.0f} % for γ = 0.5, 2 and 10".format(*errors),
        f"from {vase['minimum_of_the_column']['value']:.3f} g alone",
        f"from {vase['minimum_of_the_heaviest']['value']:.3f} g under a very heavy beam",
        "by {:.0f} to {:.0f} % (columns of 0.8 m), {:.0f} to {:.0f} % (6 m) and {:.0f} to {:.0f} % "
        "(12 m)".format(*gains),
        "{:.1f} to {:.1f} % lower than Housner's formula".format(*reduction),
        f"on {spectra['prevented_over_caused']['value']:.0f} times as much area as it causes it",
        f"it can fall, by up to {100 * fall:.1f} %",
    ]
    text = " ".join(re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", README).split())
    assert [sentence for sentence in sentences if sentence not in text] == []
    assert (spectra["minimum_rises_with_mass"]["holds_when"], falls["holds"]) == (True, False)
    anchors = re.findall(r"docs/numbers.md#([^)]+)", README)
    known = {f"{rule}.{name}" for rule, results in found.items() for name in results}
    assert len(anchors) > 10
    assert not set(anchors) - known
    results = text.partition("**Answer")[2].partition("## Use the library")[0]
    for words in [*sentences, *INPUTS]:
        assert words in results
        results = results.replace(words, "")
    assert re.findall(r"\d", results) == []


def test_example_of_readme_prints_what_its_comment_says(capsys):
    (code,) = re.findall(r"```python\n(.*?)```", README, re.DOTALL)
    exec(code, {})
    assert re.search(r":  # (.*)", code)[1].split(", ") == capsys.readouterr().out.split()


def test_capacities_of_readme_are_those_of_the_study():
    pier = Column.of_dimensions(width=1.6, height=9.6)
    record = read_record(ROOT / "data/records/el_centro_1940_NS.AT2")
    numbers = []
    for structure in (pier, RockingFrame(pier, 400 / 180)):
        curve = capacity(structure, record)
        over = [curve.over(window) for window in (0.05, 0.025, 0.1, 0.2)]
        numbers += [over[0], min(over), max(over)]
    stated = re.search(r"El Centro.* in it", README, re.DOTALL)[0]
    assert [f"{number:.1f}" for number in numbers] == re.findall(r"\d+\.\d+", stated)


@pytest.mark.parametrize("name", ["paper", "play"])
def test_published_notebook_prints_what_its_cells_do(name, monkeypatch, capsys):
    monkeypatch.chdir(ROOT / "notebooks")
    monkeypatch.setattr("IPython.display.display", show := lambda one, **_: print(one))
    names = {"display": show}
    with mpl.rc_context():
        for cell in read_yaml(f"{name}.ipynb")["cells"]:
            if cell["cell_type"] == "code":
                exec("".join(cell["source"]), names)
    page = unescape((ROOT / f"docs/notebook_{name}.html").read_text("utf-8"))
    shown = re.findall('(?s)data-mime-type="text/(?:plain|html)".*?</(?:pre|table)>', page)
    ours, theirs = (
        Counter(re.findall(r"\d+\.\d+(?:e-?\d+)?", re.sub("<[^>]*>", " ", text)))
        for text in (capsys.readouterr().out, " ".join(shown))
    )
    assert ours.total() > 10
    assert ours == theirs
