"""The published edition checked without a run: whatever is tampered with is named."""

import inspect
import json
import math
import re
import shutil
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest

from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import Claim
from replication.judging.findings import Finding, Findings, findings_by_rule
from replication.judging.ledger import read_judged, read_ledger, with_verdict
from replication.pages.edition import count_table, verdict_page
from replication.pages.edition_check import CLAIMS, claims, close, pages
from replication.pages.edition_check import main as check_edition
from replication.pages.seal import SEAL, seal
from replication.workbench import truth, value
from steps import redrawn
from steps.recheck import equations, main
from steps.redrawn import DIGITS, departures, entries, same, scripts, step, undrawn

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "tests" / "reference"
CLAIM = Claim(
    id="size",
    where="p. 4",
    statement="It is so.",
    printed=0.415,
    tolerance=5e-4,
    function="topheavy.Column",
    rule="trilith",
    finding="size",
    expected="confirmed",
)
FINDINGS = {"trilith": Findings({"size": value(0.4148, 1e-16)}, ("topheavy.structures.Column",))}


AGAIN = {}
"""What each rule draws from its tables, by the times of these."""


@pytest.fixture(autouse=True)
def _drawn_once(monkeypatch):
    """Draw the findings of a rule again when one of its tables was written again, and only then."""

    def once(rule, folder):
        names = inspect.signature(redrawn.step(rule).findings).parameters
        places = [
            folder / part / f"{name}.csv" for name in names for part in (".", "sources", "studies")
        ]
        key = rule, *((path, path.stat().st_mtime_ns) for path in places if path.is_file())
        if key not in AGAIN:
            AGAIN[key] = [*entries(rule, folder)]
        return AGAIN[key]

    monkeypatch.setattr(redrawn, "entries", once)


@pytest.fixture(scope="module")
def edition(tmp_path_factory):
    """A copy of what is published, and of what it is checked by."""
    root = tmp_path_factory.mktemp("edition") / "tree"
    config = read_yaml(ROOT / "config" / "config.yaml")
    wanted = ["README.md", "config/config.yaml", "docs/verdicts.md", "docs/verify_grid.csv"]
    wanted += ["paper/claims.yaml", "docs/costs.csv", "docs/findings.md"]
    for study in config["studies"]:
        wanted += [f"studies/{study}/{name}.yaml" for name in ("claims", "config")]
    for name in wanted:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(ROOT / name, root / name)
    shutil.copytree(ROOT / "tests" / "reference", root / "tests" / "reference")
    for name in ("src/topheavy", "studies"):
        skipped = shutil.ignore_patterns("__pycache__", "*.yaml", "*.typ", "tests", "figures")
        shutil.copytree(ROOT / name, root / name, ignore=skipped, dirs_exist_ok=True)
    for name in ("CITATION.cff", "codecheck.yml", "docs/exhibits.md"):
        shutil.copyfile(ROOT / name, root / name)
    seal(root)
    return root


@pytest.fixture(scope="module")
def faults_before(edition):
    return set(main(edition)[1])


@pytest.fixture
def tampered(edition, faults_before):
    """Change one file of the copy and return what is reported; afterwards it is as before.

    The edition is sealed anew, as by a forger: its checksums alone tell of any change.
    """
    kept = {edition / SEAL: (edition / SEAL).read_bytes()}

    def change(name, edit, check=main):
        path = edition / name
        kept[path] = path.read_bytes()
        text = path.read_text(encoding="utf-8")
        new = edit(text)
        assert new != text
        path.write_text(new, encoding="utf-8")
        seal(edition)
        return [fault for fault in check(edition)[1] if fault not in faults_before]

    yield change
    for path, content in kept.items():
        path.write_bytes(content)


def test_published_edition_agrees_with_itself():
    lines, faults = main(ROOT)
    assert faults == []
    config = read_yaml(ROOT / "config" / "config.yaml")
    lines = [line for line in lines if not line.startswith("the edition is older than")]
    assert [line.split(":")[0] for line in lines] == [
        "paper",
        "ours",
        "reproduced",
        *config["studies"],
    ]


MISSING = (
    "does not exist; expected a file of the published run, or no check of it in "
    "src/steps/recheck.py"
)


