"""The animation: what happens to each of the three, told in words, and played three times."""

import pytest
from PIL import Image

from steps import animation

CASE = {
    "column": {"half_width": 0.5, "half_height": 3.0},
    "mass_ratio": 1.0,
    "cap": {"width": 2.6, "depth": 0.6},
    "pulse": {"shape": "one-cosine", "amplitude": 0.29, "period": 1.5},
    "duration": 7.0,
    "frames_per_second": 1,
}


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
