"""The page as its users meet it: how it is built, its sizes, keyboard, address and odd input."""

import re

import pytest

from documents.explorer import checked_cases, titles
from topheavy.ground.shapes import SHAPES

TYPE = """(() => {
  const field = document.getElementById({0});
  field.value = {1};
  field.dispatchEvent(new Event("input", {bubbles: true}));
  return document.getElementById({0} + "-error").textContent;
})()"""


def test_promise_that_the_library_does_not_keep_stops_the_build():
    state = {"width": 1.0, "height": 6.0, "g": 1.0, "shape": "one-cosine", "a": 0.29, "T": 1.5}
    case = {"title": "A", "note": "", "state": state, "outcomes": ["survives"] * 3}
    with pytest.raises(ValueError, match=r"'A' promises \['survives'.* computes \['overturns'"):
        checked_cases([case], {})


def test_page_has_every_shape_and_no_other(request):
    motions = (request.config.rootpath / "src/explorer/motions.js").read_text(encoding="utf-8")
    assert set(titles(motions)) == set(SHAPES)
    for old, new in (('"half-sine": {', '"halfsine": {'), ('"con', "//")):
        assert old in motions
        with pytest.raises(ValueError, match=r"differ by .*expected a wave for every shape"):
            titles(motions.replace(old, new))


