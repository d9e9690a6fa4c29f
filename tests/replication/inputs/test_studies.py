"""Follow-up studies: how one is begun, read, and judged with the paper's claims."""

import shutil
import subprocess
import sys
from functools import partial
from pathlib import Path
from string import ascii_lowercase

import pytest
import yaml

from replication.commands.new_paper import TEMPLATE
from replication.commands.new_study import LONGEST, create
from replication.inputs.study_config import check_needs, read_study_config
from replication.judging.claim import Claim
from replication.judging.ledger import read_ledger
from replication.judging.ledger_check import check_ledger
from steps.inputs import RECORDS, check_inputs

ROOT = Path(__file__).resolve().parents[3]
CHECK = partial(check_inputs, structures={"temple": {"half_width": 0.5, "half_height": 3.0}})


@pytest.fixture
def project(tmp_path):
    """The config and the skeleton, in a folder of their own."""
    (tmp_path / "config").mkdir()
    shutil.copy(ROOT / "config" / "config.yaml", tmp_path / "config")
    shutil.copy(ROOT / ".gitignore", tmp_path)
    shutil.copytree(ROOT / "studies" / "skeleton", tmp_path / "studies" / "skeleton")
    for name in ("src", "figures", "notebooks", "paper"):
        (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


def registered(project):
    return yaml.safe_load((project / "config" / "config.yaml").read_text("utf-8"))["studies"]


@pytest.mark.parametrize("name", ["bridges", "bent_2b"])
def test_new_study_is_registered_and_sound(project, name):
    before = registered(project)
    folder = create(name, project)
    assert registered(project) == [*before, name]
    assert read_study_config(name, CHECK, str(folder.parent))["gain"]
    ledger = folder / "claims.yaml"
    check_ledger([str(ledger)], [f"{name}_gain"], project)
    text = ledger.read_text("utf-8")
    own = text.replace("topheavy.lowest_overturning", f"studies.{name}.steps.gain.lowest")
    assert own != text
    ledger.write_text(own, "utf-8")
    check_ledger([str(ledger)], [f"{name}_gain"], project)
    left = [path for path in folder.rglob("*") if path.is_file() and "skeleton" in path.read_text()]
    assert left == []


def test_second_study_joins_the_first(project):
    create("bridges", project)
    create("vases", project)
    assert registered(project)[-2:] == ["bridges", "vases"]


@pytest.mark.parametrize(
    "name", ["", "My study", "1st", "_x", "skeleton", "a/b", "a" * (LONGEST + 1), 300 * "a", "ü"]
)
def test_name_that_cannot_be_one_changes_nothing(project, name):
    before = (project / "config" / "config.yaml").read_text("utf-8")
    with pytest.raises(ValueError, match="expected"):
        create(name, project)
    assert (project / "config" / "config.yaml").read_text("utf-8") == before


@pytest.mark.parametrize(
    ("name", "taken"),
    [
        ("heavier", "heavier"),  # a rule
        ("trilith_n", "trilith_nearness"),  # a table
        ("free", "free_body"),  # a figure
        ("play", "play"),  # a notebook
        ("report", "report"),  # a document
        ("s", "scale_effects"),  # would take the results of others with it when it is removed
        ("skel", "skeleton_gain"),
        ("skeleton_two", "skeleton"),  # would go with the results of skeleton
    ],
)
def test_name_that_is_like_one_of_the_paper_or_of_a_study_is_refused(project, name, taken):
    with pytest.raises(ValueError, match=f"NAME is '{name}', which is too like '{taken}'"):
        create(name, project)
    assert not (project / "studies" / name).exists()


@pytest.mark.parametrize(
    ("name", "meaning"),
    [
        ("true", "which YAML reads as True"),
        ("no", "which YAML reads as False"),
        ("null", "which YAML reads as None"),
        ("lambda", "a keyword of Python"),
        ("for", "a keyword of Python"),
        ("paper", "count claims that belong to no study"),
        ("ours", "count claims that belong to no study"),
        ("results", "folders that .gitignore keeps out"),
        ("lintel", r"a word that paper/words.yaml asks to avoid \(cap beam\)"),
    ],
)
def test_name_that_means_something_else_is_refused_with_the_reason(project, name, meaning):
    before = registered(project)
    says = f"^NAME is '{name}', .*{meaning}.*; expected another name, for example 'my_{name}'$"
    with pytest.raises(ValueError, match=says):
        create(name, project)
    assert registered(project) == before
    assert not (project / "studies" / name).exists()
    create(f"my_{name}", project)


@pytest.mark.parametrize("origin", [ROOT, TEMPLATE], ids=["here", "another_paper"])
def test_made_study_has_the_style_that_lint_demands_for_every_length_of_its_name(tmp_path, origin):
    for name in ("config", "studies/skeleton"):
        shutil.copytree(origin / name, tmp_path / name)
    shutil.copy(ROOT / ".gitignore", tmp_path)
    folders = [
        create(letter + "o" * length, tmp_path)
        for length, letter in enumerate(ascii_lowercase[:LONGEST])
    ]
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    (tmp_path / "src").mkdir()  # by which ruff knows what is imported from here
    for path in [*ROOT.glob("src/[a-z]*"), TEMPLATE / "src" / "theory"]:
        (tmp_path / "src" / path.name).symlink_to(path)
    (tmp_path / "figures").symlink_to(ROOT / "figures")
    rules = [str(folder / "study.smk") for folder in folders]
    for command in (
        ["ruff", "check", "--no-cache", "studies"],
        ["ruff", "format", "--no-cache", "--check", "studies"],
        ["snakefmt", "--check", "--compact-diff", *rules],
    ):
        done = subprocess.run(
            [sys.executable, "-m", *command], cwd=tmp_path, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stdout + done.stderr


def test_file_of_the_same_name_as_one_over_the_papers_goes_over_a_study_s(project):
    over = project / "studies" / "skeleton" / "quick.yaml"
    plain = read_study_config("skeleton", CHECK, str(project / "studies"))
    over.write_text("gain: { amplitudes: { floor: 0.5 } }\n", encoding="utf-8")
    found = read_study_config("skeleton", CHECK, str(project / "studies"), over=["quick.yaml"])
    assert found["gain"]["amplitudes"] == plain["gain"]["amplitudes"] | {"floor": 0.5}
    assert read_study_config("skeleton", CHECK, str(project / "studies")) == plain
    assert read_study_config("skeleton", CHECK, str(project / "studies"), over=["x.yaml"]) == plain
    over.write_text("gain: { amplitude: 1.0 }\n", encoding="utf-8")
    with pytest.raises(ValueError, match=r"quick.yaml over .*config.yaml: .*unknown key 'ampl"):
        read_study_config("skeleton", CHECK, str(project / "studies"), over=["quick.yaml"])


@pytest.mark.parametrize("name", sorted(p.parent.name for p in ROOT.glob("studies/*/quick.yaml")))
def test_quick_config_of_a_study_is_sound_and_names_no_new_key(name):
    config = yaml.safe_load((ROOT / "config" / "config.yaml").read_text("utf-8"))
    check = partial(check_inputs, structures=config["structures"], records=str(ROOT / RECORDS))
    plain, quick = (
        read_study_config(name, check, str(ROOT / "studies"), over=over)
        for over in ([], ["quick.yaml"])
    )
    assert quick != plain
    assert set(quick) == set(plain)


def test_study_that_is_not_there_is_named(project):
    with pytest.raises(ValueError, match=r"studies has 'vases'.*expected some of skeleton"):
        read_study_config("vases", CHECK, str(project / "studies"))


def test_fault_in_a_study_config_names_its_file(project):
    path = project / "studies" / "skeleton" / "config.yaml"
    path.write_text(path.read_text("utf-8").replace("temple", "tempel"), "utf-8")
    with pytest.raises(ValueError, match=r"skeleton/config.yaml: gain.structure is 'tempel'"):
        read_study_config("skeleton", CHECK, str(project / "studies"))


def ledgers(tmp_path, paper, study):
    """A ledger of the paper and one of a study."""
    paths = [tmp_path / "paper" / "claims.yaml", tmp_path / "studies" / "vases" / "claims.yaml"]
    for path, rows in zip(paths, (paper, study), strict=True):
        path.parent.mkdir(parents=True)
        path.write_text(yaml.safe_dump(rows), encoding="utf-8")
    return paths


ROW = {"id": "stable", "where": "p. 1", "statement": "It survives.", "expected": "confirmed"}


def test_claims_of_a_study_come_after_those_of_the_paper(tmp_path):
    rows = read_ledger(ledgers(tmp_path, [ROW], [ROW | {"id": "other"}]))
    assert [(row.id, row.study) for row in rows] == [("stable", ""), ("other", "vases")]


def test_study_may_judge_a_claim_of_the_paper_anew(tmp_path):
    known = ROW | {"rule": "old", "finding": "so", "function": "f", "remark": "Why."}
    anew = {"id": "stable", "rule": "new", "finding": "so", "function": "f", "expected": "refuted"}
    paths = ledgers(tmp_path, [known], [anew])
    (row,) = read_ledger(paths)
    assert row == Claim.of(ROW | anew, paths[1])


def test_study_may_not_reword_a_claim_of_the_paper(tmp_path):
    with pytest.raises(ValueError, match=r"stable is a claim of the paper.*not statement"):
        read_ledger(ledgers(tmp_path, [ROW], [{"id": "stable", "statement": "It falls."}]))


def test_id_twice_in_one_ledger_is_refused(tmp_path):
    with pytest.raises(ValueError, match="'stable' is given twice"):
        read_ledger(ledgers(tmp_path, [ROW, ROW], [])[:1])


def test_study_follows_those_that_it_needs():
    check_needs({"first": {}, "second": {"needs": ["first"]}, "third": {}})
    check_needs({"first": {}, "third": {}})


@pytest.mark.parametrize("listed", [["second"], ["second", "first"], ["third", "second"]])
def test_study_without_one_that_it_needs_says_which_is_missing(listed):
    configs = {"first": {}, "second": {"needs": ["first", "third"]}, "third": {}}
    lacks = [name for name in ("first", "third") if name not in listed[: listed.index("second")]]
    said = rf"second/config.yaml: needs has {', '.join(lacks)}, .*expected first, third in studies"
    with pytest.raises(ValueError, match=said):
        check_needs({name: configs[name] for name in listed})
