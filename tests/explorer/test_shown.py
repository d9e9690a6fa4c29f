"""What the page draws and prints, against the library and against its own key of colours."""

import math
import re

import numpy as np
import pytest

from documents.explorer import blocks, motion
from topheavy import Cap, Column, RockingFrame, simulate
from topheavy.bodies.kinematics import cap_displacement
from topheavy.forces.contacts import forces_at

WEAK = {"width": 1.0, "height": 6.0, "g": 1.0, "shape": "one-cosine", "a": 0.195, "T": 1.5}
"""All three structures rock, and survive."""
COLUMN = Column.of_dimensions(width=WEAK["width"], height=WEAK["height"])
OMEGA = 2.0 * math.pi / WEAK["T"]


@pytest.fixture
def page(browser):
    """The page at the weak pulse."""
    browser.open_once("g=1&a=0.195")
    return browser


@pytest.fixture(scope="module")
def responses(records):
    """The same motion by the library."""
    shaking = motion(WEAK, records)
    return [
        simulate(block, shaking, samples=8001, duration=12.0) for block in blocks(WEAK).values()
    ]


# The film ----------------------------------------------------------------------------------------

OUTCOMES = """[scene.groups.map(group => group.getAttribute("class")),
  [...document.querySelectorAll("#verdict span")].map(each => each.className.split("-")[0]),
  [0, 1, 2].map(k => document.querySelector(`#caption${k} span`).className.split("-")[0])]"""


def test_outcomes_are_shown_before_the_film(browser):
    browser.open("g=1&a=0.31", moves=True)
    browser.wait("isPlaying")
    assert browser.do(f"(show(0), {OUTCOMES})") == 3 * [["overturns", "overturns", "survives"]]
    browser.do("change({g: 0.25}, false)")  # while a slider is dragged
    browser.settle()
    assert browser.do(OUTCOMES) == 3 * [["overturns", "overturns", "overturns"]]


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


def test_map_has_the_colours_of_its_key(browser):
    browser.open("g=4", until="map")
    counts = browser.do(CELLS)
    for wrong, right in counts:
        assert right > 3, counts
        assert wrong < 0.1 * right  # under "you are here"


def test_map_has_the_place_of_the_case_and_a_press_goes_to_another(page):
    page.kept = None
    x, y = page.do("[spectrumChart.plane.here.x, spectrumChart.plane.here.y]")
    assert x == pytest.approx(OMEGA / COLUMN.frequency_parameter, rel=1e-9)
    assert y == pytest.approx(WEAK["a"] / math.tan(COLUMN.slenderness), rel=1e-9)
    page.do("pick(4, 2)")
    x, y = page.do("Object.values(planeOf(state).here)")
    assert (x, y) == pytest.approx((4.0, 2.0), rel=1e-3)


def test_late_answer_to_another_state_is_not_shown(browser):
    browser.open(until="minima")
    before, after = browser.do(
        """(() => {
          const shown = () => [spectrumChart.cells?.columns ?? 0,
            document.getElementById("rows").textContent,
            document.getElementById("sensitive").hidden,
            document.getElementById("shape-error").textContent];
          change({a: 0.4}, true);
          change({height: 7}, true);
          const before = shown(), late = encode({...state, height: 6});
          [{keys: ["other", ""], codes: new Uint8Array(4).fill(3), columns: 2, rows: 2, share: 1},
            {index: 0, minimum: 1}, {index: 0, isSensitive: true}, {error: "late"}].forEach(
            each => hear({data: {id: late, ...each}}));
          return [before, shown()];
        })()"""
    )
    assert before == after


# The strips and the drawing ----------------------------------------------------------------------


