"""Each figure, drawn from the published tables, shows what it showed when it was last looked at.

tests/figures.csv has what each panel shows, by its look, as "#8c6d00 o-": the number of points, and
the sums of x, y and xy. After you have changed a figure, look at it, run `python -m
tests.test_figures`, and read the diff.
"""

import math
import re
import runpy
from collections import defaultdict
from inspect import signature
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib import collections
from matplotlib.colors import to_hex
from matplotlib.text import Annotation

from tests.cases import CONFIG, ROOT

WHITE, BOTH, PREVENTED, CAUSED = "#ffffff", "#f1d3c6", "#c79a0a", "#a3195b"
SHOWN = Path(__file__).with_name("figures.csv")
FIGURES = [
    path.stem
    for path in sorted(ROOT.glob("figures/*.py"))
    if "\ndef draw(" in path.read_text("utf-8")
]

# What a figure shows ------------------------------------------------------------------------------


def plain(words):
    """Return words without the marks of mathematics."""
    for name, letter in {"gamma": "γ", "infty": "∞", "alpha": "α", "omega": "ω", "pi": "π"}.items():
        words = words.replace(f"\\{name}", letter)
    return " ".join(re.sub(r"[${}]|\\[a-z]+|\\", "", words.replace(r"\,", " ")).split())


def of_line(line):
    label, face = plain(str(line.get_label())), line.get_markerfacecolor()
    marker, dash = (
        "" if one in ("None", "none", None) else one
        for one in (line.get_marker(), line.get_linestyle())
    )
    if marker and to_hex(face) == WHITE:
        marker = f"hollow {marker}"
    look = f"{to_hex(line.get_color())} {marker}{dash if line.get_linewidth() else ''}"
    return f"{look} {'' if label.startswith('_') else label}".strip(), line.get_xydata()


def of_collection(one):
    if isinstance(one, collections.QuadMesh):
        corners = one.get_coordinates()
        centres = (corners[:-1, :-1] + corners[1:, 1:]) / 2
        colours = one.cmap(one.norm(one.get_array()))
        for colour in np.unique(colours.reshape(-1, 4), axis=0):
            if colour[3]:
                yield f"{to_hex(colour)} mesh", centres[(colours == colour).all(axis=2)]
    elif isinstance(one, collections.LineCollection):
        yield f"{to_hex(one.get_color()[0])} segments", np.vstack(one.get_segments())
    elif isinstance(one, collections.PathCollection):
        faces = [*map(to_hex, one.get_facecolor()), "none"]
        yield f"{faces[0]} in {to_hex(one.get_edgecolor()[0])}", np.array(one.get_offsets())
    else:
        area = np.vstack([path.vertices for path in one.get_paths()])
        yield f"{to_hex(one.get_facecolor()[0])} area", area


def shown(figure):
    """Yield panel, look and points of all artists, and panel, words and place of texts."""
    for panel, axis in enumerate(figure.axes):
        for line in axis.lines:
            yield panel, *of_line(line)
        for one in axis.collections:
            for look, points in of_collection(one):
                yield panel, look, points
        for one in axis.patches:
            vertices = one.get_patch_transform().transform(one.get_path().vertices)
            name = f"{to_hex(one.get_facecolor())} in {to_hex(one.get_edgecolor())}"
            yield panel, f"{name} {type(one).__name__}", vertices
        legend = axis.get_legend()
        handles = legend.get_texts() if legend else []
        ticks = [*axis.get_yticklabels(), *axis.get_xticklabels()]
        for text in [*axis.texts, *handles, axis.title, *ticks]:
            words = plain(text.get_text())
            is_number = re.fullmatch(r"[−\d.^ ]*|10\^-\d", words) is not None
            if words and not (is_number and text in ticks):
                place = text.xy if isinstance(text, Annotation) else (math.nan, math.nan)
                yield panel, f"{to_hex(text.get_color())} “{words}”", np.array([place])


def drawn(name, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "figures")
    draw = runpy.run_path(str(ROOT / f"figures/{name}.py"))["draw"]
    wanted = signature(draw).parameters
    return draw(**{one: CONFIG if one == "config" else table(one) for one in wanted})


def table(name):
    return pd.read_csv(ROOT / f"tests/reference/{name}.csv")


def measured(name, figure):
    """Return a row for each panel and look: the number of points, and the sums of x, y and xy."""
    series = defaultdict(list)
    for panel, look, points in shown(figure):
        series[panel, look].append(np.asarray(points, dtype=float).reshape(-1, 2))
    rows = []
    for (panel, look), parts in sorted(series.items()):
        points = np.vstack(parts)
        sums = np.nansum([*points.T, points.prod(axis=1)], axis=1)
        rows.append((name, panel, look, len(points), *sums))
    return pd.DataFrame(rows, columns=["figure", "panel", "look", "points", "x", "y", "xy"])


@pytest.mark.parametrize("name", FIGURES)
def test_figure_shows_what_it_showed(name, monkeypatch):
    known = pd.read_csv(SHOWN).query("figure == @name").reset_index(drop=True)
    found = measured(name, drawn(name, monkeypatch))
    pd.testing.assert_frame_equal(found, known, rtol=1e-5, atol=1e-6, check_dtype=False)


def test_areas_of_the_map_are_the_intervals_that_overturn_frame_and_column(monkeypatch):
    axis = drawn("where", monkeypatch).axes[0]
    cells = table("spectra").query("slenderness_deg == 5 and shape == 'one-cosine'")
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


def test_free_body_is_in_equilibrium_and_moves_as_the_equations_say(monkeypatch):
    figure = drawn("free_body", monkeypatch)
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


if __name__ == "__main__":
    with pytest.MonkeyPatch.context() as patch:
        tables = [measured(name, drawn(name, patch)) for name in FIGURES]
    pd.concat(tables).to_csv(SHOWN, index=False, float_format="%.8g")
