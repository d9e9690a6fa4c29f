"""The page as its users meet it: network, keyboard, contrast, sizes, bad input, speed."""

import json
import re
from pathlib import Path
from statistics import median

import pytest

from replication.inputs.strict_yaml import read_yaml
from steps.explorer import checked_cases, page
from tests.records.files import MOST

WIDTHS = (390, 820, 1440)
LONGEST = 16.0  # ms, of a handler on the main thread

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

DRAG = """new Promise(resolve => {
  performance.clearMeasures();
  const slider = document.getElementById({0});
  let count = 0;
  const move = () => {
    slider.value = 300 + (count * 37) % 400;
    slider.dispatchEvent(new Event("input", {bubbles: true}));
    if (++count < 90) requestAnimationFrame(move);
    else setTimeout(() => resolve(performance.getEntriesByType("measure").map(
      entry => [entry.name, entry.duration])), 500);
  };
  requestAnimationFrame(move);
})"""

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


def test_nothing_is_asked_of_the_network_and_nothing_fails(browser):
    for address in (
        "shape=record&record=el_centro_1940_NS&x=2",
        "shape=harmonic&start=abrupt",
        "g=1",
    ):
        browser.open(address, moves=True, until="spectrum" if address == "g=1" else "minima")
        browser.do("new Promise(resolve => setTimeout(resolve, 300))")
        assert browser.tab.requests == []
        assert browser.tab.errors == []


def test_network_is_refused_by_the_page_itself(browser):
    browser.open()
    script = "fetch('https://example.org/').then(() => 'sent', error => error.name)"
    assert browser.do(script) == "TypeError"
    assert any("Content Security Policy" in told for told in browser.tab.errors)
    assert browser.tab.requests == []


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


def test_space_pauses_and_arrows_move_a_slider(browser):
    browser.open()
    browser.do("pause(), show(1), document.activeElement.blur()")

    def press(key, code):
        browser.ask("Input.dispatchKeyEvent", type="keyDown", key=key, code=code, text=key)
        browser.ask("Input.dispatchKeyEvent", type="keyUp", key=key, code=code)

    press(".", "Period")
    assert browser.do("time") == pytest.approx(1.02)
    press(" ", "Space")
    assert browser.do("isPlaying") is True
    press(" ", "Space")
    assert browser.do("isPlaying") is False
    before = browser.do("document.getElementById('a').value")
    browser.do("document.getElementById('a-slider').focus()")
    browser.ask(
        "Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowRight", windowsVirtualKeyCode=39
    )
    assert browser.do("document.getElementById('a').value") != before


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


def test_phone_shows_the_outcome_beside_every_field(browser):
    browser.open("shape=harmonic&r=0.9", width=390, height=844, until="minima")
    box = "document.getElementById({0}).getBoundingClientRect()"
    playback = [browser.do(f"{box}.top", name) for name in ("start", "speed")]
    assert playback[0] == pytest.approx(playback[1], abs=2)
    for name in ("b", "g", "a", "D"):
        browser.do("document.getElementById({0}).scrollIntoView()", name)
        assert browser.do(f"{box}.top", "verdict") == pytest.approx(0, abs=1)
        assert browser.do(f"{box}.top", name) >= browser.do(f"{box}.bottom", "verdict")


def test_tablet_keeps_the_mass_ratio_beside_the_map_that_it_moves(browser):
    browser.open(width=1024, height=768, until="minima")
    browser.do("document.getElementById('map').scrollIntoView({block: 'end'})")
    box = "document.getElementById({0}).getBoundingClientRect()"
    assert browser.do(f"{box}.top", "g-field") >= 0
    assert max(browser.do(f"{box}.bottom", name) for name in ("g-field", "map")) <= 769


def test_laptop_shows_everything_on_one_screen(browser):
    browser.open(width=1440, height=900, until="minima")
    assert browser.do("document.body.getBoundingClientRect().bottom") <= 900


