"""The state of the page: records, the spectrum of a plane, and answers that come late."""

import time

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
    assert browser.requests == []


def test_record_of_the_address_is_opened_with_its_factor(browser):
    browser.open("shape=record&record=mine&x=3")
    browser.drop("mine.csv", square(0.1))
    browser.settle("minima")
    assert browser.do("found.peak") == pytest.approx(0.3)
    assert '("data/records/mine.csv")' in browser.do(
        "document.getElementById('python').textContent"
    )


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
    assert browser.errors == []
    browser.do("slow?.terminate()")  # its spectrum would take minutes


def test_back_returns_to_what_a_case_replaced(browser):
    browser.open("b=0.4&a=0.25")
    before = state_of(browser)
    browser.do("document.querySelector('#cases button').click()")
    browser.settle()
    wait_until(lambda: browser.do("location.hash.slice(1)") == state_of(browser) != before)
    browser.do("history.back()")
    wait_until(lambda: state_of(browser) == before)


def wait_until(holds, seconds=60):
    """Wait for what the page does by itself, however slow the machine is."""
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.1)


CODES = "[spectrumChart.cells.columns, spectrumChart.cells.rows, ...spectrumChart.cells.codes]"


def test_map_follows_the_mass_while_it_is_dragged(browser):
    browser.open(until="spectrum")
    before = browser.do(CODES)
    browser.do("change({g: 4}, false), clearTimeout(rested)")  # no survey
    wait_until(lambda: browser.do(CODES) != before)
    sketched = browser.do(CODES)
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
