"""`make study` copies studies/bent, and the copy runs, here in the environment of the tests."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from replication.config import read_yaml
from steps.shared import sweep
from tests.cases import ROOT
from topheavy import STANDARD_GRAVITY

# In place of uv, which would download: an empty wheel, and no new lock.
UV = """#!/bin/sh
if [ "$1" = build ]; then mkdir "$6" && touch "$6/topheavy-0-py3-none-any.whl"; fi
"""

# The tests of the copy, twice in one process: the second time with a wrong number in the text.
TESTS = """
import pathlib, pytest
assert pytest.main([]) == 0
path = pathlib.Path("results/numbers.json")
path.write_text(path.read_text().replace('"frame": [3.', '"frame": [2.'))
assert pytest.main([]) == 1
"""


def run(folder, *command):
    """Run a command with the Python of the tests as `python`."""
    env = os.environ | {"PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    env |= {"PYTHONPATH": str(ROOT / "src"), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True, timeout=300)
    return done.returncode, done.stdout + done.stderr


def make_study(path, name, uv="/bin/true"):
    return run(ROOT, "make", "study", f"DIR={path}", f"NAME={name}", f"UV={uv}")


def snakemake(folder, *words):
    return run(folder, "python", "-m", "snakemake", "--cores", "1", *words)


@pytest.fixture(scope="module")
def bridge(tmp_path_factory):
    """A copy, with its results, in a folder whose name has a space."""
    parent, uv = tmp_path_factory.mktemp("a study"), tmp_path_factory.mktemp("bin") / "uv"
    uv.write_text(UV)
    uv.chmod(0o755)
    code, output = make_study(parent / "bridge", "bridge", uv)
    assert code == 0, output
    assert "Next: cd" in output
    code, output = snakemake(parent / "bridge")
    assert code == 0, output
    return parent / "bridge"


def test_an_old_result_answers_neither_for_another_record_nor_after_an_error(bridge, tmp_path):
    copy = tmp_path / "copy"
    shutil.copytree(bridge, copy)
    assert "Nothing to be done" in snakemake(copy)[1]
    config = copy / "config.yaml"
    text = config.read_text("utf-8")
    os.utime(config, (0, 0))
    assert "Nothing to be done" in snakemake(copy, "--dry-run")[1]
    config.write_text(text.replace("scale: 1.3", "scale: 1.4"), "utf-8")
    os.utime(config, (0, 0))
    assert "triggered jobs" in snakemake(copy, "--dry-run")[1]
    config.write_text(text.replace("width:", "wide:"), "utf-8")
    for _ in range(2):  # the second time, the picture is gone and the old report is there
        code, output = snakemake(copy)
        assert code == 1
        # Python 3.13 adds a suggestion.
        end = r"unexpected keyword argument 'wide'(\. Did you mean 'width'\?)?$"
        assert re.search(f"^config.yaml: column: .*{end}", output, re.M)
    config.write_text(text.replace("levels:", "level:"), "utf-8")
    code, output = snakemake(copy)
    assert code == 1
    assert re.search("^config.yaml: .*'level.*missing or unknown; expected", output, re.M)
    config.write_text(text.replace("path:", "pth:"), "utf-8")
    code, output = snakemake(copy)
    assert code == 1
    assert "El Centro 1940 (NS): path is not there: put it there, or mend config.yaml" in output
    config.write_text(text, "utf-8")
    (copy / "records/el_centro_1940_NS.AT2").rename(copy / "another.AT2")
    code, output = snakemake(copy)
    assert code == 1
    assert "records/el_centro_1940_NS.AT2 is not there: put it there, or mend config" in output


def test_the_tests_of_the_copy_pass_and_a_wrong_number_fails_one(bridge):
    assert (bridge / "results/report.pdf").is_file()
    for name in ("pyproject.toml", "README.md", "CITATION.cff", "report.typ"):
        text = (bridge / name).read_text("utf-8")
        assert "bridge" in text
        assert "bent" not in text
        assert "../.." not in text
    code, output = run(bridge, "python", "-c", TESTS)
    assert code == 0, output
    assert output.count("FAILED") == 1
    assert "FAILED tests/test_bridge.py::test_the_text_quotes_the_numbers_of_the_config" in output


@pytest.mark.parametrize(
    ("path", "name"),
    [("new", "results"), ("new", "dist"), ("new", "2nd"), ("", "bridge"), (".", "bridge")],
)
def test_a_bad_name_or_folder_is_refused(tmp_path, path, name):
    code, output = make_study(tmp_path / path if path else "", name)
    assert code != 0
    assert "expected" in output
    assert not [*tmp_path.iterdir()]


def test_the_study_of_tests_quotes_gains_and_lengths_of_the_article():
    config = read_yaml(ROOT / "studies/shake_table/config.yaml")
    gains = pd.read_csv(ROOT / "tests/reference/motions_gains.csv")
    gains = gains[(gains.structure == "trilith") & (gains.mass_ratio == config["mass_ratio"])]
    percent = 100 * gains.gain[~gains.model.str.startswith("noise")]
    assert config["synthetic"]["gain"] == f"{percent.min():.0f} to {percent.max():.0f}"
    settings, lengths = read_yaml(ROOT / "config/config.yaml")["motions"], []
    for name in sweep.sets(settings):  # of a few motions, since the text says whole hundredths
        records = [motion.record() for motion in sweep.models(settings)[name][:12]]
        length = np.median([record.peak_velocity / record.peak_acceleration for record in records])
        lengths.append(length / STANDARD_GRAVITY)
    quoted = [float(number) for number in config["synthetic"]["length"].split(" to ")]
    assert quoted == pytest.approx([min(lengths), max(lengths)], rel=0.15)