@pytest.mark.parametrize("address", ["g=1", "shape=record&record=el_centro_1940_NS&x=2"])
def test_handlers_are_short_while_a_slider_is_dragged(browser, address):
    browser.open(address, moves=True, until="minima")
    rounds = []
    for _ in range(5):  # other work of this machine can lengthen a round, and never shortens one
        found = browser.do(DRAG, "h-slider")
        of = {
            kind: sorted(duration for name, duration in found if name == kind)
            for kind in ("handler", "frame", "drawing")
        }
        assert len(of["handler"]) == 90
        assert min(map(len, of.values())) > 3
        # The longest twentieth is left out: it is when the machine gave the time to another.
        rounds.append((of["handler"][85], median(of["frame"]), median(of["drawing"])))
        if max(rounds[-1]) < LONGEST:
            return
    assert min(map(max, rounds)) < LONGEST, rounds


BAD_INPUT = [
    ("L", "0.9", "the columns would touch; expected a span above their width, 1 m"),
    ("b", "wide", "“wide” is not a number; expected 0.001 to 1000 m"),
    ("g", "-1", "-1 is out of range; expected 0 to ∞"),
    ("T", "0", "0 is out of range; expected 0.01 to 100 s"),
    ("b", "4", "√r of the frame is"),
    ("h", " ", "the field is empty; expected 0.001 to 1000 m"),
]


def test_bad_input_is_told_at_its_field_and_the_picture_stays(browser):
    browser.open("L=9")
    shown = """[encode(state), document.getElementById("verdict").textContent,
      document.getElementById("scene").innerHTML.length]"""
    for field, typed, said in BAD_INPUT:
        state, verdict, bodies = browser.do(shown)
        assert said in browser.do(TYPE, field, typed)
        browser.do("new Promise(resolve => setTimeout(resolve, 400))")
        after = browser.do(shown)
        assert after[:2] == [state, verdict]
        assert abs(after[2] - bodies) < 500
        invalid = "document.getElementById({0}).getAttribute('aria-invalid')"
        assert browser.do(invalid, field) == "true"
        good = browser.do("shown(state[{0}] * 1.01)", field)
        assert browser.do(TYPE, field, good) == ""
        assert state_of(browser) != state
        browser.settle()


@pytest.mark.parametrize(
    ("first", "second"), [(("h", "0.15"), ("b", "0.05")), (("b", "2"), ("L", "4.5"))]
)
def test_first_of_two_fields_that_contradict_waits_for_the_second(browser, first, second):
    browser.open("L=3.9")
    before = state_of(browser)
    browser.do(TYPE, *first)
    assert state_of(browser) == before
    assert browser.do(TYPE, *second) == ""
    assert {f"{key}={number}" for key, number in (first, second)} <= set(
        state_of(browser).split("&")
    )
    browser.do(TYPE, *first)
    browser.do(TYPE, "a", "0.2")
    assert "a=0.2" in state_of(browser)


def test_shape_that_contradicts_is_told_where_it_is_seen(browser):
    browser.open("T=0.01&a=0.2")
    browser.do("controls.apply({shape: 'harmonic'}, true, 'shape')")
    shown = "document.getElementById('shape-error')"
    assert "more than 400 periods" in browser.do(
        f"{shown}.checkVisibility() && {shown}.textContent"
    )
    browser.do(TYPE, "T", "0.1")
    assert "shape=harmonic" in state_of(browser)


def test_address_holds_the_state(browser):
    given = "b=0.4&h=2.4&g=inf&L=4&r=0.9&cap=fixed&eq=linearised&shape=one-sine&a=0.55&T=0.9"
    browser.open(given)
    assert state_of(browser) == given
    assert browser.do("location.hash") == f"#{given}"
    assert browser.do("document.getElementById('g').value") == "∞"
    browser.do("location.hash = 'shape=one-sine&a=0.2'")
    browser.settle()
    assert "a=0.2" in state_of(browser)


def test_bad_address_is_told_at_its_fields(browser):
    browser.open("b=x&shape=square&record=gone&h=2")
    errors = "['b', 'shape'].map(key => document.getElementById(`${key}-error`).textContent)"
    b, shape = browser.do(errors)
    assert b.startswith("The address: “x” is not a number")
    assert "“square” is not known; expected one-sine" in shape
    assert "h=2&" in state_of(browser)
    browser.open("shape=record&record=gone")
    assert "the record “gone” is not in this page" in browser.do(errors)[1]


