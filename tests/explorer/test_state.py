"""The state of the page: records, the spectrum of a plane, and answers that come late."""

import pytest

from tests.explorer.test_page import TYPE, state_of
from tests.ground.records.files import MOST


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


@pytest.mark.parametrize("edit", ["change({shape: 'one-sine'}, true)", "change({b: 0.7}, true)"])
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
    for delay in (150, 300, 450):
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
