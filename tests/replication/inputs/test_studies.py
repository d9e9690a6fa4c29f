"""Follow-up studies: how one is begun, read, and judged with the paper's claims."""

import shutil
from functools import partial
from pathlib import Path

import pytest
import yaml

from replication.commands.new_study import LONGEST, create
from replication.inputs.study_config import check_needs, read_study_config
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
    for name in ("Snakefile", "src", "figures", "notebooks", "paper"):
        (tmp_path / name).symlink_to(ROOT / name)
    return tmp_path


def registered(project):
    return yaml.safe_load((project / "config" / "config.yaml").read_text("utf-8"))["studies"]


def test_name_that_the_config_lists_already_is_not_written_twice(project):
    shutil.rmtree(create("vases", project))
    before = registered(project)
    with pytest.raises(ValueError, match=r"'vases', which the list studies in .* has already"):
        create("vases", project)
    assert registered(project) == before


@pytest.mark.parametrize("name", ["bridges", "bent_2b"])
def test_new_study_is_registered_and_sound(project, name):
    before = registered(project)
    create("vases", project)
    folder = create(name, project)
    assert registered(project) == [*before, "vases", name]
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


@pytest.mark.parametrize(
    ("name", "told"),
    [
        *((name, "expected") for name in ("", "My study", "1st", "_x", "skeleton", "a/b", "ü")),
        *((name, "expected") for name in ("a" * (LONGEST + 1), 300 * "a")),
        ("heavier", "which is too like 'heavier'"),  # a rule
        ("trilith_n", "which is too like 'trilith_nearness'"),  # a table
        ("free", "which is too like 'free_body'"),  # a figure
        ("play", "which is too like 'play'"),  # a notebook
        ("report", "which is too like 'report'"),  # a document
        # would take the results of others with it when it is removed
        ("s", "which is too like 'scale_effects'"),
        ("skel", "which is too like 'skeleton_gain'"),
        ("skeleton_two", "which is too like 'skeleton'"),  # would go with the results of skeleton
    ],
)
def test_name_that_cannot_be_one_or_is_like_another_changes_nothing(project, name, told):
    before, there = registered(project), sorted(project.glob("studies/*"))
    with pytest.raises(ValueError, match=f"NAME is '{name}'.*{told}"):
        create(name, project)
    assert (registered(project), sorted(project.glob("studies/*"))) == (before, there)


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


def test_study_that_is_not_there_is_named_and_so_is_the_file_of_a_fault(project):
    with pytest.raises(ValueError, match=r"studies has 'vases'.*expected some of skeleton"):
        read_study_config("vases", CHECK, str(project / "studies"))
    path = project / "studies" / "skeleton" / "config.yaml"
    path.write_text(path.read_text("utf-8").replace("temple", "tempel"), "utf-8")
    with pytest.raises(ValueError, match=r"skeleton/config.yaml: gain.structure is 'tempel'"):
        read_study_config("skeleton", CHECK, str(project / "studies"))


@pytest.mark.parametrize("listed", [["second"], ["second", "first"], ["third", "second"]])
def test_study_without_one_that_it_needs_says_which_is_missing(listed):
    configs = {"first": {}, "second": {"needs": ["first", "third"]}, "third": {}}
    lacks = [name for name in ("first", "third") if name not in listed[: listed.index("second")]]
    said = rf"second/config.yaml: needs has {', '.join(lacks)}, .*expected first, third in studies"
    with pytest.raises(ValueError, match=said):
        check_needs({name: configs[name] for name in listed})
