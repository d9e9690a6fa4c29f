"""What the page draws and prints, against the library and against its own key of colours."""

import math
import re

import numpy as np
import pytest

from steps.explorer import blocks, motion
from topheavy import Cap, Column, RockingFrame, contact_forces, simulate
from topheavy.bodies.kinematics import cap_displacement
from topheavy.forces.contact import column_forces

WEAK = {
    "b": 0.5,
    "h": 3.0,
    "g": 1.0,
    "L": 5.0,
    "r": None,
    "shape": "one-cosine",
    "a": 0.195,
    "T": 1.5,
}
"""All three structures rock, and survive."""
COLUMN = Column(WEAK["b"], WEAK["h"])
OMEGA = 2.0 * math.pi / WEAK["T"]


@pytest.fixture
def page(browser):
    """The page at the weak pulse, with its strips drawn."""
    browser.open("g=1&a=0.195")
    browser.do("new Promise(next => setTimeout(next, 300))")
    return browser


@pytest.fixture(scope="module")
def responses(records):
    """The same motion by the library."""
    shaking = motion(WEAK, records)
    return [
        simulate(block, shaking, samples=8001, duration=12.0) for block in blocks(WEAK).values()
    ]


# The map -----------------------------------------------------------------------------------------

CELLS = """(() => {
  const {codes, columns, rows} = spectrumChart.cells, {ctx, bbox} = spectrumChart.chart;
  const probe = document.createElement("canvas").getContext("2d");
  const key = ["neither", "prevented", "caused", "both"].map(name => {
    const shown = getComputedStyle(document.querySelector(`#key .${name}`)).backgroundColor;
    probe.fillStyle = name === "neither" ? colour("paper") : shown;
    probe.fillRect(0, 0, 1, 1);
    return [...probe.getImageData(0, 0, 1, 1).data].slice(0, 3).join();
  });
  const at = (i, j) => codes[i + columns * j], around = [-1, 0, 1];
  const found = [[0, 0], [0, 0], [0, 0], [0, 0]]; // other colours, that of the key
  for (let i = 1; i + 1 < columns; i++) for (let j = 1; j + 1 < rows; j++) {
    const code = at(i, j);
    if (around.some(k => around.some(l => at(i + k, j + l) !== code))) continue;
    const x = bbox.left + (i + 0.5) / columns * bbox.width;
    const y = bbox.top + bbox.height - (j + 0.5) / rows * bbox.height;
    const seen = [...ctx.getImageData(Math.round(x), Math.round(y), 1, 1).data].slice(0, 3).join();
    found[code][Number(seen === key[code])] += 1;
  }
  return found;
})()"""


def test_each_cell_of_the_map_has_the_colour_that_the_key_gives_its_outcome(browser):
    browser.open("g=4", until="spectrum")
    found = browser.do(CELLS)
    for wrong, right in found:
        assert right > 3, found
        assert wrong < 0.1 * right  # under "you are here"


INK = """(() => {
  const seen = [[], []];
  const path = Path2D.prototype;
  const keep = ["moveTo", "lineTo"].map(name => [name, path[name]]);
  const made = [];
  for (const [name, old] of keep) path[name] = function (...at) {
    if (!made.includes(this)) made.push(this);
    seen[made.indexOf(this)].push(at);
    old.apply(this, at);
  };
  const {codes, columns, rows} = spectrumChart.cells;
  spectrumChart.outcomes({id: 0, codes, columns, rows, share: 1});
  for (const [name, old] of keep) path[name] = old;
  const at = ([x, y]) => [[-0.5, -0.5], [0.5, 0.5], [-0.5, 0.5], [0.5, -0.5]].map(([k, l]) =>
    codes[Math.floor(x + k * 0.9) + columns * Math.floor(y + l * 0.9)]);
  return spectrumChart.cells.lines.map(([line, width]) => [width,
    seen[made.indexOf(line)].filter((_, k) => k % 7 === 0).map(at)]);
})()"""


