"""Verdicts, the digits of numbers, claims, and what is said of a mistake in a step or config."""

import math
from functools import reduce
from operator import getitem
from textwrap import indent
from types import SimpleNamespace

import pandas as pd
import pytest

from replication import step
from replication.claims import Claim, read_claims
from replication.config import read_config, read_yaml
from replication.digits import decimals
from replication.sections import (
    Degrees,
    Grid,
    Items,
    MassRatio,
    Paper,
    Positive,
    Range,
    Section,
    Shape,
    StructureName,
)
from replication.step import truth, value
from replication.verdicts import judged, unexpected, verdict_on
from tests.cases import ROOT

STATEMENT = {"id": "s", "where": "p. 1", "statement": "It is so.", "expected": "confirmed"}
NUMBER = STATEMENT | {"id": "n", "printed": 0.275, "tolerance": 0.0005}
SIMULATED = STATEMENT | {"expected": "supported"}


@pytest.mark.parametrize(
    ("claim", "finding", "verdict", "differs"),
    [
        (NUMBER, value(0.2751, 0.0), "confirmed", ""),
        (NUMBER, value(0.2754, 0.00005), "confirmed", ""),
        (NUMBER, value(0.2756, 0.0), "refuted", ""),
        (NUMBER, value(math.nan, 0.0), "refuted", ""),
        (NUMBER, value(0.3, 0.0, meant_value=0.275, kind="number"), "confirmed", "number"),
        (NUMBER, value(0.3, 0.0, meant_value=0.29, kind="letter"), "refuted", ""),
        (NUMBER, value(0.275, 0.0, meant_value=0.29, kind="letter"), "confirmed", ""),
        (STATEMENT, truth(True), "confirmed", ""),
        (STATEMENT, truth(False), "refuted", ""),
        (STATEMENT, truth(False, meant_holds=True, kind="sign"), "confirmed", "sign"),
        (STATEMENT, truth(False, meant_holds=False, kind="sign"), "refuted", ""),
        (STATEMENT, truth(False, holds_when=True, condition="θ is small"), "qualified", ""),
        (STATEMENT, truth(False, holds_when=False), "refuted", ""),
        (SIMULATED, truth(True), "supported", ""),
        (SIMULATED, truth(False), "refuted", ""),
    ],
)
def test_verdict_is_by_the_number_or_by_what_holds(claim, finding, verdict, differs):
    assert verdict_on(Claim(**claim), finding) == (verdict, differs)


KINDS = "expected one of sign, number, letter, bracket, radical"


@pytest.mark.parametrize(
    ("claim", "finding", "message"),
    [
        (NUMBER, value(0.275, 5.1e-5), "claim n: the error is"),
        (NUMBER, value(0.275, math.nan), "claim n: the error is"),
        (NUMBER, truth(True), "claim n: the finding has no value"),
        (STATEMENT, truth(False, meant_holds=True), KINDS),
        (STATEMENT, truth(False, meant_holds=True, kind="Sign"), KINDS),
    ],
)
def test_finding_of_another_sort_gives_no_verdict(claim, finding, message):
    with pytest.raises(ValueError, match=message):
        verdict_on(Claim(**claim), finding)


@pytest.mark.parametrize(
    ("number", "error", "printed", "tolerance", "expected"),
    [
        (3.786642, 1e-9, 3.79, 0.005, "3.787"),
        (0.2754999, 0.0, 0.275, 0.0005, "0.2754999"),
        (0.2755001, 0.0, 0.275, 0.0005, "0.2755001"),
        (4.0, 0.0, 4, 0.4, "4"),
        (1.23456789, 0.01, None, None, "1.23"),
        (0.5, 0.0, None, None, "0.5"),
    ],
)
def test_number_has_the_digits_that_it_bears(number, error, printed, tolerance, expected):
    assert decimals(number, error, printed, tolerance) == expected


# Claims -------------------------------------------------------------------------------------------


GOOD = """\
- id: stands
  where: here
  statement: It survives {scale} times.
  finding: run.good
"""


