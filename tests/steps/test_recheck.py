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
STUDIES = read_yaml(ROOT / "config" / "config.yaml")["studies"]
CLAIM = Claim(
    id="size",
    where="p. 4",
    statement="It is so.",
    function="topheavy.Column",
    printed=0.415,
    tolerance=5e-4,
    expected="confirmed",
    rule="trilith",
    finding="size",
)
FINDINGS = {
    "trilith": Findings({"size": value(0.4148, 1e-16)}, ("topheavy.bodies.structures.Column",))
}
PUBLISHED = findings_by_rule((REFERENCE / "findings").glob("*.json"))
AGAIN = {}
"""What each rule draws from its tables, by the times of these."""


@pytest.fixture(autouse=True)
def _drawn_once(monkeypatch):
    """Draw the findings of a rule again when one of its tables was written again, and only then."""

    def once(rule, folder):
        names = inspect.signature(redrawn.step(rule).findings).parameters
        parts = (".", "sources", "studies")
        places = [folder / part / f"{name}.csv" for name in names for part in parts]
        key = rule, *((path, path.stat().st_mtime_ns) for path in places if path.is_file())
        if key not in AGAIN:
            AGAIN[key] = [*entries(rule, folder)]
        return AGAIN[key]

    monkeypatch.setattr(redrawn, "entries", once)


@pytest.fixture(scope="module")
def edition(tmp_path_factory):
    """A copy of what is published, and of what it is checked by."""
    root = tmp_path_factory.mktemp("edition") / "tree"
    skipped = shutil.ignore_patterns("__pycache__", "*.yaml", "*.typ", "tests", "figures")
    for name in ("src/topheavy", "studies"):
        shutil.copytree(ROOT / name, root / name, ignore=skipped)
    shutil.copytree(REFERENCE, root / "tests" / "reference")
    wanted = ["README.md", "config/config.yaml", "paper/claims.yaml", "CITATION.cff"]
    pages = ("verdicts.md", "verify_grid.csv", "costs.csv", "findings.md", "exhibits.md")
    wanted += ["codecheck.yml", *(f"docs/{name}" for name in pages)]
    wanted += [f"studies/{study}/{n}.yaml" for study in STUDIES for n in ("claims", "config")]
    for name in wanted:
        (root / name).parent.mkdir(parents=True, exist_ok=True)
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
        new = edit(text) if callable(edit) else text.replace(*edit, 1)
        assert new != text
        path.write_text(new, encoding="utf-8")
        seal(edition)
        return [fault for fault in check(edition)[1] if fault not in faults_before]

    yield change
    for path, content in kept.items():
        path.write_bytes(content)


def test_published_edition_agrees_with_itself():
    lines, faults = main(ROOT)
    said = [line.split(":")[0] for line in lines if not line.startswith("the edition is older")]
    assert (faults, said) == ([], ["paper", "ours", "reproduced", *STUDIES])


MISSING = "does not exist; expected a file of the published run, or no check of it in "
MISSING += "src/steps/recheck.py"


def test_edition_without_what_a_check_reads_says_so(edition):
    path = edition / "tests/reference/claims.json"
    kept = path.read_text(encoding="utf-8")
    try:
        path.unlink()
        assert main(edition) == ([], [f"{path} {MISSING}"])
        path.write_text(kept.replace('"condition": ', '"terms": ', 1), encoding="utf-8")
        lines, faults = main(edition)
    finally:
        path.write_text(kept, encoding="utf-8")
    assert lines == []
    assert ["'terms'" in fault for fault in faults] == [True]
    gone = edition / "tests/reference/gone.csv"
    _, faults = check_edition(lambda *_: [gone.read_text()], edition)
    assert faults == [f"{gone} {MISSING}"]


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("paper/claims.yaml", "statement:", "statemend:"),
        ("paper/claims.yaml", "- id: eq1\n", "- : [\n"),
        ("tests/reference/findings/vase.json", "{", "["),
        ("tests/reference/findings/vase.json", '"holds"', '"hold'),
        ("tests/reference/vase.csv", "mass_ratio", "ratio"),
        ("tests/reference/config.yaml", "vase:", "vases:"),
        ("config/config.yaml", "studies:", "study:"),
    ],
)
def test_broken_file_is_told_in_a_line(tampered, name, old, new):
    faults = tampered(name, (old, new))
    assert faults
    assert not any("Traceback" in fault for fault in faults)


@pytest.mark.parametrize(("older", "told"), [(2, "2 inputs and"), (0, "the published")])
def test_last_line_says_how_many_inputs_and_texts_are_newer_than_the_edition(capsys, older, told):
    with pytest.raises(SystemExit) as ended:
        close(["paper: 3", *["the edition is older than a, which changed"] * older], [])
    assert ended.value.code == 0
    assert capsys.readouterr().out.splitlines()[-1].startswith(told)


# Claims ------------------------------------------------------------------------------------------


def judged_row(**changes):
    return replace(with_verdict(CLAIM, FINDINGS, ROOT), **changes)


