"""The animation: what happens to each of the three, told in words, and played three times."""

import math

import numpy as np
import pytest
from PIL import Image

from steps import animation
from topheavy import Pulse

CASE = {
    "column": {"half_width": 0.5, "half_height": 3.0},
    "mass_ratio": 1.0,
    "cap": {"width": 2.6, "depth": 0.6},
    "pulse": {"shape": "one-cosine", "amplitude": 0.29, "period": 1.5},
    "duration": 7.0,
    "frames_per_second": 1,
}
ALPHA = math.atan(1 / 6)
TIMES = np.arange(0.0, 7.0, 0.05)
PULSE = Pulse("one-cosine", 0.29, 2 * math.pi / 1.5)


@pytest.mark.parametrize(
    ("name", "word"), [("column", "overturns"), ("vase", "overturns"), ("frame", "survives")]
)
def test_word_is_what_happens(name, word):
    theta = animation.rotations(animation.structures(CASE)[name], PULSE, TIMES, CASE)
    found, since = animation.outcome_in_words(theta, TIMES, ALPHA)
    assert found == word
    assert 1.5 < since < 6.0
    assert np.isfinite(theta).all()


def test_vase_lies_on_its_mass():
    theta = animation.rotations(animation.structures(CASE)["vase"], PULSE, TIMES, CASE)
    assert abs(theta[-1]) == pytest.approx(math.pi / 2 - math.atan2(0.8, 6.0))


def test_frame_that_overturns_is_refused():
    strong = CASE | {"pulse": CASE["pulse"] | {"amplitude": 0.5}}
    with pytest.raises(ArithmeticError, match="the frame overturns; expected a pulse"):
        animation.main(strong)


def test_it_is_played_three_times(tmp_path):
    pictures = animation.main(CASE)
    for name, loop in (("a.gif", 2), ("a.png", 3)):  # a GIF counts the repetitions
        animation.save(str(tmp_path / name), pictures, CASE)
        with Image.open(tmp_path / name) as found:
            assert found.info["loop"] == loop
            assert found.n_frames == len(pictures) == 7


def test_pulse_and_structures_are_told_in_numbers():
    figure, *_ = animation.stage(PULSE, TIMES, CASE)
    told = " ".join(text.get_text() for axis in figure.axes for text in axis.texts)
    for words in (
        "one cosine, 0.29 g, 1.5 s",
        "columns of 6 m × 1 m",
        "γ = 1",
        *(animation.NAMES[name].replace("\n", " ") for name in animation.IN_FIGURE.values()),
    ):
        assert words in told
