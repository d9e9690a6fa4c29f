"""src/audit.py: alone, it confirms what is published; a changed number or sign it names."""

import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import audit as solver

ROOT = Path(__file__).resolve().parents[1]
AUDIT = ROOT / "src" / "audit.py"
CHEAP = (
    "trust",
    "parameters",
    "trilith",
    "guarantee",
    "gains",
)  # `make audit` has all, beside lint


def audit(folder, *parts, file=AUDIT):
    command = [sys.executable, "-I", str(file), str(folder), *parts]
    return subprocess.run(command, capture_output=True, text=True, encoding="utf-8", timeout=300)


@pytest.fixture
def folder(tmp_path):
    """A folder with what the audit reads, and not one module of the project."""
    shutil.copy(ROOT / "README.md", tmp_path)
    for inside in ("tests/reference", "data/records"):
        shutil.copytree(ROOT / inside, tmp_path / inside)
    shutil.copy(AUDIT, tmp_path)
    return tmp_path


def replaced(path, old, new):
    text = path.read_text(encoding="utf-8")
    assert text.count(old) == 1, old
    path.write_text(text.replace(old, new), encoding="utf-8")


def test_what_is_published_is_confirmed(folder):
    done = audit(folder, *CHEAP, file=folder / "audit.py")
    assert done.returncode == 0, done.stdout + done.stderr


NUMBERS = [  # file, text, what it becomes, and what the audit says then
    ("README.md", "R̂ is at most [1.5]", "R̂ is at most [1.6]", "README: size"),
    ("tests/reference/trilith_numbers.csv", "3.79363632", "3.83157", "frame_freq"),
    ("tests/reference/mass_ratio.csv", "\n1,0.866025404", "\n1,0.8747", "(23)"),
    ("README.md", "was shaken below", "was shaken above", "shaken below"),
    ("README.md", "the inertia by 1 + 3γ", "the inertia by 1 + 2γ", "1 \\+ 3γ"),
    ("README.md", "raises the peak ground velocity", "raises the PGA", "velocity at"),
    ("README.md", "| The trilith of", "| 37 % of the trilith of", "37 is not known here"),
]


def test_changed_numbers_are_named(folder):
    for path, old, new, _ in NUMBERS:
        replaced(folder / path, old, new)
    done = audit(folder, "parameters", "trilith", "gains", "trust")
    assert done.returncode == 1
    departures = done.stdout.rpartition(" depart\n")[2]
    assert [words for *_, words in NUMBERS if words not in departures] == [], departures


@pytest.mark.parametrize(
    ("old", "new", "part", "named"),
    [
        ("(1 + 2 * gamma) / (1 +", "(1 - 2 * gamma) / (1 +", "parameters", "Eq. (23)"),
        (
            "return -drive.ground.weight(x) * lean",
            "return drive.ground.weight(x) * lean",
            "trust",
            "cl",
        ),
        ("np.sin(lean) - a * np.cos", "np.sin(lean) + a * np.cos", "histories", "exact"),
        ("root + 3 * gamma", "root - 3 * gamma", "guarantee", "temple: V_1 to V_5, V*"),
        (" = 0, lanes[ROOT] * np", " = 0, -lanes[ROOT] * np", "guarantee", "worst motion"),
    ],
)
def test_a_turned_sign_is_named(folder, old, new, part, named):
    replaced(folder / "audit.py", old, new)
    done = audit(folder, part, file=folder / "audit.py")
    assert done.returncode == 1
    assert named in done.stderr + done.stdout.rpartition(" depart\n")[2]


@pytest.mark.parametrize(("start", "impacts"), [((0.0, 0.0), 6), ((0.3, -0.1), 0)])
def test_two_turns_within_a_step_are_seen(start, impacts):
    """A body turns twice between two samples of a record; samples of its motion shorten steps."""
    above, body = np.array([0.75, 0.0, 0.0]), solver.Body(1.0, 1.0, 1.0)
    ground = solver.record(np.array([3.11481545, 0.0, 3.11481545]), 0.25)
    ground = ground._replace(weight=lambda x: 1 + np.interp(x, ground.corners, above))
    coarse, fine = (
        solver.follow([body], -1.0, ground, start=start, samples=np.linspace(0.0, 0.5, count))
        for count in (3, 99)
    )
    assert coarse.hits == fine.hits == impacts
    assert coarse.peak == pytest.approx(fine.peak, rel=1e-6)
    assert coarse.rotation[0, -1] == pytest.approx(fine.rotation[0, -1], abs=1e-8)


def test_each_sentence_of_the_abstract_is_computed():
    source = AUDIT.read_text(encoding="utf-8")
    assert all(f'compare_abstract("{name}"' in source for name in solver.ABSTRACT)
