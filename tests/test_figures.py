"""Each figure shows what the published table says; two are compared with their subject."""

import math

import numpy as np
import pandas as pd
import pytest
from matplotlib.colors import to_hex

from documents import shown

BOTH, PREVENTED, CAUSED = "#f1d3c6", "#c79a0a", "#a3195b"


@pytest.mark.parametrize("name", shown.names())
def test_figure_shows_what_is_published(name):
    expected = pd.read_csv(shown.TABLE).query("figure == @name").reset_index(drop=True)
    table = shown.table(name, shown.drawn(name))
    pd.testing.assert_frame_equal(table, expected, rtol=1e-5, atol=1e-6, check_dtype=False)


def test_areas_of_the_map_are_the_intervals_that_overturn_frame_and_column():
    axis = shown.drawn("where").axes[0]
    table = pd.read_csv(shown.REFERENCE / "spectra.csv")
    cells = table.query("slenderness_deg == 5 and shape == 'one-cosine'")
    paths = [(to_hex(p.get_facecolor()), p.get_path(), p.get_clip_path()) for p in axis.patches]
    assert [colour for colour, *_ in paths] == [CAUSED, PREVENTED, BOTH]  # from below
    clip = paths[2][2].get_fully_transformed_path()
    assert len(clip.vertices) == len(paths[0][1].vertices)  # both: the column's within the frame's
    for (_, path, _), ratio in zip(paths, (math.inf, 0.0, 0.0), strict=True):
        of = cells[(cells.mass_ratio == ratio) & (cells.lower < 16)]
        of = of.assign(upper=of.upper.fillna(16.0).clip(upper=16)).sort_values("lower")
        at, step = of.frequency_ratio.unique(), np.diff(np.sort(of.frequency_ratio.unique())).min()
        for frequency in at[(at > at.min()) & (at < at.max())]:
            rows = of[of.frequency_ratio == frequency]
            inside = [path.contains_point((frequency, y)) for y in (rows.lower + rows.upper) / 2]
            gaps = (rows.upper.to_numpy()[:-1] + rows.lower.to_numpy()[1:]) / 2
            assert all(inside)
            assert not any(path.contains_point((frequency, y)) for y in gaps)
            after = rows[rows["mode"] == "with impact"]
            narrow = after.drop((after.upper - after.lower).nlargest(1).index)
            for y in (narrow.lower + narrow.upper) / 2:
                for side in (-0.49, 0.49):
                    assert path.contains_point((frequency + side * step, y))


def test_free_body_is_in_equilibrium_and_moves_as_the_equations_say():
    figure = shown.drawn("free_body")
    left, right = figure.axes
    shapes = [patch.get_xy()[:4] for patch in left.patches if hasattr(patch, "get_xy")]
    (cap, moved), columns = shapes[:2], shapes[2::2]
    width, height = np.ptp(columns[0], axis=0)
    diagonal, slenderness = math.hypot(width, height), math.atan(width / height)
    lean = slenderness - 0.6 * slenderness  # α + θ
    u = diagonal * (math.sin(lean) - math.sin(slenderness))  # Eq. (4), θ < 0
    v = diagonal * (math.cos(lean) - math.cos(slenderness))  # Eq. (7)
    np.testing.assert_allclose(moved - cap, np.tile([u, v], (4, 1)))
    arrows = [text for text in right.texts if text.arrow_patch]
    vectors = {}
    for arrow, label in zip(arrows, right.texts[1::2], strict=False):
        vectors[label.get_text()] = np.subtract(arrow.xy, arrow.xyann) / (5.0, 1.0)
    (x1, _), (x2, _), (_, z1), (_, z2), (inertia, _), (_, weight) = vectors.values()
    assert x1 + x2 == pytest.approx(-inertia)  # Eq. (13)
    assert z1 + z2 == pytest.approx(-weight)  # Eq. (16)
    assert x2 - x1 == pytest.approx((z2 - z1) * math.tan(lean))  # Eq. (12)
    seats = np.array([line.get_xydata()[0] for line in right.lines])
    arms = seats - moved.mean(axis=0)
    forces = np.array([[x1, z1], [x2, z2]])
    assert arms[:, 0] @ forces[:, 1] == pytest.approx(arms[:, 1] @ forces[:, 0])