def test_nothing_runs_that_the_page_was_not_made_with(browser, text):
    (stated,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    assert "unsafe" not in stated
    assert "base-uri 'none'; form-action 'none'" in stated
    browser.open()
    added = "Object.assign(document.createElement('script'), {textContent: 'window.planted = 1'})"
    browser.do(f"document.body.append({added})")
    assert browser.do("window.planted ?? null") is None


# Sizes -------------------------------------------------------------------------------------------

BEYOND = """[...document.querySelectorAll("button, label, input, select, svg, .chart, p")].filter(
  element => element.checkVisibility() && !element.closest("nav, .hidden")
  && element.getBoundingClientRect().right > innerWidth + 1).map(element => element.outerHTML)"""
SMALL = """[...document.querySelectorAll("button, select, summary, a, input, .choice label")]
  .filter(element => element.checkVisibility() && !element.closest(".choice label > *")
  && element.getBoundingClientRect().height < 24).map(element => element.outerHTML)"""
BOTTOM = "document.querySelector({0}).getBoundingClientRect().bottom"


@pytest.mark.parametrize(
    ("width", "height", "whole"), [(1440, 900, "body"), (1024, 768, "#drop"), (390, 844, "#scene")]
)
def test_nothing_is_cut_and_everything_can_be_touched(browser, width, height, whole):
    browser.open(width=width, height=height, until="minima")
    assert browser.do("document.documentElement.scrollWidth") <= width
    assert browser.do(BEYOND) == browser.do(SMALL) == []
    assert browser.do(BOTTOM, whole) <= height
    numbers = browser.do("document.getElementById('rows').textContent")
    browser.resize(390 if width > 390 else 1440, 900)
    browser.wait("spectrumChart.chart.width === sizeOf(spectrumChart.place).width")
    assert browser.do(BEYOND) == []
    assert browser.do("document.getElementById('rows').textContent") == numbers


# Keyboard ----------------------------------------------------------------------------------------

PRESSABLE = """[...document.querySelectorAll(
  "button, input:not([type=radio]), input[type=radio]:checked, select, summary, pre, .scroll, a")]
  .filter(element => element.checkVisibility() && !element.hidden).length"""
FOCUSED = """(at => {
  const {outlineStyle, outlineWidth} = getComputedStyle(at.closest(".choice label") ?? at);
  return [at === document.body, outlineStyle !== "none" && parseFloat(outlineWidth) >= 2];
})(document.activeElement)"""


def test_every_control_has_a_name_and_is_reached_by_the_keyboard(browser):
    browser.open("shape=harmonic&r=0.9")
    browser.ask("Accessibility.enable")
    nodes = browser.ask("Accessibility.getFullAXTree")["nodes"]
    browser.ask("Accessibility.disable")
    roles = {"button", "slider", "textbox", "combobox", "radio", "DisclosureTriangle", "image"}
    controls = [node for node in nodes if node["role"]["value"] in roles and not node["ignored"]]
    assert len(controls) > 25
    assert [node for node in controls if not node["name"].get("value", "").strip()] == []
    browser.do("document.querySelectorAll('details').forEach(each => each.open = true)")
    browser.do("document.activeElement.blur(), window.focus()")
    reached = []
    while len(reached) < 90:
        browser.press("Tab", 9)
        is_at_end, is_outlined = browser.do(FOCUSED)
        if is_at_end:
            break
        reached.append(is_outlined)
    assert len(reached) == browser.do(PRESSABLE) + 1  # and the map
    assert all(reached)


def reach(browser, is_there):
    """Press the tabulator until the focus is where a condition on `at` holds."""
    for _ in range(80):
        browser.press("Tab", 9)
        if browser.do(f"(at => !!({is_there}))(document.activeElement)"):
            return
    raise AssertionError(f"no Tab reaches {is_there}")


def test_everything_is_done_with_the_keyboard_only(browser, tmp_path, square):
    browser.open()
    browser.do("document.activeElement.blur()")
    reach(browser, "at.closest('#cases') && at.previousElementSibling")
    browser.press("Enter", 13, "\r")
    assert browser.do("CASES.indexOf(encode(state))") == 1
    browser.settle()
    reach(browser, "at.id === 'shape'")
    browser.press("End", 35)
    assert browser.do("state.shape") == "record"
    path = tmp_path / "mine.csv"
    path.write_text(square(0.3), encoding="utf-8")
    reach(browser, "at.textContent.startsWith('Open a record')")
    browser.choose(path, lambda: browser.press("Enter", 13, "\r"))
    browser.wait("state.record === 'mine'")
    browser.settle()
    reach(browser, "at.id === 'spectrum'")
    before = browser.do("planeOf(state, fileOf(state)).here")
    for key, code in (("ArrowUp", 38), ("ArrowRight", 39), ("ArrowRight", 39), ("ArrowLeft", 37)):
        browser.press(key, code)
    after = browser.do("planeOf(state, fileOf(state)).here")
    assert after["y"] / before["y"] == pytest.approx((12 / 0.93) ** (1 / 36), rel=1e-3)
    assert after["x"] / before["x"] == pytest.approx(40 ** (1 / 48), rel=1e-3)
    reach(browser, "at.tagName === 'SUMMARY'")
    browser.press("Enter", 13, "\r")
    assert browser.do("document.activeElement.parentElement.open") is True
    assert browser.errors == []


# Address and input -------------------------------------------------------------------------------


def test_address_holds_the_state(browser):
    address = (
        "width=0.8&height=4.8&g=inf&L=4&r=0.9&cap=fixed&vase=shown&eq=linearised"
        "&shape=one-sine&a=0.55&T=0.9"
    )
    browser.open(address)
    assert browser.do("encode(state)") == address
    browser.wait(f"location.hash === '#{address}'")
    assert browser.do("document.getElementById('g').value") == "∞"
    # while the state before settles, which writes its own address
    browser.do("location.hash = 'toString=1&__proto__=2&shape=one-sine&a=0.2'; settle()")
    browser.wait("state.a === 0.2")
    assert browser.errors == []


def test_back_returns_to_what_a_case_replaced(browser):
    browser.open("width=0.8&a=0.25")
    before = browser.do("encode(state)")
    browser.do("document.querySelector('#cases button').click()")
    browser.wait("rested === 0 && location.hash === '#' + encode(state)")
    assert browser.do("encode(state)") != before
    browser.do("history.back()")
    browser.wait(f"encode(state) === '{before}'")


NUMBERS = ["NaN", "-inf", "1e999", "-1e999", "0x10", "1e", "1_0", "１", "٣", "1,000.5", "--1", ""]
IN_ADDRESS = """Object.keys(FIELDS).filter(key => {
  const {state: next, faults} = decode(new URLSearchParams({[key]: {0}}).toString());
  return next[key] !== DEFAULTS[key] || !faults[key];
})"""


def test_what_is_no_finite_number_is_refused_in_every_field(browser):
    browser.open_once()
    taken = {text: browser.do(IN_ADDRESS, text) for text in NUMBERS}
    assert {text: keys for text, keys in taken.items() if keys} == {"1e999": ["g"]}  # γ → ∞


def test_bad_entry_is_refused_and_fields_that_contradict_wait_for_each_other(browser):
    browser.open()
    assert "“wide” is not a number; expected 0.002 to 2000 m; 1 is kept" in browser.do(
        TYPE, "width", "wide"
    )
    assert browser.do(TYPE, "g", "1/4") == ""
    assert browser.do("[state.width, state.g]") == [1, 0.25]
    assert "would touch" in browser.do(TYPE, "L", "0.8")
    assert browser.do("state.L") == 5
    assert browser.do(TYPE, "width", "0.5") == ""
    assert browser.do("[state.width, state.L]") == [0.5, 0.8]
    assert browser.do("document.getElementById('L-error').textContent") == ""


# The histories at both ends of each field: whether all of their numbers are what they have to be.
EXTREMES = """Object.keys(SHAPES).concat("record").flatMap(shape => CHOICES.eq.flatMap(eq =>
  CHOICES.cap.flatMap(cap => Object.keys(FIELDS).flatMap(key => ["least", "most"].flatMap(end => {
    const each = {...DEFAULTS, shape, eq, cap, record: "el_centro_1940_NS"};
    each[key] = FIELDS[key][end];
    if (contradiction(each)) return [];
    const {times, ground, displacement, structures} = histories(each, fileOf(each));
    const isSound = [times, ground, displacement].every(all => all.every(Number.isFinite))
      && structures.every(of => Number.isNaN(of.peak) === of.overturned
        && of.theta.every((theta, k) => Number.isFinite(theta) || times[k] > of.flatAt)
        && !(of.moved && eq === "exact" && Number.isNaN(of.friction)));
    return [[shape, eq, cap, key, end, isSound]];
  })))))"""


def test_histories_are_finite_at_both_ends_of_every_field(browser):
    browser.open_once()
    rows = browser.do(EXTREMES)
    assert len(rows) > 400
    assert [row for row in rows if not row[-1]] == []