@pytest.mark.parametrize(
    ("name", "edit"),
    [
        ("paper/claims.yaml", lambda text: text.replace("statement:", "statemend:", 1)),
        ("paper/claims.yaml", lambda text: text + "\n- : ["),
        ("tests/reference/findings/vase.json", lambda text: text[:-20]),
        ("tests/reference/findings/vase.json", lambda text: "[]"),
        ("tests/reference/vase.csv", lambda text: text.replace("mass_ratio", "ratio", 1)),
        ("tests/reference/config.yaml", lambda text: text.replace("vase:", "vases:", 1)),
        ("config/config.yaml", lambda text: text.replace("studies:", "study:", 1)),
    ],
)
def test_broken_file_is_told_in_a_line(edition, name, edit):
    path = edition / name
    whole = path.read_text("utf-8")
    path.write_text(edit(whole), "utf-8")
    try:
        faults = main(edition)[1]
    finally:
        path.write_text(whole, "utf-8")
    assert faults
    assert not any("Traceback" in fault for fault in faults)


def test_last_line_says_how_many_inputs_and_texts_are_newer_than_the_edition(capsys):
    for older, told in (
        (["the edition is older than a, which changed"] * 2, "2 inputs and"),
        ([], "the published"),
    ):
        with pytest.raises(SystemExit) as ended:
            close(["paper: 3", *older], [])
        assert ended.value.code == 0
        assert capsys.readouterr().out.splitlines()[-1].startswith(told)


def test_edition_without_its_claims_says_so(edition):
    path = edition / "tests/reference/claims.json"
    away = path.rename(path.with_suffix(".away"))
    try:
        assert main(edition) == ([], [f"{path} {MISSING}"])
    finally:
        away.rename(path)


def test_edition_of_an_older_machine_says_which_part_of_a_row_is_missing(edition):
    path = edition / "tests/reference/claims.json"
    kept = path.read_text(encoding="utf-8")
    path.write_text(kept.replace('"condition": ', '"terms": ', 1), encoding="utf-8")
    try:
        lines, faults = main(edition)
    finally:
        path.write_text(kept, encoding="utf-8")
    assert lines == []
    assert ["'terms'" in fault for fault in faults] == [True]


def test_check_that_reads_an_unpublished_table_names_the_check(edition):
    def reads(folder, _):
        yield (folder / "gone.csv").read_text()

    _, faults = check_edition(reads, edition)
    assert faults == [f"{edition / 'tests/reference/gone.csv'} {MISSING}"]


@pytest.mark.parametrize(
    ("name", "field", "new"),
    [
        ("same_equation_of_motion", "computed", False),
        ("trilith_size", "computed", 0.4147),
        ("trilith_size", "error", 0.0),
        ("trilith_size", "printed", 0.416),
        ("trilith_size", "tolerance", 1.0),
        ("trilith_size", "verdict", "refuted"),
        ("trilith_size", "expected", "refuted"),
        ("trilith_size", "statement", "It is larger."),
        ("trilith_size", "rule", "heavier"),
        ("trilith_size", "unit", "km"),
    ],
)
def test_every_field_of_a_published_row_is_made_anew(name, field, new):
    claim, row = (
        next(row for row in rows if row.id == name)
        for rows in (read_ledger([ROOT / "paper/claims.yaml"]), read_judged(ROOT / CLAIMS))
    )
    findings = findings_by_rule((REFERENCE / "findings").glob("*.json"))
    (fault,) = claims([claim], findings, [replace(row, **{field: new})], ROOT)
    assert fault.startswith(f"claim {name}: {field} is {new!r} in tests/reference/")


def test_every_truth_that_is_flipped_is_noticed(edition):
    rows = read_judged(edition / CLAIMS)
    paths = [edition / "paper" / "claims.yaml", *sorted(edition.glob("studies/*/claims.yaml"))]
    findings = findings_by_rule((edition / "tests" / "reference" / "findings").glob("*.json"))
    flipped = {r.id for r in rows if isinstance(r.computed, bool)}
    assert len(flipped) > 50
    changed = [replace(r, computed=not r.computed) if r.id in flipped else r for r in rows]
    told = {
        found[1]
        for fault in claims(read_ledger(paths), findings, changed, edition)
        if (found := re.match(r"claim (\w+): computed is ", fault))
    }
    assert told == flipped