def read(tmp_path, text=GOOD):
    path = tmp_path / "claims.yaml"
    path.write_text("ours:\n" + indent(text, " "), encoding="utf-8")
    return read_claims(str(path), {"scale": 1.3})


def test_claim_has_the_numbers_of_its_config_and_a_false_one_is_named_with_its_file(tmp_path):
    (claim,) = read(tmp_path)
    assert (claim.statement, claim.part) == ("It survives 1.3 times.", "ours")
    row = judged(claim, {"run": {"good": truth(True)}})
    assert (row["verdict"], unexpected([row])) == ("confirmed", [])
    (line,) = unexpected([judged(claim, {"run": {"good": truth(False)}})])
    assert "claims.yaml: verdict of stands is refuted, expected confirmed (computed: " in line
    with pytest.raises(SystemExit, match="names the finding 'good' of rule run, which has bad"):
        judged(claim, {"run": {"bad": truth(True)}})
    (claim,) = read(tmp_path, GOOD.replace("{scale} times", "in {a, {0.5} and {scale.real}"))
    assert claim.statement == "It survives in {a, {0.5} and {scale.real}."  # all of it is text


@pytest.mark.parametrize(
    ("more", "tolerance"),
    [
        ("  printed: 0.275\n", 0.0005),
        ("  printed: 5\n", 0.5),
        ("  printed: R > 0\n", None),
        ("  printed: 0.275\n  expected: not tested\n", None),
    ],
)
def test_a_printed_number_that_is_judged_has_the_tolerance_of_its_digits(tmp_path, more, tolerance):
    text = GOOD.replace("  finding: run.good\n", "") if "not tested" in more else GOOD
    (claim,) = read(tmp_path, text + more)
    assert claim.tolerance == tolerance


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("{scale}", "{scal}", "stands has {scal}, which is no key of the config; expected one of"),
        ("where", "were", "claim stands: 'where': Field required"),
        ("  finding: run.good\n", "", "stands has the finding ''; expected rule.name, and none if"),
        ("run.good", "good", "stands has the finding 'good'; expected rule.name, and none if"),
        ("good", "good\n  expected: not tested", "has the finding 'run.good'; expected rule.name"),
        ("good", "good\n  printed: .nan", "Input should be a finite number"),
        ("{scale}", "{scale:zz}", "claim stands: Unknown format code 'z'"),
        (GOOD, GOOD + GOOD, "claim stands: the id is there twice"),
        (GOOD, "- text", "claim number 1 of ours: "),
    ],
)
def test_mistake_in_a_claim_is_named(tmp_path, old, new, message):
    with pytest.raises(SystemExit) as error:
        read(tmp_path, GOOD.replace(old, new))
    assert message in str(error.value)


# Steps --------------------------------------------------------------------------------------------

TABLE = pd.DataFrame({"x": [1.0, 2.0]})


class Outputs(SimpleNamespace):
    def items(self):
        return vars(self).items()


@pytest.mark.parametrize(
    ("compute", "findings", "message"),
    [
        (lambda: {"good": truth(True)}, None, "returned {'good': {'holds': True}} where"),
        (lambda facter: TABLE, None, "takes 'facter'; rule tiny has the inputs (none) and"),
        (lambda: TABLE, lambda tinny: {}, "takes 'tinny'; rule tiny has the inputs tiny and the"),
        (lambda: TABLE, lambda tiny: {"one": 3.0}, "finding 'one' is 3.0; expected value"),
        (lambda: TABLE, lambda: {"one": value(math.nan, 0)}, "'one' is {'value': nan, 'err"),
    ],
)
def test_mistake_in_a_step_is_named_in_its_log(tmp_path, compute, findings, message):
    output = Outputs(table="results/tiny.csv")
    if findings:
        output.findings = "results/tiny.json"
    params, log = {"factor": 2.0}, [tmp_path / "tiny.log"]
    job = SimpleNamespace(rule="tiny", input={}, output=output, params=params, log=log)
    with pytest.raises(SystemExit):
        step.run(job, compute, findings)
    text = log[0].read_text("utf-8")
    assert message in text
    assert text.startswith("tests/test_replication.py: ")


