"""The folder of a run: a path that Snakemake can start jobs from, and that can be written to."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from replication.workflow.place import check_place

ROOT = Path(__file__).parents[3]


@pytest.mark.parametrize("character", [" ", "'", '"', "$", "&", ";", "(", "{", "\\", ":"])
def test_path_that_a_shell_would_not_read_as_one_word_is_refused(character):
    python = f"/home/me/a{character}b/.venv/bin/python"
    with pytest.raises(ValueError, match="without quoting that path: move the folder") as told:
        check_place(python)
    assert repr(character) in str(told.value)
    assert python in str(told.value)


def test_folder_that_cannot_be_written_to_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(os, "access", lambda path, mode: (str(path), mode) != (tmp, os.W_OK))
    tmp = str(tmp_path)
    with pytest.raises(ValueError, match=f"{tmp} cannot be written to; expected"):
        check_place("/usr/bin/python", tmp)


def test_make_and_snakemake_refuse_such_a_folder_at_once(tmp_path):
    place = tmp_path / "it's mine"
    place.mkdir()
    for name in ("Makefile", "Snakefile", "src"):
        (place / name).symlink_to(ROOT / name)
    (place / "python").symlink_to(sys.executable)
    made = subprocess.run(["make", "reproduce"], cwd=place, capture_output=True, text=True)
    assert made.returncode == 2
    assert f"the path {place} has a space or one of" in made.stderr
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    command = [str(place / "python"), "-m", "snakemake", "--cores", "1"]
    ran = subprocess.run(command, cwd=place, capture_output=True, text=True, env=environment)
    assert ran.returncode == 1
    assert f"the path of Python, {place}/python, has the character" in ran.stderr