def square(peak, period=25, number=150, step=0.02):
    """A file of a record that changes its sign after each half period of so many samples."""
    rows = (f"{k * step:.3f},{peak * (-1) ** (k // period)}\n" for k in range(number))
    return "time (s),acceleration (g)\n" + "".join(rows)


def test_record_is_dropped_in_and_a_bad_one_is_refused(browser):
    browser.open()
    assert browser.drop("mine.csv", square(0.4)) == ""
    browser.settle()
    after = state_of(browser)
    assert "shape=record&x=1&record=mine" in after.replace("&start=smooth", "")
    assert browser.do("found.peak") == pytest.approx(0.4)
    assert "line 1 is" in browser.drop("bad.csv", "t,a\n1,2\n")
    assert state_of(browser) == after
    assert browser.tab.requests == []


def test_record_of_the_address_is_opened_with_its_factor(browser):
    browser.open("shape=record&record=mine&x=3")
    browser.drop("mine.csv", square(0.1))
    browser.settle("minima")
    assert browser.do("found.peak") == pytest.approx(0.3)
    assert '("data/records/mine.csv")' in browser.do(
        "document.getElementById('python').textContent"
    )


def test_file_of_the_same_name_and_length_is_another_record(browser):
    browser.open()
    spectra = []
    for period in (20, 60):
        browser.drop("mine.csv", square(0.4, period))
        browser.settle("spectrum")
        spectra.append(browser.do(CODES))
    assert spectra[0] != spectra[1]


def test_long_record_is_shown(browser):
    browser.open(until=None)
    assert browser.drop("long.csv", square(0.4, 500, 300_000, 0.001)) == ""
    browser.do(
        """(async () => {
          for (let k = 0; !document.documentElement.dataset.shown?.includes("record=long"); ++k)
            await new Promise((next, fail) => (k < 1200 ? setTimeout(next, 50) : fail()));
        })()"""
    )
    assert browser.do("files.get('long').samples.size") == 8 * 300_000
    assert browser.do("MOST_STEPS") >= 2 * MOST  # of records: a step each, and as many for impacts
    assert browser.do("found.peak") == pytest.approx(0.4)
    assert browser.tab.errors == []
    browser.do("slow?.terminate()")  # its spectrum would take minutes


def test_back_returns_to_what_a_case_replaced(browser):
    browser.open("b=0.4&a=0.25")
    before = state_of(browser)
    browser.do("document.querySelector('#cases button').click()")
    browser.settle()
    browser.do("new Promise(resolve => setTimeout(resolve, 400))")
    assert state_of(browser) != before
    browser.do("history.back()")
    browser.do("new Promise(resolve => setTimeout(resolve, 400))")
    assert state_of(browser) == before


# What a change of the state leaves in the spectrum: the colours of its cells in the next picture.
CELLS_AFTER = """(async () => {
  {0};
  await new Promise(requestAnimationFrame);
  const {ctx, bbox} = spectrumChart.chart, {data} = ctx.getImageData(
    Math.round(bbox.left), Math.round(bbox.top), Math.round(bbox.width), Math.round(bbox.height));
  const seen = new Set();
  for (let k = 0; k < data.length; k += 4) seen.add([...data.subarray(k, k + 3)].join());
  const probe = document.createElement("canvas").getContext("2d");
  return ["prevented", "caused", "both"].filter(name => {
    probe.fillStyle = colour(name);
    probe.fillRect(0, 0, 1, 1);
    return seen.has([...probe.getImageData(0, 0, 1, 1).data.subarray(0, 3)].join());
  });
})()"""
RECORD = "change({shape: 'record', record: 'el_centro_1940_NS', x: 2}, true)"
CODES = "[spectrumChart.cells.columns, spectrumChart.cells.rows, ...spectrumChart.cells.codes]"