def test_boundary_of_the_frame_is_solid_and_that_of_the_column_dotted(browser):
    browser.open(until="spectrum")
    (thin, solid), (thick, dotted) = browser.do(INK)
    assert thin < thick
    for points, bit in ((solid, 2), (dotted, 1)):
        assert len(points) > 20
        beside = [{code & bit for code in around if code is not None} for around in points]
        assert sum(len(codes) == 2 for codes in beside) > 0.9 * len(beside)


def test_map_has_the_place_of_the_case(page):
    x, y = page.do("[spectrumChart.plane.here.x, spectrumChart.plane.here.y]")
    assert x == pytest.approx(OMEGA / COLUMN.frequency_parameter, rel=1e-9)
    assert y == pytest.approx(WEAK["a"] / math.tan(COLUMN.slenderness), rel=1e-9)


def test_sketch_of_another_plane_and_answers_of_another_state_are_not_shown(page):
    page.settle("spectrum")
    page.do("spectrumChart.cells.isWhole = false, spectrumChart.cells.id = -9")
    before = page.do("[spectrumChart.cells.id, minima[0]]")
    sketch = "codes: new Uint8Array(4), columns: 2, rows: 2, share: 0.1"
    page.do(f"outline({{id: -5, of: 'other', {sketch}}})")
    page.do(f"hear({{data: {{id: survey - 1, {sketch}}}}})")
    page.do("hear({data: {id: survey - 1, index: 0, minimum: 9}})")
    assert page.do("[spectrumChart.cells.id, minima[0]]") == before
    page.do(f"outline({{id: -5, of: spectrumChart.keys[0], {sketch}}})")
    assert page.do("spectrumChart.cells.id") == -5  # one of this plane is shown


# The strips --------------------------------------------------------------------------------------


def test_strips_are_the_histories_of_the_library_over_their_own_slenderness(page, responses):
    slowest = min(block.frequency_parameter for block in blocks(WEAK).values())
    assert page.do("found.times.at(-1)") == pytest.approx(WEAK["T"] + 10.0 / slowest, rel=1e-9)
    for k, (ours, block) in enumerate(zip(responses, blocks(WEAK).values(), strict=True)):
        times, values = page.do("strips[{0}].chart.data.map(each => [...each])", k)
        expected = np.interp(times, ours.time, ours.rotation / block.slenderness)
        assert np.abs(np.subtract(values, expected)).max() < 0.01
        assert min(values) < -0.01  # both signs
        assert max(values) > 0.01
        low, high = page.do("strips[{0}].range", k)
        assert low < -1.0 < min(values) < max(values) < 1.0 < high


def test_strip_of_the_ground_is_the_pulse_with_the_uplift_of_the_column(page):
    times, values = page.do("strips[3].chart.data.map(each => [...each])")
    on = np.less(times, WEAK["T"] - 0.01)
    expected = np.where(on, WEAK["a"] * np.cos(OMEGA * np.array(times)), 0.0)
    inside = on | np.greater(times, WEAK["T"] + 0.01)
    assert np.abs(np.subtract(values, expected))[inside].max() < 1e-3
    level = COLUMN.uplift_acceleration
    assert page.do("strips[3].levels") == pytest.approx([-level, level], rel=1e-9)


# The drawing -------------------------------------------------------------------------------------


def shift(text):
    return [float(number) for number in re.findall(r"-?[\d.]+(?:e-?\d+)?", text)]


@pytest.mark.parametrize("time", [0.9, 1.7, 2.4])
def test_pose_is_that_of_the_instant(page, responses, time):
    page.do("pause(), show({0})", time)
    turned = {"single": 0, "pot": 1, "left": 2, "right": 2}
    angles = []
    for name, k in turned.items():
        degrees, pivot, _ = shift(page.do(f"scene.{name}.getAttribute('transform')"))
        expected = np.interp(time, responses[k].time, responses[k].rotation)
        assert math.radians(degrees) == pytest.approx(expected, abs=0.01 * COLUMN.slenderness)
        assert pivot == pytest.approx(math.copysign(WEAK["b"], degrees))
        angles.append(math.radians(degrees))
    u, minus_v = shift(page.do("scene.cap.getAttribute('transform')"))
    assert (u, -minus_v) == pytest.approx(cap_displacement(COLUMN, angles[-1]), abs=1e-9)
    assert page.do("document.getElementById('clock').textContent") == f"{time:.2f} s"
    assert float(page.do("document.getElementById('time').value")) == pytest.approx(
        1000.0 * time / page.do("found.times.at(-1)"), abs=1.0
    )


