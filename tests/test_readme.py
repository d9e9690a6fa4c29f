"""Every number in the README's findings is one that the workflow published."""

import json
import re
import shutil
from collections import Counter
from importlib import import_module
from pathlib import Path

import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import JudgedClaim
from replication.judging.ledger import read_judged
from replication.pages.edition import count_table
from steps import headlines
from steps.shared.published import from_to

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "tests" / "reference"


def found() -> str:
    return headlines.found((ROOT / "README.md").read_text(encoding="utf-8"))


@pytest.fixture(scope="module")
def claims() -> dict[str, JudgedClaim]:
    rows = read_judged(REFERENCE / "claims.json")
    return {row.id: row for row in rows}


def test_every_number_is_published():
    assert list(headlines.headlines(ROOT)) == []


@pytest.mark.parametrize(
    "study", sorted(path.parent.name for path in ROOT.glob("studies/*/headlines.py"))
)
def test_study_that_is_not_published_has_no_numbers(tmp_path, study):
    """And those of the paper and of the other studies need none of its files."""
    gone = shutil.ignore_patterns(f"{study}*")
    left = Path(shutil.copytree(REFERENCE, tmp_path / "reference", ignore=gone))
    rows = json.loads((left / "claims.json").read_text(encoding="utf-8"))
    rows = [row for row in rows if row["study"] != study]
    (left / "claims.json").write_text(json.dumps(rows), encoding="utf-8")
    own = import_module(f"studies.{study}.headlines").HEADLINES
    every = headlines.by_passage(REFERENCE)
    assert own.keys() <= every.keys()
    others = {passage: of for passage, of in every.items() if passage not in own}
    assert headlines.by_passage(left) == others


def said() -> str:
    return " ".join(found().split())


def test_starts_of_the_trilith_are_as_many_as_said():
    starts = pd.read_csv(REFERENCE / "trilith_states.csv")
    assert f"of {len(starts)} starts in motion" in said()
    assert (starts[["rotation", "velocity"]] != 0.0).any(axis=1).all()


def test_floor_of_the_minima_is_that_of_the_search():
    vase = read_yaml(REFERENCE / "config.yaml")["vase"]
    assert vase["floor"] == 1e-3
    assert "Those narrower than a thousandth are not excluded" in said()
    broken = pd.read_csv(REFERENCE / "vase_exceptions.csv")
    records = broken[broken.kind == "record"]
    assert set(broken.structure) == {"fixed"}
    assert len(set(records.motion)) == 1
    assert "Short pulses and one record reverse the first" in said()


def test_judged_claims_of_the_paper_are_as_many_as_said(claims):
    of = Counter(claim.verdict for claim in claims.values() if not claim.study)
    wrong = of["slip"] + of["misprint"]
    assert (
        f"Of their {of.total()} claims, {of['confirmed']} are confirmed and {of['qualified']} hold "
        f"only on conditions that we state and test; {wrong} have slips or misprints in our text, "
        f"{of['by definition']} is a definition, {of['not tested']} were not tested, and none is "
        "refuted." in said()
    )
    assert of["refuted"] == 0


@pytest.mark.parametrize(
    ("shares", "digits", "words"),
    [([0.05, 0.09], 0, "5 to 9"), ([0.26, 0.163], 1, "16.3 to 26.0"), ([0.1], 0, "10 to 10")],
)
def test_range_has_both_its_ends(shares, digits, words):
    assert from_to(pd.Series(shares), digits) == words


def test_rise_under_each_pulse_of_the_period_is_published():
    rises = headlines.rises_at_one_period(REFERENCE)
    assert len(rises) == 3
    assert f"shapes of pulses of this period, it rises by {from_to(rises)} %" in said()


def test_minima_are_said_to_be_proven_where_the_ledger_confirms_it(claims):
    assert "under a very heavy cap beam; both are proven" in said()
    for proof in ("minimum_is_a_proven_boundary", "nothing_below_the_minimum_overturns"):
        assert claims[proof].verdict == "confirmed"


def test_portal_is_said_to_overturn_later_where_the_ledger_confirms_it(claims):
    assert "A portal overturns later still" in said()
    assert claims["portal_overturns_last"].verdict == "confirmed"


def test_two_thirds_of_the_gain_are_had_at_mass_ratio_one():
    share = pd.read_csv(REFERENCE / "mass_ratio.csv").set_index("mass_ratio").share_of_size_gain
    assert "Two thirds of the gain" in found()
    assert share[1.0] == pytest.approx(2 / 3, abs=1e-9)