@pytest.mark.parametrize(
    "edit", [RECORD, "change({shape: 'one-sine'}, true)", "change({b: 0.7}, true)"]
)
def test_spectrum_of_another_plane_is_taken_away_at_once(browser, edit):
    browser.open(until="spectrum")
    assert len(browser.do(CELLS_AFTER.replace("{0}", "null"))) == 3
    assert browser.do(CELLS_AFTER.replace("{0}", edit)) == []
    browser.settle("spectrum")
    shown, address = browser.do(CODES), state_of(browser)
    browser.open(address, until="spectrum")
    assert browser.do(CODES) == shown


@pytest.mark.parametrize("edit", ["{a: 0.4, T: 2}", "{g: 2}"])
def test_spectrum_of_the_same_plane_stays(browser, edit):
    browser.open(until="spectrum")
    assert browser.do(CELLS_AFTER.replace("{0}", f"change({edit}, true)")) != []


def test_map_follows_the_mass_while_it_is_dragged(browser):
    browser.open(until="spectrum")
    before = browser.do(CODES)
    browser.do("change({g: 4}, false), clearTimeout(rested)")  # no survey
    browser.do("new Promise(next => setTimeout(next, 1000))")
    assert before != (sketched := browser.do(CODES))
    browser.do("settle()")
    browser.settle("spectrum")
    whole = browser.do(CODES)
    assert 0.95 < sum(map(int.__eq__, sketched, whole)) / len(whole) < 1.0


def test_boundary_encloses_the_cells_of_a_structure(browser):
    browser.open_to_compute()
    segments = browser.do("boundary(Uint8Array.of(0, 0, 0, 0, 3, 1, 0, 0, 0), 3, 3, 2)")
    ends = sorted(tuple(end) for segment in segments for end in segment)
    assert ends == sorted(2 * [(1, 1.5), (2, 1.5), (1.5, 1), (1.5, 2)])


@pytest.mark.parametrize(
    ("fields", "gamma"), [({"beam": "3", "each": "2"}, 0.75), ({"g": "1/4"}, 0.25)]
)
def test_mass_ratio_is_given_by_masses_or_a_fraction(browser, fields, gamma):
    browser.open()
    for name, text in fields.items():
        browser.do(TYPE.replace('{0} + "-error"', '"g-error"'), name, text)
    shown = [
        browser.do("typed(document.getElementById({0}).value)", n) for n in ("g", "beam", "each")
    ]
    assert browser.do("state.g") == gamma == shown[0] == shown[1] / (2 * shown[2])
    assert "γ" in browser.do(TYPE.replace('{0} + "-error"', '"g-error"'), "each", "0")
    assert browser.do("state.g") == gamma


def test_nothing_runs_that_the_page_was_not_made_with(browser, text):
    (stated,) = re.findall(r'Content-Security-Policy" content="([^"]*)"', text)
    assert "unsafe" not in stated
    assert "base-uri 'none'; form-action 'none'" in stated
    browser.open()
    added = "Object.assign(document.createElement('script'), {textContent: 'window.planted = 1'})"
    browser.do(f"document.body.append({added})")
    browser.do("new Promise(next => setTimeout(next, 100))")
    assert browser.do("window.planted ?? null") is None
    browser.tab.errors.clear()  # that it was refused


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


ON_SCREEN = """(() => {
  const places = ["g-slider", "spectrum"].map(id => document.getElementById(id));
  scrollTo(0, scrollY + places[1].getBoundingClientRect().bottom - innerHeight);
  return places.map(place => place.getBoundingClientRect()).map(({top, bottom}) =>
    top >= 0 && bottom <= innerHeight + 1);
})()"""


@pytest.mark.parametrize(("width", "height"), [(390, 844), (820, 1180), (1440, 900)])
def test_mass_ratio_and_the_map_that_it_moves_are_on_one_screen(browser, width, height):
    browser.open(width=width, height=height)
    assert browser.do(ON_SCREEN) == [True, True]


