"""Headers that would hold a reader up, and files that hold no ground motion."""

import re
import time
from pathlib import Path

import pytest

from topheavy import read_record
from topheavy.records import at2, columns, units

AT2 = "A site\nUNITS: G\nNPTS= {count}, DT= {step} SEC\n{values}\n"
CSV = "time (s),acceleration (g)\n0.00,0.1\n{time},{value}\n0.04,0.4\n"


@pytest.fixture
def refused(tmp_path):
    """Return the function that reads a text as a file and returns the message behind its name."""

    def refused(ending: str, text: str) -> str:
        path = tmp_path / f"motion.{ending}"
        path.write_text(text, encoding="utf-8")
        with pytest.raises(ValueError, match=rf"^{re.escape(str(path))}: ") as error:
            read_record(path)
        assert "\n" not in str(error.value)
        return str(error.value).removeprefix(f"{path}: ")

    return refused


READERS = {
    "unit": lambda line: units.stated_acceleration([f"data {line}x"]),
    "step": lambda line: at2._count_and_step(Path("x"), 4, f"NPTS= 5, {line}x"),
    "old step": lambda line: at2._count_and_step(Path("x"), 4, f"5 .01 NPTS{line}x"),
    "columns": lambda line: columns._units(Path("x"), f"{line}x,"),
}


def seconds(reader, line: str) -> float:
    """Return the least processor time of five calls, of a reader that refuses the line."""
    taken = []
    for _ in range(5):
        begun = time.process_time()
        with pytest.raises(ValueError):  # noqa: PT011
            reader(line)
        taken.append(time.process_time() - begun)
    return min(taken)


@pytest.mark.parametrize("reader", READERS)
@pytest.mark.parametrize(
    "part",
    [
        *(
            "UNITS ",
            "IN ",
            "data in ",
            "(",
            "(m   ",
            "units of ",
            "units of acc",
            "m per s ",
            "max ",
        ),
        *("( .5", "1.5 (", "1.", "1", " ", "a ", "a", "acc: ", "NPTS ", "DT ", "DT=1", "DT(", ", "),
    ],
)
def test_cost_of_a_header_grows_in_proportion_to_its_length(reader, part):
    short, long = (seconds(READERS[reader], part * number) for number in (600, 4800))
    assert long < 3 * 8 * short + 2e-3  # in proportion it is 8, as the square 64


def test_cost_of_many_statements_grows_in_proportion():
    def found(number: int) -> float:
        begun = time.process_time()
        assert units.stated_acceleration([" (g)" * number]).unit == "g"
        return time.process_time() - begun

    assert min(found(8000) for _ in range(3)) < 3 * 8 * min(found(1000) for _ in range(3))


@pytest.mark.parametrize(
    ("ending", "text", "place"),
    [
        ("AT2", "UNITS: G\n" + "x " * 501 + "\nNPTS= 2, DT= 0.01\n.1 .2\n", 2),
        ("AT2", f"UNITS: G\n{' ' * 1000}NPTS= 2, DT= 0.01\n.1 .2\n", 2),
        ("csv", f"time{' ' * 1000}(s),acceleration (g)\n0,0.1\n1,0.2\n", 1),
    ],
)
def test_line_of_a_header_that_is_too_long_is_refused(refused, ending, text, place):
    says = refused(ending, text)
    assert re.match(rf"line {place} has 10\d\d characters, '.*'…; expected at most 1000 in", says)
    assert len(says) < 250


@pytest.mark.parametrize("digits", [900, 5000])
def test_count_of_very_many_digits_is_refused_with_the_file(refused, digits):
    says = refused("AT2", AT2.format(count="1" * digits, step=0.01, values=".1 .2"))
    assert says.startswith("line 3 ")


def test_message_repeats_only_the_beginning_of_a_long_text(refused):
    long = "x" * 5000
    for ending, text in [
        ("AT2", AT2.format(count=2, step=0.01, values=f"0.1 {long}")),
        ("csv", CSV.format(time="0.02", value=long)),
    ]:
        assert len(refused(ending, text)) < 250


@pytest.mark.parametrize("digits", ["०.१", "0.1".translate({48: "０", 49: "１"}), "0.٢", "²"])
def test_digits_of_other_scripts_are_no_numbers(refused, digits):
    given = {"count": 2, "step": "0.01", "values": ".1 .2"}
    assert "is not a number" in refused("AT2", AT2.format(**given | {"values": f".1 {digits}"}))
    assert refused("AT2", AT2.format(**given | {"step": digits})).startswith("line 3 is 'NPTS=")
    count = digits.replace(".", "")
    assert refused("AT2", AT2.format(**given | {"count": count})).startswith("line 3 is 'NPTS=")
    assert refused("AT2", f"UNITS: G\n{count} 0.01 NPTS, DT\n.1 .2\n").startswith("line 2 is ")
    assert refused("csv", CSV.format(time="0.02", value=digits)).startswith("line 3 is '0.02,")
    assert refused("csv", CSV.format(time=digits, value="0.1")).startswith("line 3 is ")


@pytest.mark.parametrize(
    ("ending", "text"),
    [
        ("AT2", AT2.format(count=3, step=0.01, values="0.0 -0.0 1E-400")),
        ("csv", "time (s),acceleration (g)\n0,0\n1,0\n2,0\n"),
    ],
)
def test_record_without_motion_is_refused(refused, ending, text):
    assert refused(ending, text).startswith("all 3 accelerations are zero; expected a ground ")


@pytest.mark.parametrize(
    ("ending", "text"),
    [
        ("AT2", AT2.format(count=3, step="1e-320", values="0.0 0.1 0.2")),
        ("AT2", AT2.format(count=3, step="9.9e-7", values="0.0 0.1 0.2")),
        ("csv", "time (s),acceleration (g)\n0,.1\n1e-320,0\n2e-320,0\n"),
    ],
)
def test_step_below_a_microsecond_is_refused(refused, ending, text):
    says = refused(ending, text)
    assert re.match(r"the time step is [\d.]+e-\d+ s; expected at least 1e-06 s: is its unit", says)


def test_step_of_a_microsecond_is_read(tmp_path):
    path = tmp_path / "motion.AT2"
    path.write_text(AT2.format(count=3, step="1e-6", values="0.0 0.1 0.2"), encoding="utf-8")
    assert read_record(path).time_step == 1e-6
