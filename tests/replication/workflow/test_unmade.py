"""A result that no rule makes is refused, though a file of its name may be left."""

import re
from pathlib import Path

import pytest

from replication.pages.captions import check_captions
from replication.workflow.unmade import made_by, refuse_unmade


class Output(str):
    """An output of a rule as Snakemake has it: a path that can have wildcards."""

    def match(self, path):
        return re.fullmatch(re.sub(r"\{\w+\}", "[^/]+", self), path)


class Rule:
    def __init__(self, name, inputs=(), output=()):
        self.name, self.input, self.output = name, inputs, [Output(path) for path in output]


CURVE = Rule("curve", ["src/steps/curve.py"], ["results/tables/curve.csv"])


@pytest.mark.parametrize(
    ("inputs", "tables", "told"),
    [
        (["results/tables/curv.csv"], [], r"^rule report reads \S+/curv.csv, which .* 'curve'\?$"),
        (
            ["results/findings/curv.json", "report.typ", "format.typ"],
            [],
            r"^rule report \(report.typ\) reads results/findings/cu",
        ),
        ([], ["ol"], "a figure reads results/tables/ol.csv.* one of curve"),
        (["results/tables/old.csv"], [], "delete ref/old.csv if the workflow no longer"),
    ],
)
def test_result_that_no_rule_makes_is_refused_with_its_reader(
    tmp_path, plant, monkeypatch, inputs, tables, told
):
    texts = {"report.typ": '#let curve = found("curv")', "format.typ": "nothing", "ref/old.csv": ""}
    monkeypatch.chdir(plant(tmp_path, texts))
    with pytest.raises(ValueError, match=told):
        refuse_unmade([CURVE, Rule("report", inputs)], tables, Path("ref"))


CAPTIONS = {"results/tables/curve.csv": {"claims": ["eq_1"]}}


@pytest.mark.parametrize(
    ("captions", "figures", "told"),
    [
        (CAPTIONS, ["figures/curve.svg"], "^figures/curve.svg has no caption; expected one in"),
        ({"figures/old.svg": {"claims": []}}, [], "have figures/old.svg, which no rule makes"),
        ({"results/tables/curve.csv": {"claims": ["eq1"]}}, [], "names 'eq1'; did you mean 'eq_1'"),
    ],
)
def test_captions_and_results_that_do_not_fit_are_refused(captions, figures, told):
    check_captions(CAPTIONS, [], ["eq_1"], made_by([CURVE]))
    with pytest.raises(ValueError, match=told):
        check_captions(captions, figures, ["eq_1"], made_by([CURVE]))
