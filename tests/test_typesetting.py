"""Documents from the published tables: every number has a source, every sentence a meaning."""

import json
import math
import re
import shutil
from copy import deepcopy
from functools import cache

import pandas as pd
import pytest

from documents import check
from documents.stated import unsaid
from documents.typeset import checked, texts_of
from tests.cases import CONFIG, ROOT, published

DOCUMENTS = {name: f"paper/{name}.typ" for name in ("report", "supplement")}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Return a folder with the texts, and results as the published tables give them."""
    folder = tmp_path_factory.mktemp("documents")
    shutil.copytree(ROOT / "paper", folder / "paper")
    shutil.copy(ROOT / "CITATION.cff", folder)
    shutil.copytree(check.REFERENCE, folder / "results/tables")
    (folder / "results/findings").mkdir()
    for rule, content in published().items():
        (folder / f"results/findings/{rule}.json").write_text(json.dumps(content))
    (folder / "results/claims.json").write_text(json.dumps(check.published(published())))
    return folder


def typeset(folder, document, config=CONFIG):
    captions = str(ROOT / "figures/captions.yaml")
    texts = texts_of(config, captions)
    return checked(DOCUMENTS[document], texts, str(folder))


@cache
def page_of_report(folder):
    return typeset(folder, "report").html


def without(table, column, value):
    """Return a change of the published tables or findings: a table without some rows."""

    def change(folder):
        path = folder / f"results/tables/{table}.csv"
        rows = pd.read_csv(path)
        rows[rows[column] != value].to_csv(path, index=False)

    return change


def without_finding(rule, name):
    def change(folder):
        path = folder / f"results/findings/{rule}.json"
        content = json.loads(path.read_text("utf-8"))
        del content[name]
        path.write_text(json.dumps(content))

    return change


MEANINGLESS = {  # what the key is changed to, and what follows in results/
    "motions.mass_ratios": ("report", [0.5, 2.0], without("motions_gains", "mass_ratio", 1.0)),
    "vase.mass_ratios": ("report", [0.0], without_finding("vase", "minimum_at_mass_ratio_one")),
    "records.capacity.mass_ratios": ("report", [0.0], without_finding("records", "gain_1")),
    "guarantee.mass_ratios": ("report", [0.0, 1.0], without("guarantee", "mass_ratio", math.inf)),
    "spectra.slendernesses": ("report", [5.0], None),
    "motions.scenarios": ("report", CONFIG["motions"]["scenarios"] * 2, None),
    "gaps.checks": ("supplement", [{"friction": 5.0}], None),
    "colonnades.checks": ("supplement", [{"friction": 0.7}], None),
    "engine.across.checks": ("supplement", [{"time_step": 8e-4}], None),
}


def test_a_number_that_is_typed_into_a_sentence_is_named_with_it(folder, tmp_path):
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    path = tmp_path / DOCUMENTS["report"]
    text = path.read_text("utf-8")
    path.write_text(text.replace("\n= Limits", "\nIt takes 12.3~s. Then it stops.\n\n= Limits"))
    with pytest.raises(SystemExit, match=r"12\.3 in: It takes 12\.3 s\.$"):
        typeset(tmp_path, "report")


def test_bounds_are_rounded_outward(folder, tmp_path):
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    path = tmp_path / DOCUMENTS["report"]
    share = 'percent(part(spectra.collapse_slow, "covered"), bound: '  # 2.13 %
    words = f'\nAt most #{share}"upper"), at least #{share}"lower").\n\n= Limits'
    path.write_text(path.read_text("utf-8").replace("\n= Limits", words))
    html = re.sub("<[^>]*>", "", typeset(tmp_path, "report").html)
    assert "At most 3\xa0%, at least 2\xa0%." in html


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("raises the median", "lowers the median", "as both columns raises the"),
        ("it was shaken below", "it was shaken beyond", "it was shaken below uplift"),
        ("No tested", "7 tested", ": 7 of the abstract"),
        ("Until the first", "Until the last", "'Until the first impact"),
    ],
)
def test_abstract_says_what_the_audit_computes(folder, old, new, named):
    html, claims = page_of_report(folder), check.published(published())
    assert not [*unsaid(html, claims)]
    assert old in html
    assert any(named in line for line in unsaid(html.replace(old, new), claims))


@pytest.mark.sampled(3)
@pytest.mark.parametrize("key", MEANINGLESS)
def test_a_sentence_without_a_meaning_stops_its_document_alone(key, folder, tmp_path):
    document, value, change = MEANINGLESS[key]
    shutil.copytree(folder, tmp_path, dirs_exist_ok=True)
    if change:
        change(tmp_path)
    config = deepcopy(CONFIG)
    *sections, name = key.split(".")
    section = config
    for key_of_section in sections:
        section = section[key_of_section]
    section[name] = value
    with pytest.raises(SystemExit) as stopped:
        typeset(tmp_path, document, config)
    assert key in str(stopped.value)
    assert "\n" not in str(stopped.value)