def test_ground_moves_in_metres_and_its_arrow_has_the_sign_of_its_acceleration(page):
    moved, sign = [], []
    for share in (0.02, 0.5):
        page.do("pause(), show({0})", share * WEAK["T"])
        moved.append(shift(page.do("scene.moving.getAttribute('transform')"))[0])
        path = page.do("scene.svg.querySelector('.arrow').getAttribute('d')")
        sign.append(float(re.search(r"h(-?[\d.]+)", path)[1]))
    # twice integrated, but for what a seismometer of a long period leaves out
    most = 2.0 * WEAK["a"] * 9.81 / OMEGA**2
    assert 0.5 * most < moved[1] < most
    assert sign[0] > 0.0 > sign[1]


def test_colours_of_the_drawing_are_those_of_the_outcomes(browser):
    browser.open("g=1&a=0.31")
    classes = browser.do("scene.groups.map(group => group.getAttribute('class'))")
    assert classes == ["overturns", "overturns", "survives"]
    words = browser.do(
        "[...document.querySelectorAll('#verdict span')].map(each => each.className)"
    )
    assert words == [f"{name}-word" for name in classes]


# The numbers -------------------------------------------------------------------------------------


def required(block_number, response, ground):
    """The largest required friction of a history between impacts, by the library."""
    moving = np.abs(response.rotation) > 1e-9
    given = response.rotation[moving], response.velocity[moving], ground[moving]
    if block_number == 0:
        return np.max(column_forces(COLUMN, *given).friction_demand)
    frame, cap = RockingFrame(COLUMN, 1.0), Cap(WEAK["L"], 0.1 * WEAK["h"])
    forces = contact_forces(frame, cap, *given)
    return np.max([np.max(each) for each in np.atleast_1d(forces.friction_demand)])


def test_numbers_are_those_of_the_library(page, responses, records):
    shaking = motion(WEAK, records)
    for k, (block, response) in enumerate(zip(blocks(WEAK).values(), responses, strict=True)):
        cells = f"[...document.getElementById('rows').children[{k}].children]"
        row = page.do(f"{cells}.map(each => each.textContent)")
        numbers = [float(re.search(r"[\d.]+$", cell)[0]) for cell in (row[2], *row[4:])]
        p = block.frequency_parameter
        expected = [
            response.peak_rotation / block.slenderness,
            block.uplift_acceleration,
            math.degrees(block.slenderness),
            p,
            3.0 * 9.81 / (4.0 * p**2),
            block.restitution,
        ]
        assert numbers[0] == pytest.approx(expected[0], rel=6e-3)  # three digits
        assert numbers[1:6] == pytest.approx(expected[1:], rel=1e-3)
        assert row[1] == "survives"
        if k != 1:
            ground = np.array([shaking.excitation(time) for time in response.time])
            assert numbers[6] == pytest.approx(required(k, response, ground), rel=0.02)


def test_dimensions_are_whole_and_the_python_is_of_the_state(page):
    assert page.do("document.getElementById('size').textContent") == "column 1 m wide, 6 m high"
    assert "block(0.9)" in page.do("inPython({...DEFAULTS, r: 0.9})")
    assert "block(0" not in page.do("inPython(DEFAULTS)")


def test_second_record_is_not_shaken_as_the_first(browser):
    browser.open()
    for name, peak in (("first", 0.3), ("second", 0.15)):
        lines = (f"{k * 0.01:.2f},{peak * np.sin(k / 20):.5f}" for k in range(400))
        browser.drop(f"{name}.csv", "time (s),acceleration (g)\n" + "\n".join(lines))
        browser.settle()
    browser.do("change({x: 1.5}, true)")
    browser.settle()
    assert browser.do("Math.max(...found.ground)") == pytest.approx(1.5 * 0.15, rel=0.01)
