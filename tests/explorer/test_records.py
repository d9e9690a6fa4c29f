"""Records that are opened or dropped: what is read, refused and doubted, and what is shown then."""

import ast

import pytest

from tests.ground import test_reading as library
from topheavy import read_record


def read(browser, name, content):
    """What the page reads of a file: step, samples and doubts, or the message that refuses it."""
    return browser.do(
        """(() => {
          try {
            const {step, samples, doubt} = readRecord({0}, Uint8Array.from({1}));
            return [step, [...samples], doubt];
          } catch (error) {
            return error.message;
          }
        })()""",
        name,
        list(content if isinstance(content, bytes) else content.encode()),
    )


def test_record_of_the_page_is_read_as_by_the_library(browser, records, request):
    browser.open_once()
    path = request.config.rootpath / "data/records/el_centro_1940_NS.AT2"
    step, samples, doubt = read(browser, path.name, path.read_bytes())
    assert (step, samples) == (0.02, records[path.stem].acceleration.tolist())
    assert doubt == ""


def test_implausible_motion_is_doubted(browser, square):
    browser.open_once()
    for content, doubt in (
        (square(0.3), ""),
        (square(0.3).replace(",-", ","), "no sample changes sign"),
        (square(0.3).replace(",-0.3", ",-0.1"), "is its baseline not corrected"),
        (square(2.5), "its velocity reaches"),
        (square(2.5), "its peak is 2.5 g"),
        (square(0.004), "few peaks of interest are below 0.005 g"),
        (square(0.1).replace(",0.1", ",0.9", 1), "sample 1 of "),
    ):
        answer = read(browser, "motion.csv", content)
        assert isinstance(answer, list), answer
        assert (doubt in answer[2]) if doubt else answer[2] == ""


@pytest.mark.filterwarnings("ignore::UserWarning")
def test_page_and_library_take_and_refuse_the_same_files(browser, tmp_path):
    browser.open_once()
    units = [library.AT2.replace(library.IN_G, header) for header in library.IN_GAL]
    refused = [text for text, _ in library.REFUSED]
    named = [(library.name_of(text), text) for text in [*units, *refused]]
    for name, content in [*library.FILES, *named]:
        path = tmp_path / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        shown = read(browser, name, content)
        try:
            record = read_record(path)
        except ValueError:
            assert shown.startswith(f"{name}: "), content
        else:
            assert shown[0] == pytest.approx(record.time_step, rel=1e-12), content
            assert shown[1] == pytest.approx(record.acceleration, abs=1e-12), content
        assert isinstance(shown, str) == (content in refused)
    longer = library.AT2.replace("NPTS= 400", "NPTS= 401")
    assert "NPTS is 401, and only 400 values follow" in read(browser, "a.AT2", longer)
    assert "whose name ends in .AT2 or .csv" in read(browser, "a.txt", library.CSV)


# In the page -------------------------------------------------------------------------------------


def test_dropped_record_is_shown_and_a_bad_one_is_refused(browser, square):
    browser.open("shape=record&record=mine&x=3")
    message = "document.getElementById('shape-error').textContent"
    assert "the record “mine” is not in this page" in browser.do(message)
    assert browser.drop("mine.csv", square(0.1)) == ""
    browser.settle("map")
    assert browser.do("[state.record, found.peak]") == ["mine", pytest.approx(0.3)]
    assert browser.do("spectrumChart.cells.codes.some(Boolean)")
    after = browser.do("encode(state)")
    assert "no line names columns" in browser.drop("bad.csv", "t,a\n1,2\n")
    assert browser.do("encode(state)") == after
    shifted = browser.drop("mine.csv", square(0.3).replace(",-0.3", ",-0.1"))
    assert "mine.csv was read, but its velocity at the end is" in shifted
    browser.wait("found.peak > 0.8")  # another file of the same name, at the same factor
    assert browser.do("Math.min(...found.ground)") == pytest.approx(-0.3)
    assert browser.requests == browser.errors == []


def test_name_of_a_record_is_only_ever_a_text(browser, square):
    name = "<img src=x onerror=alert(1)>\"quoted\" 'twice' \\ %41+#=&:\u2028__proto__"
    browser.open()
    assert browser.drop(f"{name}.csv", square(0.3)) == ""
    browser.settle()
    assert browser.do("state.record") == name
    browser.wait("rested === 0")
    nodes = ast.walk(ast.parse(browser.do("document.getElementById('python').textContent")))
    texts = [node.value for node in nodes if isinstance(node, ast.Constant)]
    assert f"data/records/{name}.csv" in texts
    assert browser.drop(f"{name}.csv", f"{name},a\n").startswith(f"{name}.csv: no line names")
    browser.open(browser.do("location.hash.slice(1)"))
    message = browser.do("document.getElementById('shape-error').textContent")
    assert f"the record “{name}” is not in this page" in message
    assert browser.do("document.querySelectorAll('main img').length") == 0
    assert browser.errors == []