def test_equations_said_to_be_wrong_are_those_of_their_kind(claims):
    equations = pd.read_csv(REFERENCE / "equations.csv")
    parts = (found().split("Eqs.")[1].split("have")[0], found().split("Eqs.")[2].split("hold")[0])
    for said, fault in zip(parts, ("sign", "convention"), strict=True):
        numbers = {int(n) for n in re.findall(r"\((\d+)\)", said)}
        assert numbers == {int(n) for n in equations[equations.fault == fault].equation}


def test_lowest_amplitude_is_said_to_rise_where_the_ledger_confirms_it(claims):
    assert "minimum overturning acceleration rises with γ" in said()
    assert claims["lowest_amplitude_rises_with_mass"].verdict == "confirmed"


def test_links_lead_somewhere():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#]+)\)", text):
        if not target.startswith("http"):
            assert (ROOT / target).exists(), f"README.md links to {target}, which does not exist"


def test_table_of_verdicts_counts_the_claims_of_paper_and_studies_apart():
    assert "\n".join(count_table(read_judged(REFERENCE / "claims.json"))) in found()


def test_run_takes_as_long_as_said():
    """Figures and documents, which the published costs leave out, take up to two minutes more."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    least, most = map(int, re.search(r"# (\d+) to (\d+) minutes on two cores", readme).groups())
    minutes = pd.read_csv(ROOT / "docs" / "costs.csv").seconds.sum() / 2 / 60
    assert least - 2 <= minutes <= most


def test_equations_are_named_as_the_tables_and_claims_have_them(claims):
    table = pd.read_csv(REFERENCE / "equations.csv", dtype={"equation": str})
    faults = table[table.follows.astype(str) == "False"].dropna(subset="equation")
    for kind, words in (("sign", "have wrong signs"), ("convention", "hold in another sign")):
        (listed,) = re.findall(rf"Eqs\. ([^;.]*?) {words}", said())
        expected = faults[faults.fault == kind].equation.drop_duplicates()
        assert re.findall(r"\((\d+)\)", listed) == list(expected)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    for words, function in (
        ("equation of motion", "equation_of_motion"),
        ("equivalent size", "size_ratio"),
        ("Eq.", "restitution"),
    ):
        named = {int(number) for number in re.findall(rf"{words} \((\d+)\)", readme)}
        own = {row.equation for row in claims.values() if row.function.endswith(f".{function}")}
        assert len(named) == 1
        assert named <= own


def test_doi_is_that_of_the_citation():
    cited = read_yaml(ROOT / "CITATION.cff")["references"][0]["doi"]
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert set(re.findall(r"10\.1061/[^\s\]]*\)ST[\d.A-Z-]*\d", readme)) == {cited}
    assert readme.count(cited) == 2


def test_lines_of_the_library_run(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("MPLBACKEND", "agg")
    (lines,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text("utf-8"), re.S)
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    exec(compile(lines, "README.md", "exec"), {})
    assert (tmp_path / "bent.png").stat().st_size > 5000
    assert "The lowest factor found that overturns is " in capsys.readouterr().out


def published(rule: str) -> dict:
    return json.loads((REFERENCE / "findings" / f"{rule}.json").read_text(encoding="utf-8"))


def test_counts_of_the_findings_are_the_published_ones():
    raises = published("vase")["frame_always_raises"]
    wide = sum(raises["exceptions_of_width"]["0.02"].values())
    assert (
        f"None of {raises['comparisons']} comparisons reverses the second; if intervals narrower "
        f"than 2 % of the uplift acceleration are left out, {wide} do" in said()
    )
    assert raises["exceptions"] == 0
    price = published("portal")["joints_carry_more"]
    forces = pd.read_csv(REFERENCE / "sources" / "portal_forces.csv").dropna()
    rocks = forces[forces.portal != "no uplift"].drop_duplicates(
        ["motion", "peak_acceleration", "span"]
    )
    records = (rocks.kind == "record").sum()
    assert price["resisted"]["fixed"] == 0
    assert f"In {price['rocking']} comparisons in which the portal rocks" in said()
    assert f"and both survive, {records} of them under records" in said()


def test_citation_counts_the_claims(claims):
    paper = [row for row in claims.values() if row.study == ""]
    judged = [row for row in paper if row.verdict not in ("not tested", "by definition")]
    abstract = " ".join(read_yaml(ROOT / "CITATION.cff")["abstract"].split())
    judged_too = len(judged) + sum(row.verdict == "by definition" for row in paper)
    assert f"as {len(paper)} claims, of which {judged_too} are judged" in abstract