def test_strips_are_the_histories_of_the_library_over_their_own_slenderness(page, responses):
    slowest = min(block.frequency_parameter for block in blocks(WEAK).values())
    assert page.do("found.times.at(-1)") == pytest.approx(WEAK["T"] + 10.0 / slowest, rel=1e-9)
    for k, (ours, block) in enumerate(zip(responses, blocks(WEAK).values(), strict=True)):
        times, values = page.do("strips[{0}].chart.data.map(each => [...each])", k)
        expected = np.interp(times, ours.time, ours.rotation / block.slenderness)
        assert np.abs(np.subtract(values, expected)).max() < 0.01
        low, high = page.do("strips[{0}].range", k)
        assert low < -1.0 < min(values) < -0.01 < 0.01 < max(values) < 1.0 < high


def test_strip_of_the_ground_is_the_pulse_with_the_uplift_of_the_column(page):
    times, values = page.do("strips[3].chart.data.map(each => [...each])")
    on = np.less(times, WEAK["T"] - 0.01)
    expected = np.where(on, WEAK["a"] * np.cos(OMEGA * np.array(times)), 0.0)
    inside = on | np.greater(times, WEAK["T"] + 0.01)
    assert np.abs(np.subtract(values, expected))[inside].max() < 1e-3
    level = COLUMN.uplift_acceleration
    assert page.do("strips[3].levels") == pytest.approx([-level, level], rel=1e-9)


def numbers_in(text):
    return [float(number) for number in re.findall(r"-?[\d.]+(?:e-?\d+)?", text)]


@pytest.mark.parametrize("time", [0.9, 1.7])
def test_pose_is_that_of_the_instant(page, responses, time):
    page.do("pause(), show({0})", time)
    turned = {"single": 0, "pot": 1, "left": 2, "right": 2}
    angles = []
    for name, k in turned.items():
        degrees, pivot, _ = numbers_in(page.do(f"scene.{name}.getAttribute('transform')"))
        expected = np.interp(time, responses[k].time, responses[k].rotation)
        assert math.radians(degrees) == pytest.approx(expected, abs=0.01 * COLUMN.slenderness)
        assert pivot == pytest.approx(math.copysign(COLUMN.half_width, degrees))
        angles.append(math.radians(degrees))
    assert page.do("scene.cap.getBBox().height") == pytest.approx(0.2 * COLUMN.half_height)
    u, minus_v = numbers_in(page.do("scene.cap.getAttribute('transform')"))
    assert (u, -minus_v) == pytest.approx(cap_displacement(COLUMN, angles[-1]), abs=1e-9)
    assert page.do("document.getElementById('clock').textContent") == f"{time:.2f} s"


# The numbers -------------------------------------------------------------------------------------


def required(block_number, response, ground):
    """The largest required friction of a history between impacts, by the library."""
    moving = np.abs(response.rotation) > 1e-9
    states = response.rotation[moving], response.velocity[moving], ground[moving]
    frame = RockingFrame(COLUMN, float(block_number > 0))  # without a cap beam, two columns
    forces = forces_at(frame, Cap(5.0, 0.1 * COLUMN.half_height), *states)
    return np.nanmax(forces.friction_demand)


def test_numbers_are_those_of_the_library(page, responses, records):
    shaking = motion(WEAK, records)
    for k, (block, response) in enumerate(zip(blocks(WEAK).values(), responses, strict=True)):
        cells = f"[...document.getElementById('rows').children[{k}].children]"
        row = page.do(f"{cells}.map(each => each.textContent)")
        numbers = [float(re.search(r"[\d.]+$", cell)[0]) for cell in (row[2], *row[4:])]
        p = block.frequency_parameter
        peak = response.peak_rotation / block.slenderness
        angle, size = math.degrees(block.slenderness), 3.0 * 9.81 / (4.0 * p**2)
        expected = [block.uplift_acceleration, angle, p, size, block.restitution]
        assert numbers[0] == pytest.approx(peak, rel=6e-3)  # three digits
        assert numbers[1:6] == pytest.approx(expected, rel=1e-3)
        assert row[1] == "survives"
        if k != 1:
            ground = np.array([shaking.excitation(time) for time in response.time])
            assert numbers[6] == pytest.approx(required(k, response, ground), rel=0.02)
