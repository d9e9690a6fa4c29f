"""Records that are opened or dropped: what is read, refused and doubted, and what is shown then."""

import ast

import pytest

from topheavy import read_record

TIMES = [0.0, 0.02, 0.04, 0.06, 0.08]
SAMPLES = [0.1, -0.2, 0.4, 0.0, -0.3]
AT2 = "A site\nACCELERATION IN UNITS OF G\n{}\n 0.1 -0.2 4.0D-01\n 0.0 -3.0E-01\n"
ROWS = "".join(f"{t:.2f},{a}\n" for t, a in zip(TIMES, SAMPLES, strict=True))
CSV = "time (s),acceleration (g)\n" + ROWS
GALS = [f"{98.1 * 10 * a:.2f}" for a in SAMPLES]
READ_AT2 = [
    AT2.format("NPTS=  5, DT= .0200 SEC"),
    AT2.format("  5   .0200   NPTS, DT"),
    AT2.format("NPTS= 5\nDT= 20 MSEC"),
    "\n" * 7 + AT2.format("NPTS: 5, DT(MSEC)= 20"),
    AT2.format("NPTS= 5, DT= .02 UNITS: G") + "written by hand\n",
    AT2.format("PEAK 4.0 (CM/S2)\nNPTS= 5 DT= .02").replace("\n", "\r\n"),
]
REFUSED_AT2 = [
    (AT2.format("NPTS= 5, DT= .02 MIN"), "line 3 gives DT in “MIN”"),
    (AT2.format("NPTS= 5, DT= 20"), "a DT of 20 without a unit"),
    (AT2.format("NPTS= 6, DT= .02"), "NPTS is 6, and only 5 values follow"),
    (AT2.format("NPTS= 4, DT= .02"), "NPTS is 4, and more values follow"),
    (AT2.format("NPTS= 5, DT= .02").replace("0.0", "O.0"), "sample 4 is “O.0”"),
    (AT2.format("NPTS= 5"), "expected “NPTS= n, DT= s SEC”"),
    (AT2.format("UNITS: CM/S2\nNPTS= 5, DT= .02"), "states “G” and “CM/S2”"),
    (AT2.format("NPTS= 5, DT= .02").replace("UNITS OF G", "VOLTS"), "states no unit"),
    (AT2.format("NPTS= 5, DT= .02").replace("UNITS OF G", "UNITS OF V"), "states “V”"),
]
READ_CSV = [
    CSV,
    '"Time [s]","NS (g)","free, text"\n' + ROWS.replace("\n", ',"a, b"\n'),
    "sep=;\n" + CSV.replace(",", ";"),
    CSV.replace(",", ";").replace(".", ","),
    "station: é\n\n# time in s\tacceleration in g\n" + ROWS.replace(",", "\t") + "\t\n",
    "t (ms),a (cm/s²)\n" + "".join(f"{1000 * t:g},{a}\n" for t, a in zip(TIMES, GALS, strict=True)),
]
REFUSED_CSV = [
    ("t,a\n" + ROWS, "no line names columns of times and of accelerations with units"),
    (CSV.replace("0.04", "later"), "line 4 is “later,0.4”"),
    (CSV.replace("0.04,0.4\n", ""), "is a sample missing"),
    ("time (s),a (g)\n0.00,.1\n0.00,.2\n0.01,.1\n0.01,-.1\n", "printed to 0.01 only"),
    ("time (s),a (g)\n0,.1\n20,-.2\n40,.1\n", "the time step is 20 s"),
    ("time (s),a (g)\n0,0\n0.1,0\n", "the largest acceleration is 0 g"),
    ("time (s),a (g)\n0,981\n0.1,-981\n", "the largest acceleration is 981 g"),
    ("time (s),a (g)\n0,1\n", "1 samples; expected at least two"),
    ("time (s),a (g),b (g)\n0,1,1\n0.1,1,1\n", "expected one column of acceleration"),
    ("Period (s),Sa (g)\n0.1,1\n0.2,1\n", "of a response spectrum"),
]


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


@pytest.mark.parametrize(("ending", "files"), [("AT2", READ_AT2), ("csv", READ_CSV)])
def test_file_is_read(browser, ending, files):
    browser.open_to_compute()
    for text in files:
        for content in (text.encode("cp1252"), ("\ufeff" + text).encode()):
            step, samples, _ = read(browser, f"motion.{ending}", content)
            assert step == pytest.approx(0.02, rel=1e-12), text
            assert samples == pytest.approx(SAMPLES, abs=1e-12), text


@pytest.mark.parametrize(("ending", "files"), [("AT2", REFUSED_AT2), ("csv", REFUSED_CSV)])
def test_file_is_refused_with_the_reason(browser, ending, files):
    browser.open_to_compute()
    for text, reason in [*files, ("", "expected")]:
        message = read(browser, f"motion.{ending}", text)
        assert message.startswith(f"motion.{ending}: "), text
        assert reason in message, text
    assert "whose name ends in .AT2 or .csv" in read(browser, "motion.txt", CSV)


def test_record_of_the_page_is_read_as_by_the_library(browser, records, request):
    browser.open_to_compute()
    path = request.config.rootpath / "data/records/el_centro_1940_NS.AT2"
    step, samples, doubt = read(browser, path.name, path.read_bytes())
    assert (step, samples) == (0.02, records[path.stem].acceleration.tolist())
    assert doubt == ""


def test_implausible_motion_is_doubted(browser, square):
    browser.open_to_compute()
    for content, doubt in (
        (square(0.3), ""),
        (square(0.3).replace(",-", ","), "no sample changes sign"),
        (square(0.3).replace(",-0.3", ",-0.1"), "is its baseline not corrected"),
        (square(2.5), "its velocity reaches"),
        (square(2.5), "its peak is 2.5 g"),
    ):
        found = read(browser, "motion.csv", content)
        assert isinstance(found, list), found
        assert (doubt in found[2]) if doubt else found[2] == ""


@pytest.mark.filterwarnings("ignore::UserWarning")
@pytest.mark.parametrize(
    ("ending", "taken", "refused"), [("AT2", READ_AT2, REFUSED_AT2), ("csv", READ_CSV, REFUSED_CSV)]
)
def test_library_takes_and_refuses_the_same_files(tmp_path, ending, taken, refused):
    path = tmp_path / f"motion.{ending}"
    for text in taken:
        path.write_bytes(text.encode("cp1252"))
        record = read_record(path)
        assert record.time_step == pytest.approx(0.02, rel=1e-12), text
        assert record.acceleration == pytest.approx(SAMPLES, abs=1e-12), text
    for text, _ in refused:
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ValueError, match="motion"):
            read_record(path)


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


def test_long_record_is_shown_and_its_map_can_be_left(browser, square):
    browser.open()
    assert browser.drop("long.csv", square(0.4, 0.001, 100_000)) == ""
    browser.settle()
    assert browser.do("found.peak") == pytest.approx(0.4)
    browser.wait("document.getElementById('progress').value > 0")
    browser.do("start(DEFAULTS)")  # its map would take minutes
    browser.settle("map")
    assert browser.errors == []


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
    found = browser.do("document.getElementById('shape-error').textContent")
    assert f"the record “{name}” is not in this page" in found
    assert browser.do("document.querySelectorAll('main img').length") == 0
    assert browser.errors == []