@pytest.mark.parametrize(
    ("rule", "finding", "key", "new", "told"),
    [
        ("trilith", "size", "value", 0.5, "claim trilith_size: computed is"),
        ("trilith", "size", "error", 1e-3, "claim trilith_size: the error is 0.001"),
        ("equations", "eq1", "holds", False, "claim eq1 is refuted; expected confirmed"),
        ("equations", "eq1", "holds", False, "findings/equations.json: eq1.holds is False, and T"),
    ],
)
def test_finding_that_is_changed_is_named(tampered, rule, finding, key, new, told):
    def edit(text):
        found = json.loads(text)
        found[finding][key] = new
        return json.dumps(found)

    faults = tampered(f"tests/reference/findings/{rule}.json", edit)
    assert any(told in fault for fault in faults)


DRAWN = sorted(
    path.stem for path in REFERENCE.glob("findings/*.json") if undrawn(path.stem) is None
)


def test_four_fifths_of_all_entries_are_drawn_again():
    drawn = sum(len(list(entries(rule, REFERENCE))) for rule in DRAWN)
    findings = findings_by_rule(REFERENCE.glob("findings/*.json")).values()
    assert drawn >= 0.8 * sum(len(one.entries) for of in findings for one in of.by_name.values())


def other(entry):
    """Another entry of the same type."""
    match entry:
        case bool():
            return not entry
        case None | int() | float():
            return 1.5 * (entry or 0.0) + 1.0
        case dict():
            return {}
        case _:
            return [*entry, 0.0] if isinstance(entry, list) else f"{entry}."


@pytest.mark.parametrize("rule", DRAWN)
def test_finding_follows_from_its_table(rule):
    findings = findings_by_rule([REFERENCE / "findings" / f"{rule}.json"])
    assert list(departures(REFERENCE, findings)) == []
    drawn = {(name, key) for name, key, _ in entries(rule, REFERENCE)}
    changed = {
        name: replace(
            finding,
            entries={
                key: other(entry) if (name, key) in drawn else entry
                for key, entry in finding.entries.items()
            },
        )
        for name, finding in findings[rule].by_name.items()
    }
    faults = list(departures(REFERENCE, {rule: replace(findings[rule], by_name=changed)}))
    assert len(faults) == len(drawn) > 0


def test_table_without_what_its_finding_needs_is_named(tmp_path):
    table = (REFERENCE / "sources" / "statements.csv").read_text(encoding="utf-8")
    (tmp_path / "statements.csv").write_text(table.replace("largest", "lorgest"), encoding="utf-8")
    findings = findings_by_rule([REFERENCE / "findings" / "statements.json"])
    (fault,) = departures(tmp_path, findings)
    assert fault.startswith("findings/statements.json cannot be drawn from statements (.csv): ")


@pytest.mark.parametrize(
    ("found", "expected", "is_same"),
    [
        (1.0000001, 1.0, True),
        (1.00001, 1.0, False),
        (True, True, True),
        (1, True, False),
        (True, 1, False),
        ([1.0], [1.0], True),
        ([1.0, 2.0], [1.0], False),
        ([1.0], [1.0, 2.0], False),
        ({"a": 1.0, "b": 2.0}, {"a": 1.0}, True),
        ({"b": 2.0}, {"a": 1.0}, False),
        (None, 1.0, False),
        (math.nan, 1.0, False),
    ],
)
def test_entry_is_the_tables_to_its_digits(found, expected, is_same):
    assert same(found, expected, DIGITS) is is_same


def test_row_that_no_ledger_has_is_found():
    found = list(claims([CLAIM], FINDINGS, [judged_row(), judged_row(id="more")], ROOT))
    assert found == ["claim more is not in both the ledger and tests/reference/claims.json"]


def test_findings_of_every_rule_are_drawn_or_said_not_to_be(jobs):
    made = {Path(path).stem: job for job in jobs for path in job.findings}
    assert not [rule for rule in made if undrawn(rule) == ""]
    for rule, job in made.items():
        assert [Path(step(rule).__file__)] == [ROOT / script for script in job.scripts]
    assert len(scripts()) <= len(made)


