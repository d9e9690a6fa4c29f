"""The page as its users meet it: network, keyboard, contrast, sizes, bad input, speed."""

import json
import re

import pytest

from steps.explorer import checked_cases, page, titles
from topheavy.ground.shapes import SHAPES

WIDTHS = (390, 820, 1440)

# Every element with words of its own that is displayed: its words and its two colours.
WORDS = """[...document.querySelectorAll("body *")].flatMap(element => {
  const own = [...element.childNodes].some(node => node.nodeType === 3 && node.textContent.trim());
  const field = element.matches("input[type=text], select");
  if (!(own || field) || element.closest("svg, script, style, .hidden, optgroup")) return [];
  if (!element.checkVisibility() || !element.getClientRects().length) return [];
  const style = getComputedStyle(element);
  let behind = element;
  while (behind && /rgba\\(.*, 0\\)|transparent/.test(getComputedStyle(behind).backgroundColor))
    behind = behind.parentElement;
  const paper = getComputedStyle(behind ?? document.documentElement).backgroundColor;
  return [[element.textContent.trim().slice(0, 40), style.color, paper]];
})"""

PRESSABLE = """[...document.querySelectorAll(
  "button, input:not([type=radio]), input[type=radio]:checked, select, summary, pre, .scroll")]
  .filter(element => element.checkVisibility() && !element.hidden)
  .map(element => element.id || element.textContent.trim().slice(0, 20) || element.className)"""

FOCUSED = """(() => {
  const at = document.activeElement, style = getComputedStyle(at);
  return [at.id || at.textContent.trim().slice(0, 20) || at.className,
    at === document.body, style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2];
})()"""


TYPE = """(() => {
  const field = document.getElementById({0});
  field.value = {1};
  field.dispatchEvent(new Event("input", {bubbles: true}));
  return document.getElementById({0} + "-error").textContent;
})()"""


MINIMA = "[0, 1, 2].map(k => document.getElementById(`minimum${k}`).textContent)"


def brightness(colour):
    """Relative luminance of a CSS colour (WCAG 2.2)."""
    parts = [float(part) / 255.0 for part in re.findall(r"[\d.]+", colour)[:3]]
    linear = [
        part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts
    ]
    return sum(w * part for w, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one, other):
    low, high = sorted((brightness(one), brightness(other)))
    return (high + 0.05) / (low + 0.05)


def state_of(browser):
    return browser.do("encode(state)")


def test_same_bytes_twice(text, records, request):
    assert page(request.config.rootpath / "src/explorer", records) == text
    assert text.encode() == text.encode("utf-8")
    assert "{{" not in re.sub(r"\$\{\{", "", text.split("<script>")[0])


def test_promise_that_the_library_does_not_keep_stops_the_build():
    state = {"b": 0.5, "h": 3.0, "g": 1.0, "L": 5.0, "shape": "one-cosine", "a": 0.31, "T": 1.5}
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


def test_nothing_is_asked_of_the_network_and_nothing_fails(browser):
    for address in (
        "shape=record&record=el_centro_1940_NS&x=2",
        "shape=harmonic&start=abrupt",
        "g=1",
    ):
        browser.open(address, moves=True, until="spectrum" if address == "g=1" else "minima")
        browser.do("new Promise(resolve => setTimeout(resolve, 300))")
        assert browser.requests == []
        assert browser.errors == []


@pytest.mark.parametrize("address", ["g=1", "shape=harmonic&r=0.9"])
def test_every_control_is_reached_by_the_keyboard_and_shows_it(browser, address):
    browser.open(address)
    browser.do("document.querySelectorAll('details').forEach(each => each.open = true)")
    expected = set(browser.do(PRESSABLE))
    assert len(expected) > 20
    browser.do("document.activeElement.blur(), window.focus()")
    reached = {}
    for _ in range(80):
        for kind in ("rawKeyDown", "keyUp"):
            browser.ask(
                "Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab", windowsVirtualKeyCode=9
            )
        name, at_end, is_outlined = browser.do(FOCUSED)
        if at_end:
            break
        reached[name] = is_outlined
    assert expected - set(reached) == set()
    assert [name for name, is_outlined in reached.items() if not is_outlined] == []


