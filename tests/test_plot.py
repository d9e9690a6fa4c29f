"""Pictures: the library's own, and colours that have one meaning each."""

import re
import subprocess
import sys
from functools import cache

import matplotlib as mpl
import numpy as np
import pytest

import topheavy
from figures import palette
from tests.cases import COLUMN, FRAME, ROOT
from topheavy import Cap, FixedMassColumn, MonolithicPortal, Pulse, Record, RockingFrame, plot


@pytest.fixture(autouse=True)
def _closed():
    mpl.use("agg")
    yield
    mpl.pyplot.close("all")


def test_history_is_in_parts_of_alpha_with_its_impacts():
    response = topheavy.simulate(FRAME, Pulse("one-sine", 0.4, angular_frequency=6.0), samples=50)
    axes = plot.history(response)
    line, impacts, *_ = axes.lines
    assert np.array_equal(line.get_ydata(), response.rotation / FRAME.slenderness)
    assert len(impacts.get_xdata()) == np.sum(response.impact_times <= response.time[-1]) > 0
    assert "(s)" in axes.get_xlabel()


def test_map_has_the_peak_at_its_frequency_and_amplitude():
    outcomes = topheavy.overturning_map(FRAME, "one-sine", [2.0, 4.0, 8.0], [0.1, 0.3])
    axes = plot.map(outcomes)
    shown = axes.collections[0].get_array().reshape(2, 3)
    assert shown[1, 2] == outcomes.peak_rotation.to_numpy()[2, 1] / FRAME.slenderness > 0
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("Angular frequency (rad/s)", "Amplitude (g)")


def test_fragility_has_points_in_bands_of_exact_intervals():
    motions = [Record(0.3, [0.0, a, -a, b]) for a, b in ((0.3, 0), (0.6, 0.3), (1, 0.6), (1.5, 1))]
    ensemble = topheavy.fragility({"one": COLUMN}, motions, [0.5, 1.0, 2.0], measure="PGA")
    assert ensemble.curves.probability[0].values.tolist() == [0.25, 0.25, 1.0]
    axes = plot.fragility(ensemble)
    points, _ = axes.lines
    assert np.array_equal(points.get_ydata(), ensemble.curves.probability[0])
    (band,) = axes.collections
    corners = {tuple(corner) for corner in band.get_paths()[0].vertices}
    for end in (ensemble.curves.probability_low, ensemble.curves.probability_high):
        assert set(zip(ensemble.curves.level.values, end[0].values, strict=True)) <= corners
    assert axes.get_xlabel() == "PGA (g)"


PULSE = Pulse("one-sine", 0.4, angular_frequency=6.0)
RESULTS = {
    "history": lambda: topheavy.simulate(FRAME, PULSE),
    "forces": lambda: topheavy.contact_forces(FRAME, Cap(5, 0.4), RESULTS["history"](), PULSE),
    "map": lambda: topheavy.overturning_map(FRAME, "one-sine", [2.0, 4.0], [0.1, 0.3]),
    "spectrum": lambda: topheavy.overturning_spectrum([COLUMN, FRAME], "one-sine", [0.7, 0.3]),
    "rotations": lambda: topheavy.peak_rotations([COLUMN, FRAME], PULSE, [0.3, 0.2, 9.0]),
    "capacity": lambda: topheavy.capacity(FRAME, PULSE),
    "fragility": lambda: topheavy.fragility(COLUMN, [PULSE], [0.5, 1.0], max_acceleration),
    "structure": lambda: FRAME,
}
OTHERS = {
    "overturned_by": lambda: topheavy.overturned_by(FRAME, PULSE, [1.0, 2.0]),
    "a number": lambda: 3.0,
}


def max_acceleration(motion):
    return motion.peak_acceleration


@cache
def value_of(result):
    return (RESULTS | OTHERS)[result]()


@pytest.mark.parametrize("function", plot.__all__)
@pytest.mark.parametrize("result", RESULTS | OTHERS)
def test_each_result_has_one_plot(function, result):
    value = value_of(result)
    if function == result:
        axes = getattr(plot, function)(value)
        assert axes.get_xlabel()
        assert axes.get_ylabel()
        assert getattr(plot, function)(value, axes=axes) is axes
    else:
        hint = f"; plot.{result} draws this one" if result in set(RESULTS) - {"structure"} else ""
        says = "shown|structure is" if function == "structure" else f"expected the .*{hint}$"
        with pytest.raises(ValueError, match=says):
            getattr(plot, function)(value)


@pytest.mark.parametrize("function", plot.__all__)
def test_what_is_no_axes_is_refused(function):
    with pytest.raises(ValueError, match="expected Axes of Matplotlib"):
        getattr(plot, function)(value_of(function), axes=np.array([1]))


def test_spectrum_tells_the_modes_apart_and_ascends():
    structures = [COLUMN, FRAME]
    minima = topheavy.overturning_spectrum(structures, "one-sine", [2.0, 0.3], highest=80.0)
    axes = plot.spectrum(minima)
    line, after, without = axes.lines[:3]
    assert line.get_xdata().tolist() == [0.3, 2.0]
    assert line.get_ydata().tolist() == minima.acceleration[0].to_numpy()[::-1].tolist()
    assert np.isfinite(after.get_ydata()).tolist() == [False, True]
    assert np.isfinite(without.get_ydata()).tolist() == [True, False]
    assert after.get_markerfacecolor() == line.get_color() != without.get_markerfacecolor()
    names = [text.get_text() for text in axes.get_legend().get_texts()]
    assert names == ["Column 1", "RockingFrame 2", *plot.MODES]


@pytest.mark.parametrize(
    ("shown", "bodies"),
    [
        (COLUMN, 1),
        (FixedMassColumn(COLUMN, 1.0), 2),
        (FRAME, 3),
        (RockingFrame(COLUMN, 1.0, columns=4), 5),
        (MonolithicPortal(COLUMN, 1, 8), 3),
    ],
)
@pytest.mark.parametrize("rotation", [-0.1, 0.0, 0.1])
def test_structure_stands_on_the_ground_and_leans_as_it_rocks(shown, bodies, rotation):
    axes = plot.structure(shown, rotation)
    assert len(axes.patches) == bodies
    corners = np.concatenate([patch.get_xy()[:4] for patch in axes.patches])
    assert corners[:, 1].min() == pytest.approx(0.0, abs=1e-12)
    high = corners[:, 1] > COLUMN.half_height
    lean = corners[high, 0].mean() - corners[~high, 0].mean()
    assert np.sign(lean.round(9)) == np.sign(rotation)


def test_without_matplotlib_the_extra_is_named():
    code = (
        "import sys; sys.modules['matplotlib'] = None; import topheavy as th; "
        "th.plot.structure(th.Column(0.5, 3.0))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert 'pip install "topheavy[plot]"' in done.stderr


@pytest.mark.parametrize("name", ["OVERTURNS", "SURVIVES", "PREVENTED", "CAUSED"])
def test_explorer_shows_outcomes_in_the_same_colours(name):
    style = (ROOT / "src/explorer" / "style.css").read_text(encoding="utf-8")
    first = re.search(rf"--{name.lower()}: (#[0-9a-f]{{6}});", style)
    assert first is not None
    assert first[1] == getattr(palette, name)