def test_findings_of_a_rule_that_says_nothing_are_named(edition):
    reference = edition / "tests" / "reference"
    (fault,) = departures(reference, {"speed": Findings({})})
    assert fault.startswith("findings/speed.json: nothing draws these findings from a table")


def test_function_that_did_not_run_is_named(tampered):
    def edit(text):
        found = json.loads(text)
        found["called"] = [name for name in found["called"] if "size_ratio" not in name]
        return json.dumps(found)

    faults = tampered("tests/reference/findings/mass_ratio.json", edit)
    assert any(
        "equivalent_column_is_larger: its rule mass_ratio never called" in fault for fault in faults
    )


@pytest.mark.parametrize(
    ("table", "column"),
    [
        ("mass_ratio", "frequency_ratio"),
        ("mass_ratio", "size_ratio"),
        ("restitution_over_slenderness", "restitution"),
        ("restitution_over_mass_ratio", "restitution"),
        ("moment_rotation", "moment"),
    ],
)
def test_table_that_is_not_the_equations_is_found(edition, tmp_path, table, column):
    reference = shutil.copytree(edition / "tests" / "reference", tmp_path / "reference")
    assert list(equations(reference)) == []
    found = pd.read_csv(reference / f"{table}.csv")
    found.loc[1, column] *= 0.9
    found.to_csv(reference / f"{table}.csv", index=False)
    (fault,) = equations(reference)
    assert fault.startswith(f"{table}.csv")


def test_table_that_does_not_bear_its_finding_is_found(tampered):
    def swap(text):
        lines = text.splitlines(keepends=True)
        return "".join([*lines[:2], lines[3], lines[2], *lines[4:]])

    faults = tampered("tests/reference/heavier.csv", swap)
    assert any("heavier.json: heavier_survives_more.holds is True, and False" in f for f in faults)


@pytest.mark.parametrize(
    ("page", "old", "new", "told"),
    [
        ("docs/verdicts.md", 'id="eq1"', 'id="eq_1"', "docs/verdicts.md, line "),
        ("docs/verdicts.md", "| confirmed |", "| refuted |", "docs/verdicts.md, line "),
        ("README.md", "| paper | ", "| paper | 1", "README.md, line "),
        ("README.md", "| study `mechanism` | ", "| study `mechanism` | 1", "README.md, line "),
        ("README.md", "| | confirmed |", "| | Confirmed |", "README.md: the page has 0 lines"),
    ],
)
def test_page_that_says_otherwise_is_named(tampered, page, old, new, told):
    def wrong(root):
        return [], list(pages(root, read_judged(root / CLAIMS)))

    (fault,) = tampered(page, lambda text: text.replace(old, new, 1), wrong)
    assert fault.startswith(told)


def swapped(text):
    """The README with the shares on which a heavy cap helps and harms the wrong way round."""
    return text.replace("12.2 %", "?").replace("0.6 %", "12.2 %").replace("?", "0.6 %")


def test_number_in_the_readme_that_is_not_published_is_named(tampered):
    faults = tampered("README.md", lambda text: text.replace("0.273 g", "0.373 g", 1))
    assert any(fault.startswith("README.md: ") for fault in faults)


@pytest.mark.parametrize(
    ("config", "old", "new", "told"),
    [
        ("config/config.yaml", "mass_ratio: 0.434", "mass_ratio: 0.5", "config/config.yaml: "),
        ("tests/reference/config.yaml", "mass_ratio: 0.434", "mass_ratio: 0.5", "config/config"),
        (
            "tests/reference/config.yaml",
            "\nsolver:",
            "\ngone: 1\nsolver:",
            "config/config.yaml: gone",
        ),
    ],
)
def test_config_that_is_not_that_of_the_published_run_is_named(tampered, config, old, new, told):
    faults = tampered(config, lambda text: text.replace(old, new, 1))
    assert any(fault.startswith(told) for fault in faults)