OUTSIDE = """(() => {
  const at = element => element.getBoundingClientRect(), frame = at(scene.svg);
  const boxes = scene.groups.map(at);
  const isApart = (a, b) => a.right <= b.left || b.right <= a.left
    || a.bottom <= b.top || b.bottom <= a.top;
  return boxes.flatMap((box, k) => [
    ...(box.left < frame.left || box.right > frame.right || box.top < frame.top ? [[k]] : []),
    ...boxes.slice(k + 1).flatMap((other, l) => (isApart(box, other) ? [] : [[k, k + 1 + l]])),
  ]);
})()"""


@pytest.mark.parametrize("address", ["g=1", "g=2&a=1.11", "cap=fixed&a=4", "g=0.2&a=0.6&L=1.2"])
def test_no_body_leaves_the_picture_or_meets_another(browser, address):
    browser.open(address)
    for width in WIDTHS:
        browser.resize(width)
        browser.do("new Promise(next => setTimeout(next, 200))")
        for share in range(21):
            browser.do(f"show({share / 20} * found.times.at(-1))")
            assert browser.do(OUTSIDE) == [], (width, share)


def test_spectrum_that_was_interrupted_is_completed(browser):
    browser.open(until="spectrum")
    whole = browser.do(CODES)
    browser.do("spectrumChart.cells.codes.fill(1), spectrumChart.cells.isWhole = false")
    browser.do("change({a: 0.4}, true)")
    browser.settle("spectrum")
    assert browser.do(CODES) == whole


def test_late_answer_to_another_state_is_not_shown(browser):
    browser.open()
    before, after = browser.do(
        """(async () => {
          const late = survey, shown = () => [
            spectrumChart.cells?.columns, spectrumChart.cells?.codes.every(code => code === 3),
            document.getElementById("numbers").innerHTML,
            document.getElementById("shape-error").textContent];
          change({shape: "record", record: "el_centro_1940_NS", x: 2}, true);
          await new Promise(requestAnimationFrame);
          const before = shown();
          [{codes: new Uint8Array(96 * 64).fill(3), columns: 96, rows: 64, share: 1},
            {index: 0, minimum: 1}, {index: 0, isSensitive: true}, {error: "late"}].forEach(
            each => hear({data: {id: late, ...each}}));
          return [before, shown()];
        })()"""
    )
    assert before == after


def test_histories_are_those_of_the_state_that_was_asked_about(browser):
    browser.open()
    before = state_of(browser)
    shown, title = browser.do(
        """(() => {
          const late = {...found, id: encode(state)};
          change({cap: "fixed"}, true);
          quick.worker.onmessage({data: late});
          const {dataset} = document.documentElement;
          return [dataset.shown, document.getElementById("caption2").textContent];
        })()"""
    )
    assert shown == before != state_of(browser)
    assert "carried freely" in title


def test_quick_edits_end_without_error_in_the_spectrum_of_the_last(browser):
    for delay in (150, 250, 300, 350, 450):
        browser.open(until=None)
        browser.do(TYPE, "b", "0.6")
        browser.do("new Promise(resolve => setTimeout(resolve, {0}))", delay)
        browser.do(RECORD)
        browser.do("new Promise(next => requestAnimationFrame(() => setTimeout(next, 240)))")
        assert browser.tab.errors == []
        assert browser.do("spectrumChart.cells?.columns ?? 48") == 48
        found = browser.do(
            """(async () => {
              for (let k = 0; k < 600 && !spectrumChart.cells; ++k)
                await new Promise(next => setTimeout(next, 50));
              return spectrumChart.cells.codes.length;
            })()"""
        )
        assert (found, browser.tab.errors) == (48 * 36, [])


def test_press_in_the_spectrum_goes_there(browser):
    browser.open()
    place = browser.do(
        """(() => {
          const box = spectrumChart.chart.over.getBoundingClientRect();
          return [box.left + box.width / 2, box.top + box.height / 2];
        })()"""
    )
    for kind in ("mousePressed", "mouseReleased"):
        browser.ask(
            "Input.dispatchMouseEvent",
            type=kind,
            x=place[0],
            y=place[1],
            button="left",
            clickCount=1,
        )
    browser.settle()
    here = browser.do("planeOf(state).here")
    assert here["x"] == pytest.approx(4.25, rel=0.01)
    assert here["y"] == pytest.approx((0.93 * 12.0) ** 0.5, rel=0.02)


