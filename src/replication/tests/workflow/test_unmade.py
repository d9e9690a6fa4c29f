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
SHARD = Rule("shard", [lambda wildcards: []], ["results/shards/{n}.csv"])
NOWHERE = Path("nowhere")


def test_rules_that_read_what_others_make_are_accepted():
    reader = Rule("report", ["results/tables/curve.csv", "results/shards/3.csv", "paper/x.typ"])
    refuse_unmade([CURVE, SHARD, reader], ["curve"], NOWHERE)


def test_result_that_no_rule_makes_is_refused_with_its_reader():
    reader = Rule("report", ["results/tables/curv.csv"])
    with pytest.raises(ValueError, match=r"^rule report reads \S+/curv.csv, which .* 'curve'\?$"):
        refuse_unmade([CURVE, reader], [], NOWHERE)


def test_text_that_names_the_missing_result_is_named(tmp_path):
    texts = [tmp_path / "report.typ", tmp_path / "format.typ"]
    for text, words in zip(texts, ('#let curve = found("curv")', "nothing"), strict=True):
        text.write_text(words, encoding="utf-8")
    reader = Rule("report", ["results/findings/curv.json", *map(str, texts)])
    with pytest.raises(ValueError, match=rf"^rule report \({texts[0]}\) reads results/findings/cu"):
        refuse_unmade([CURVE, reader], [], NOWHERE)


def test_table_of_a_figure_that_no_rule_makes_is_refused():
    with pytest.raises(ValueError, match=r"a figure reads results/tables/old.csv.* one of curve"):
        refuse_unmade([CURVE], ["old"], NOWHERE)


def test_published_table_that_the_workflow_no_longer_makes_is_to_be_deleted(tmp_path):
    (tmp_path / "old.csv").touch()
    with pytest.raises(ValueError, match=rf"delete {tmp_path}/old.csv if the workflow no longer"):
        refuse_unmade([CURVE, Rule("compare", ["results/tables/old.csv"])], [], tmp_path)


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