@pytest.mark.parametrize("study", sorted(p.stem for p in REFERENCE.glob("studies/*.yaml")))
def test_config_of_a_study_that_is_not_that_of_the_published_run_is_named(tampered, study):
    faults = tampered(f"studies/{study}/config.yaml", lambda text: f"{text}\nmore: 1\n")
    assert any(fault.startswith(f"studies/{study}/config.yaml: more is not") for fault in faults)


def test_tolerance_that_is_too_wide_is_named(tampered):
    wide = "printed: 0.415\n  unit: m\n  tolerance: 0.005"
    faults = tampered("paper/claims.yaml", lambda text: text.replace(wide[:-1] + "05", wide))
    assert any(fault.startswith("claim trilith_size: tolerance 0.005 would") for fault in faults)


@pytest.mark.parametrize("change", ["\n", "| `more` | | | | | | |\n"])
def test_line_that_is_added_to_the_page_is_noticed(tampered, change):
    assert any(
        "docs/verdicts.md, line" in f for f in tampered("docs/verdicts.md", lambda t: t + change)
    )


def test_row_of_the_ledger_that_is_changed_is_named(tampered):
    faults = tampered(
        "paper/claims.yaml", lambda text: text.replace("printed: 0.415", "printed: 0.425")
    )
    assert any(
        f.startswith(("claim trilith_size is refuted", "claim trilith_size: printed"))
        for f in faults
    )


def judged_row(**changes):
    return replace(with_verdict(CLAIM, FINDINGS, ROOT), **changes)


@pytest.mark.parametrize("change", [{"computed": 0.42}, {"verdict": "refuted"}, {"id": "other"}])
def test_row_that_its_finding_does_not_bear_is_found(change):
    assert list(claims([CLAIM], FINDINGS, [judged_row()], ROOT)) == []
    assert list(claims([CLAIM], FINDINGS, [judged_row(**change)], ROOT))


def test_row_that_is_published_twice_is_found():
    (fault,) = claims([CLAIM], FINDINGS, [judged_row()] * 2, ROOT)
    assert fault.startswith("claim size is 2 times in tests/reference/claims.json")


def test_claim_that_a_run_left_untested_is_not_published():
    lacking = {"trilith": Findings({"size": Finding.of({"not_tested": "no engine"})})}
    row = with_verdict(CLAIM, lacking, ROOT)
    assert list(claims([CLAIM], lacking, [row], ROOT)) == [
        "claim size is not tested; expected confirmed"
    ]


def test_number_is_not_the_same_as_a_truth():
    (fault,) = claims([CLAIM], FINDINGS, [judged_row(computed=True)], ROOT)
    assert "computed is True" in fault
    findings = {"trilith": replace(FINDINGS["trilith"], by_name={"size": truth(True)})}
    claim = replace(CLAIM, printed=None, tolerance=None)
    row = replace(with_verdict(claim, findings, ROOT), computed=1)
    assert list(claims([claim], findings, [row], ROOT))


def test_pages_are_those_of_the_rows(tmp_path):
    rows = [judged_row()]
    table = tmp_path / "tests/reference/sources/t.csv"
    for folder in (table.parent, tmp_path / "docs"):
        folder.mkdir(parents=True)
    table.write_text("x\n1\n", encoding="utf-8")
    page = verdict_page(rows, tmp_path / "tests/reference")
    (tmp_path / "docs" / "verdicts.md").write_text(page, encoding="utf-8")
    (tmp_path / "README.md").write_text("\n".join(count_table(rows)) + "\n", encoding="utf-8")
    assert list(pages(tmp_path, rows)) == []
    told = list(pages(tmp_path, [judged_row(verdict="refuted")]))
    assert [line.split(",")[0] for line in told] == ["docs/verdicts.md", "README.md"]
    table.write_text("x\n2\n", encoding="utf-8")
    (told,) = pages(tmp_path, rows)
    assert told.startswith("docs/verdicts.md, line 4 is 'Judged from `tests/reference/`")


def test_claim_whose_rule_is_not_published_says_so():
    new = replace(CLAIM, id="new", rule="new_limit")
    told = list(claims([new], {}, [], ROOT))
    assert told[1:] == ["claim new: the findings of its rule new_limit are not published yet"]