def test_structures_meet_and_none_is_in_the_ground(browser):
    """The cap beam rests on its columns at every rotation, and nothing that falls sinks in."""
    browser.open("b=0.6&h=3&g=1&L=5&a=0.9")
    browser.do("pause()")
    scale = browser.do(
        "scene.svg.getBoundingClientRect().height / scene.svg.viewBox.baseVal.height"
    )
    for angle in (-1.5, -0.6, -0.1, 0.0, 0.15, 0.7, 1.5):
        browser.do("scene.pose([{0}, {0}, {0}], 0, 0)", angle)
        boxes = browser.do(
            """[...document.querySelectorAll("#scene .column, #scene .cap")].map(each => {
              const {top, bottom} = each.getBoundingClientRect();
              return [each.getAttribute("class"), top, bottom];
            })"""
        )
        ground = browser.do("document.querySelector('.surface').getBoundingClientRect().bottom")
        assert max(bottom for _, _, bottom in boxes) <= ground + 0.1 * scale + 2
        cap, columns = boxes[-1], boxes[-3:-1]
        assert cap[0] == "cap"
        assert columns[0][1] == pytest.approx(columns[1][1], abs=0.5)
        assert cap[2] == pytest.approx(columns[0][1], abs=2.5)


def test_data_of_the_page_are_those_of_its_sources(text, records):
    data = json.loads(text.split('id="data">')[1].split("</script>")[0])
    (record,) = data["records"]
    assert record["samples"] == records["el_centro_1940_NS"].acceleration.tolist()
    assert len(data["cases"]) == 6


def test_page_names_paper_version_and_licence(browser):
    cited = read_yaml(Path(__file__).parents[2] / "CITATION.cff")
    browser.open_to_compute()
    said, links = browser.do(
        """[document.querySelector("footer").textContent.replace(/\\s+/g, " "),
        [...document.querySelectorAll("footer a")].map(each => each.getAttribute("href"))]"""
    )
    doi = cited["references"][0]["doi"]
    assert f"doi:{doi}" in said
    assert f"topheavy {cited['version']}: article" in said
    assert said.endswith("MIT licence; text CC BY 4.0.")
    assert links[0] == f"https://doi.org/{doi}"


@pytest.mark.parametrize(("typed", "kept"), [("43%", 1.0), ("4 apples", 1.0), ("2.5", 2.5)])
def test_invalid_entry_keeps_the_last_valid_number(browser, typed, kept):
    """Each letter is an entry: 43 % was γ = 43 before its last one."""
    browser.open_to_compute()
    browser.begin({"g": 1.0})
    browser.do("document.getElementById('g').focus()")
    browser.do("document.getElementById('g').select()")
    for letter in typed:
        browser.ask("Input.insertText", text=letter)
    text, error = browser.do("[g.value, document.getElementById('g-error').textContent]")
    assert browser.do("state.g") == kept
    assert text == typed
    assert (f"; {kept:g} is kept" in error) == (typed != "2.5")


def test_of_several_dropped_files_those_that_are_not_read_are_named(browser):
    browser.open_to_compute()
    told = browser.do(
        """new Promise(resolve => {
          const data = new DataTransfer();
          for (const name of ["one.csv", "two.csv", "three.csv"]) data.items.add(new File(
            ["time (s),acceleration (g)\\n0.00,0\\n0.01,0.1\\n0.02,0\\n"], name));
          dispatchEvent(new DragEvent("drop", {dataTransfer: data, cancelable: true}));
          const look = () => document.getElementById("record-error").textContent
            ? resolve(document.getElementById("record-error").textContent) : setTimeout(look, 20);
          look();
        })"""
    )
    assert told == "one.csv was read; not two.csv, three.csv: drop one file at a time"
    assert browser.do("state.record") == "one"