NOT_TESTED = {"trilith": Findings({"size": Finding.of({"not_tested": "no engine"})})}
TRUE = {"trilith": replace(FINDINGS["trilith"], by_name={"size": truth(True)})}
NO_NUMBER = replace(CLAIM, printed=None, tolerance=None)


@pytest.mark.parametrize(
    ("claim", "findings", "rows", "told"),
    [
        (CLAIM, FINDINGS, [judged_row()], []),
        (CLAIM, FINDINGS, [judged_row(computed=0.42)], ["claim size: computed is 0.42"]),
        (CLAIM, FINDINGS, [judged_row(computed=True)], ["claim size: computed is True"]),
        (CLAIM, FINDINGS, [judged_row(verdict="refuted")], ["claim size: verdict is 'refuted'"]),
        (CLAIM, FINDINGS, [judged_row(id="other")], ["claim other is not", "claim size is not"]),
        (CLAIM, FINDINGS, [judged_row()] * 2, ["claim size is 2 times in tests/reference/cl"]),
        (CLAIM, FINDINGS, [judged_row(), judged_row(id="more")], ["claim more is not in both the"]),
        (
            *(CLAIM, NOT_TESTED, [with_verdict(CLAIM, NOT_TESTED, ROOT)]),
            ["claim size is not tested; expected confirmed"],
        ),
        (
            *(NO_NUMBER, TRUE, [replace(with_verdict(NO_NUMBER, TRUE, ROOT), computed=1)]),
            ["claim size: computed is 1"],
        ),
        (
            *(replace(CLAIM, id="new", rule="new_limit"), {}, []),
            ["claim new is not", "claim new: the findings of its rule new_limit are not published"],
        ),
    ],
)
def test_row_that_its_finding_does_not_bear_is_named(claim, findings, rows, told):
    found = sorted(claims([claim], findings, rows, ROOT))
    assert len(found) >= len(told)
    assert all(any(one.startswith(words) for one in found) for words in told)
    assert told or not found


@pytest.mark.parametrize(
    ("name", "field", "new"),
    [
        ("same_equation_of_motion", "computed", False),
        *(
            ("trilith_size", field, new)
            for field, new in {
                "computed": 0.4147,
                "error": 0.0,
                "printed": 0.416,
                "tolerance": 1.0,
                "verdict": "refuted",
                "expected": "refuted",
                "statement": "It is larger.",
                "rule": "heavier",
                "unit": "km",
            }.items()
        ),
    ],
)
def test_every_field_of_a_published_row_is_made_anew(name, field, new):
    claim, row = (
        next(row for row in rows if row.id == name)
        for rows in (read_ledger([ROOT / "paper/claims.yaml"]), read_judged(ROOT / CLAIMS))
    )
    (fault,) = claims([claim], PUBLISHED, [replace(row, **{field: new})], ROOT)
    assert fault.startswith(f"claim {name}: {field} is {new!r} in tests/reference/")


def test_every_truth_that_is_flipped_is_noticed():
    rows = read_judged(ROOT / CLAIMS)
    ledgers = ["paper/claims.yaml", *(f"studies/{study}/claims.yaml" for study in STUDIES)]
    flipped = {r.id for r in rows if isinstance(r.computed, bool)}
    changed = [replace(r, computed=not r.computed) if r.id in flipped else r for r in rows]
    ledger = read_ledger([ROOT / path for path in ledgers])
    told = "\n".join(claims(ledger, PUBLISHED, changed, ROOT))
    assert len(flipped) > 50
    assert {*re.findall(r"^claim (\w+): computed is ", told, re.MULTILINE)} == flipped


# What is tampered with ---------------------------------------------------------------------------


def entry(finding, key, new):
    """Change an entry of the findings of a rule; of all, what a function is called by."""

    def edit(text):
        found = json.loads(text)
        if finding == "called":
            found["called"] = [name for name in found["called"] if key not in name]
        else:
            found[finding][key] = new
        return json.dumps(found)

    return edit


def third_and_fourth(text):
    lines = text.splitlines(keepends=True)
    return "".join([*lines[:2], lines[3], lines[2], *lines[4:]])


FOUND, PAGE = "tests/reference/findings", "docs/verdicts.md"
RATIO = ("mass_ratio: 0.434", "mass_ratio: 0.5")
WIDE = "printed: 0.415\n  unit: m\n  tolerance: 0.00"
TAMPERED = [  # file, edit, how one of the faults begins
    (f"{FOUND}/trilith.json", entry("size", "value", 0.5), "claim trilith_size: computed is"),
    (f"{FOUND}/trilith.json", entry("size", "error", 1e-3), "claim trilith_size: the error is 0.0"),
    (f"{FOUND}/equations.json", entry("eq1", "holds", False), "claim eq1 is refuted; expected co"),
    (f"{FOUND}/equations.json", entry("eq1", "holds", False), "findings/equations.json: eq1.holds"),
    (
        *(f"{FOUND}/mass_ratio.json", entry("called", "size_ratio", None)),
        "claim equivalent_column_is_larger: its rule mass_ratio never called",
    ),
    (
        *("tests/reference/heavier.csv", third_and_fourth),
        "findings/heavier.json: heavier_survives_more.holds is True, and False",
    ),
    ("README.md", ("0.273 g", "0.373 g"), "README.md: "),
    ("config/config.yaml", RATIO, "config/config.yaml: "),
    ("tests/reference/config.yaml", RATIO, "config/config"),
    (
        "tests/reference/config.yaml",
        ("\nsolver:", "\ngone: 1\nsolver:"),
        "config/config.yaml: gone",
    ),
    *(
        (
            f"studies/{name}/config.yaml",
            lambda text: f"{text}\nmore: 1\n",
            f"studies/{name}/config.y",
        )
        for name in sorted(path.stem for path in REFERENCE.glob("studies/*.yaml"))
    ),
    ("paper/claims.yaml", (WIDE + "05", WIDE + "5"), "claim trilith_size: tolerance 0.005 would"),
    ("paper/claims.yaml", ("printed: 0.415", "printed: 0.425"), "claim trilith_size"),
    *((PAGE, lambda text, more=more: text + more, PAGE) for more in ("\n", "| `more` | | | |\n")),
]


