"""Every colour of a figure comes from the palette, so that it means one thing everywhere."""

import ast
import re
from itertools import pairwise
from pathlib import Path

import pytest
from matplotlib.colors import CSS4_COLORS, XKCD_COLORS, to_rgb

from figures import palette
from replication.drawing import PAPER, shades

ROOT = Path(__file__).parents[1]
SHARED = ROOT / "figures" / "palette.py"
SCRIPTS = sorted(
    [
        *(path for path in ROOT.glob("figures/*.py") if path != SHARED),
        *ROOT.glob("studies/*/figures/*.py"),
        ROOT / "src" / "steps" / "animation.py",
        ROOT / "benchmarks" / "picture.py",
    ]
)
HEX = re.compile(r"#[0-9a-fA-F]{3,8}")
NAMED = {name.removeprefix("xkcd:") for name in (*CSS4_COLORS, *XKCD_COLORS)}
SETS = re.compile(r"(\w*colors?|cmap)")
"""The keywords of Matplotlib that set a colour; `color` and `cmap` among them."""
MIXED = ("none", "face")
"""What may stand for a colour and is none."""


def own_colours(text: str) -> list[str]:
    """The colours that a script writes itself, each with its line."""
    found = []
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            if HEX.fullmatch(node.value) or node.value in NAMED:
                found.append((node.lineno, node.value))
        elif isinstance(node, ast.ImportFrom):
            found += [(node.lineno, "ACCENT") for name in node.names if name.name == "ACCENT"]
        pairs = []
        if isinstance(node, ast.keyword) and node.arg:
            pairs = [(node.arg, node.value)]
        elif isinstance(node, ast.Dict):
            pairs = [(getattr(k, "value", ""), v) for k, v in zip(node.keys, node.values)]  # noqa: B905
        for name, value in pairs:
            if SETS.fullmatch(str(name)) and _written(value):
                found.append((value.lineno, ast.unparse(value)))
    return [f"line {line}: {colour}" for line, colour in sorted(set(found))]


def _written(value: ast.expr) -> bool:
    """Whether a colour is written out: a text, a number, or several of them."""
    try:
        return ast.literal_eval(value) not in MIXED
    except ValueError:
        return False


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.stem)
def test_script_writes_no_colour_of_its_own(path):
    found = own_colours(path.read_text(encoding="utf-8"))
    assert not found, f"{path.relative_to(ROOT)} has {found}; take them from figures/palette.py"


def test_no_two_meanings_have_one_colour():
    named = (
        "OVERTURNS",
        "SURVIVES",
        "PREVENTED",
        "CAUSED",
        "UNDECIDED",
        "MODEL",
        "FIXED",
        "RECORD",
    )
    colours = [getattr(palette, name) for name in named]
    assert len(set(colours)) == len(colours)


def luminance(colour: str) -> float:
    """The relative luminance of a colour (WCAG 2)."""
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in to_rgb(colour)]
    return sum(w * c for w, c in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: str, other: str) -> float:
    """The contrast of two colours (WCAG 2)."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def test_outcomes_of_two_structures_differ_in_grey_print():
    areas = (palette.OVERTURNED, palette.PREVENTED, palette.CAUSED, palette.UNDECIDED)
    for lighter, darker in pairwise(areas):
        assert contrast(lighter, darker) > 1.7, (lighter, darker)


@pytest.mark.parametrize("colour", ["OVERTURNS", "SURVIVES", "CAUSED", "MODEL", "FIXED", "RECORD"])
def test_words_in_a_colour_can_be_read(colour):
    assert contrast(getattr(palette, colour), PAPER) > 4.0


def test_lightest_line_can_be_seen():
    assert contrast(shades(6)[0], PAPER) > 3.0


@pytest.mark.parametrize("name", ["OVERTURNS", "SURVIVES", "PREVENTED", "CAUSED"])
def test_explorer_shows_outcomes_in_the_same_colours(name):
    style = (ROOT / "src/explorer" / "style.css").read_text(encoding="utf-8")
    first = re.search(rf"--{name.lower()}: (#[0-9a-f]{{6}});", style)
    assert first is not None
    assert first[1] == getattr(palette, name)