# Configs ------------------------------------------------------------------------------------------


class Inner(Section):
    shape: Shape
    ratios: Items[MassRatio]
    ends: Range[Degrees]
    structure: StructureName


class Inputs(Section):
    structures: dict[str, float]
    scale: Positive
    grid: Grid
    inner: Inner


CONFIG = """\
structures: {temple: 1.0}
scale: 1.3
grid: {lowest: 0.5, highest: 2.0, points: 3}
inner: {shape: one-sine, ratios: [0.0, .inf], ends: [3.0, 30.0], structure: temple}
"""


def read_as(tmp_path, content):
    path = tmp_path / "config.yaml"
    path.write_text(content, encoding="utf-8")
    return read_config(str(path), Inputs)


def test_config_with_its_keys_is_read(tmp_path):
    assert read_as(tmp_path, CONFIG)["inner"]["ratios"] == [0.0, math.inf]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("scale", "sacle", "unknown key 'sacle'; did you mean 'scale'?"),
        ("scale: 1.3\n", "", "the key 'scale' is missing"),
        ("{temple: 1.0}", "3", "structures is 3; input should be a valid dictionary"),
        ("1.3", "'1.3'", "scale is '1.3'; input should be a valid number: without quotes"),
        ("1.3", "1,3", "scale is '1,3'; input should be a valid number: a decimal point"),
        ("2.0", "2,50", "grid has the key 50; expected a name. A number has a point"),
        ("highest: 2.0", "highest: 0.0", "grid.highest is 0.0; input should be greater than 0"),
        ("lowest: 0.5", "lowest: 3.0", "expected more than lowest, 3"),
        ("one-sine", "one-sin", "inner.shape is 'one-sin'; input should be 'one-sine', 'one-cos"),
        ("[3.0, 30.0]", "[30.0, 3.0]", "inner.ends is [30.0, 3.0]; expected numbers that rise"),
        ("3.0,", "0.05,", "inner.ends.0 is 0.05; input should be greater than or equal to 1"),
        ("structure: temple", "structure: tmeple", "inner.structure is 'tmeple'; expected a name"),
        ("scale: 1.3", "scale: 1.3\nscale: 1.4", "config.yaml:3: the key 'scale' is there twice"),
        ("scale: 1.3", "scale:\t1.3:", "config.yaml:2: found character "),
    ],
)
def test_mistake_in_a_config_is_named_with_file_and_value(tmp_path, old, new, message):
    with pytest.raises(SystemExit) as error:
        read_as(tmp_path, CONFIG.replace(old, new))
    assert str(error.value).startswith(str(tmp_path))
    assert message in str(error.value)


@pytest.mark.parametrize(
    ("path", "content", "message"),
    [
        ("engine.across.structure", "tall", "engine.caps: expected bridge, tall, temple"),
        ("spectra.mass_ratios", [1.0, 0.5], "is [1.0, 0.5]; expected numbers that rise"),
        ("motions.fewer", 501, "motions.fewer: expected at most 500"),
        ("break_even.velocities", [0.8], "break_even.velocities: expected 0.6 among them"),
        ("spectra.finer.resolution", 0.5, "spectra.finer.resolution: expected less than that of"),
    ],
)
def test_sections_that_contradict_each_other_are_refused(path, content, message):
    config = read_yaml(ROOT / "config" / "config.yaml")
    *keys, last = path.split(".")
    reduce(getitem, keys, config)[last] = content
    with pytest.raises(SystemExit) as error:
        read_config("config.yaml", Paper, config)
    assert message in str(error.value)


def test_missing_file_is_named(tmp_path):
    with pytest.raises(SystemExit, match=r"there is no file .*nowhere\.yaml"):
        read_yaml(tmp_path / "nowhere.yaml")