@pytest.mark.parametrize(("name", "edit", "told"), TAMPERED)
def test_what_is_tampered_with_is_named(tampered, name, edit, told):
    assert any(fault.startswith(told) for fault in tampered(name, edit))


@pytest.mark.parametrize(
    ("page", "old", "new", "told"),
    [
        (PAGE, 'id="eq1"', 'id="eq_1"', f"{PAGE}, line "),
        (PAGE, "| confirmed |", "| refuted |", f"{PAGE}, line "),
        ("README.md", "| paper | ", "| paper | 1", "README.md, line "),
        ("README.md", "| study `mechanism` | ", "| study `mechanism` | 1", "README.md, line "),
        ("README.md", "| | confirmed |", "| | Confirmed |", "README.md: the page has 0 lines"),
    ],
)
def test_page_that_says_otherwise_is_named(tampered, page, old, new, told):
    def wrong(root):
        return [], list(pages(root, read_judged(root / CLAIMS)))

    (fault,) = tampered(page, (old, new), wrong)
    assert fault.startswith(told)


@pytest.mark.parametrize(
    ("table", "column"),
    [
        *(("mass_ratio", name) for name in ("frequency_ratio", "size_ratio")),
        *((f"restitution_over_{name}", "restitution") for name in ("slenderness", "mass_ratio")),
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


def test_pages_are_those_of_the_rows(tmp_path):
    rows, table = [judged_row()], tmp_path / "tests/reference/sources/t.csv"
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


# Findings and their tables -----------------------------------------------------------------------

DRAWN = [rule for rule in sorted(PUBLISHED) if undrawn(rule) is None]


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
    assert list(departures(REFERENCE, {rule: PUBLISHED[rule]})) == []
    drawn = {(name, key) for name, key, _ in redrawn.entries(rule, REFERENCE)}
    changed = {
        name: replace(
            one, entries={k: other(e) if (name, k) in drawn else e for k, e in one.entries.items()}
        )
        for name, one in PUBLISHED[rule].by_name.items()
    }
    faults = list(departures(REFERENCE, {rule: replace(PUBLISHED[rule], by_name=changed)}))
    assert len(faults) == len(drawn) > 0


def test_four_fifths_of_all_entries_are_drawn_again_and_the_others_said_not_to_be(jobs):
    made = {Path(path).stem: job for job in jobs for path in job.findings}
    drawn = sum(len(list(redrawn.entries(rule, REFERENCE))) for rule in DRAWN)
    every = [one for of in PUBLISHED.values() for one in of.by_name.values()]
    assert drawn >= 0.8 * sum(len(one.entries) for one in every)
    assert not [rule for rule in made if undrawn(rule) == ""]
    for rule, job in made.items():
        assert [Path(step(rule).__file__)] == [ROOT / script for script in job.scripts]
    assert len(scripts()) <= len(made)


def test_findings_that_cannot_be_drawn_are_named(tmp_path):
    table = (REFERENCE / "sources" / "statements.csv").read_text(encoding="utf-8")
    (tmp_path / "statements.csv").write_text(table.replace("largest", "lorgest"), encoding="utf-8")
    (fault,) = departures(tmp_path, {"statements": PUBLISHED["statements"]})
    assert fault.startswith("findings/statements.json cannot be drawn from statements (.csv): ")
    (fault,) = departures(REFERENCE, {"speed": Findings({})})
    assert fault.startswith("findings/speed.json: nothing draws these findings from a table")


@pytest.mark.parametrize(
    ("found", "expected", "is_same"),
    [
        *((1.0000001, 1.0, True), (1.00001, 1.0, False), (math.nan, 1.0, False)),
        *((True, True, True), (1, True, False), (True, 1, False), (None, 1.0, False)),
        *(([1.0], [1.0], True), ([1.0, 2.0], [1.0], False), ([1.0], [1.0, 2.0], False)),
        *(({"a": 1.0, "b": 2.0}, {"a": 1.0}, True), ({"b": 2.0}, {"a": 1.0}, False)),
    ],
)
def test_entry_is_the_tables_to_its_digits(found, expected, is_same):
    assert same(found, expected, DIGITS) is is_same