def test_every_control_has_a_name(browser):
    browser.open("shape=harmonic&r=0.9")
    browser.ask("Accessibility.enable")
    nodes = browser.ask("Accessibility.getFullAXTree")["nodes"]
    browser.ask("Accessibility.disable")
    roles = {"button", "slider", "textbox", "combobox", "radio", "DisclosureTriangle", "image"}
    controls = [node for node in nodes if node["role"]["value"] in roles and not node["ignored"]]
    assert len(controls) > 25
    unnamed = [node["role"] for node in controls if not node["name"].get("value", "").strip()]
    assert unnamed == []


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_words_have_the_contrast_of_wcag_aa(browser, dark):
    browser.open(dark=dark, until="minima")
    browser.do("document.querySelectorAll('details').forEach(each => each.open = true)")
    browser.do(TYPE, "b", "wide")
    found = browser.do(WORDS)
    assert len(found) > 60
    poor = [
        (words, colour, paper, round(contrast(colour, paper), 2))
        for words, colour, paper in found
        if contrast(colour, paper) < 4.5
    ]
    assert poor == []
    tokens = browser.do(
        "['quiet', 'ink', 'overturns', 'survives', 'paper', 'band', 'line'].map(colour)"
    )
    rgb = [
        "rgb({}, {}, {})".format(*(int(token[k : k + 2], 16) for k in (1, 3, 5)))
        for token in tokens
    ]
    quiet, ink, overturns, survives, paper, band, _ = rgb
    assert min(contrast(one, paper) for one in (quiet, ink)) >= 4.5  # words of the charts
    assert (
        min(contrast(one, other) for one in (overturns, survives) for other in (paper, band)) >= 3
    )


def test_nothing_is_wider_than_the_screen(browser):
    beyond = """[...document.querySelectorAll("button, input, select, svg, .chart, p")].filter(
      element => element.checkVisibility() && !element.closest("nav") && !element.closest(".hidden")
      && element.getBoundingClientRect().right > innerWidth + 1).map(element => element.id)"""
    browser.open("shape=harmonic&r=0.9", width=WIDTHS[0], height=844, until="minima")
    numbers = browser.do(MINIMA)
    assert "…" not in numbers
    for width in WIDTHS:
        browser.resize(width)
        browser.do("new Promise(next => setTimeout(next, 200))")
        assert browser.do("document.documentElement.scrollWidth") <= width
        assert browser.do(beyond) == []
    assert browser.do(MINIMA) == numbers


def test_tablet_keeps_the_mass_ratio_beside_the_map_that_it_moves(browser):
    browser.open(width=1024, height=768, until="minima")
    browser.do("document.getElementById('map').scrollIntoView({block: 'end'})")
    box = "document.getElementById({0}).getBoundingClientRect()"
    assert browser.do(f"{box}.top", "g-field") >= 0
    assert max(browser.do(f"{box}.bottom", name) for name in ("g-field", "map")) <= 769


def test_laptop_shows_everything_on_one_screen(browser):
    browser.open(width=1440, height=900, until="minima")
    assert browser.do("document.body.getBoundingClientRect().bottom") <= 900


def test_address_holds_the_state(browser):
    given = "b=0.4&h=2.4&g=inf&L=4&r=0.9&cap=fixed&eq=linearised&shape=one-sine&a=0.55&T=0.9"
    browser.open(given)
    assert state_of(browser) == given
    assert browser.do("location.hash") == f"#{given}"
    assert browser.do("document.getElementById('g').value") == "∞"
    browser.do("location.hash = 'shape=one-sine&a=0.2'")
    browser.settle()
    assert "a=0.2" in state_of(browser)


def test_data_of_the_page_are_those_of_its_sources(text, records):
    data = json.loads(text.split('id="data">')[1].split("</script>")[0])
    (record,) = data["records"]
    assert record["samples"] == records["el_centro_1940_NS"].acceleration.tolist()
    assert len(data["cases"]) == 6


def test_nothing_runs_that_the_page_was_not_made_with(browser, text):
    (stated,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    assert "unsafe" not in stated
    assert "base-uri 'none'; form-action 'none'" in stated
    browser.open()
    added = "Object.assign(document.createElement('script'), {textContent: 'window.planted = 1'})"
    browser.do(f"document.body.append({added})")
    browser.do("new Promise(next => setTimeout(next, 100))")
    assert browser.do("window.planted ?? null") is None


def test_first_visit_asks_for_a_guess_and_then_shows(browser):
    browser.open(until=None)
    browser.do("localStorage.clear()")
    browser.load("")
    browser.settle("minima")
    ids = ["verdict", "history0", "spectrum", "cases", "controls"]
    is_seen = f"{ids}.map(id => byId(id).checkVisibility({{visibilityProperty: true}}))"
    assert browser.do(is_seen) == [False] * 5
    browser.do("document.querySelector('#guess button').click()")
    browser.do("new Promise(next => setTimeout(next, 300))")
    minima = [browser.do(f"minima[{k}].toFixed(3)") for k in range(3)]
    told = browser.do("document.getElementById('answer').textContent")
    first, second, third = sorted(zip(minima, ("column", "vase", "frame"), strict=True))
    order = ", ".join(f"the {name} from {a} g" for a, name in (second, third))
    assert told.startswith(f"No: the {first[1]} overturns from {first[0]} g, {order}.")
    assert browser.do(is_seen) == [True] * 5
    browser.do("history.replaceState(null, '', location.pathname)")
    browser.load("")
    assert browser.do("document.getElementById('guess').hidden") is True
