"""Records, those of the repository, and units."""

import itertools
import math
import re

import numpy as np
import pytest

from tests.cases import RECORDS
from topheavy import STANDARD_GRAVITY, Record, read_record
from topheavy.ground.records.units import acceleration_in_g, stated_acceleration, time_in_seconds

SAMPLES = (0.1, -0.2, 0.4, 0.0, -0.3)
FIVE = Record(0.02, np.array(SAMPLES), name="five samples")


def test_record_passes_through_its_samples_by_straight_lines_and_is_zero_outside():
    times = [0.0, 0.02, 0.04, 0.06, 0.08, 0.01, 0.045]
    assert FIVE.excitation(times) == pytest.approx([*SAMPLES, -0.05, 0.3], abs=1e-14)
    fine = FIVE.excitation(np.linspace(0.04, 0.06, 21))
    np.testing.assert_allclose(np.diff(fine, 2), 0.0, atol=1e-14)
    outside = np.array([-1.0, -1e-9, 0.08 + 1e-9, 0.1, 1e3])
    assert not FIVE.excitation(outside).any()
    assert FIVE.excitation(-1e-9) == FIVE.excitation(0.08 + 1e-9) == 0
    assert FIVE.duration == pytest.approx(0.08, rel=1e-15)
    assert (FIVE.name, FIVE.time_step, Record(0.02, SAMPLES).name) == ("five samples", 0.02, "")


def test_last_sample_is_that_of_the_end_and_of_no_later_time():
    for step in np.random.default_rng(1).uniform(0.001, 1.0, 200):
        for size in (2, 4, 100):
            record = Record(float(step), np.full(size, 0.5))
            assert record.excitation(record.duration) == 0.5
            assert record.excitation(math.nextafter(record.duration, math.inf)) == 0.0


@pytest.mark.parametrize(
    ("unit", "factor"), [("g", 1.0), ("m/s2", 9.81), ("cm/s²", 981.0), ("gal", 981.0), ("mg", 1e3)]
)
def test_record_in_memory_is_converted_to_g(unit, factor):
    found = Record(0.02, factor * np.array(SAMPLES), unit=unit)
    np.testing.assert_allclose(found.acceleration, SAMPLES, rtol=1e-15)
    with pytest.raises(ValueError, match=r"record 'a': unit is 'm/s'; expected g, % g"):
        Record(0.02, SAMPLES, "a", unit="m/s")


ACCELERATION = [
    *(([0.0, bad], rf"\b1\b.*{bad}") for bad in (math.nan, math.inf, -math.inf)),
    *((few, "two") for few in ([], [0.1])),
    (np.zeros((3, 4)), "dimension|shape"),
    (["0.1", "0.2"], "acceleration: element 0 is '0.1'; expected a number"),
    ([0.1, None], "acceleration: element 1 is None; expected a number"),
    ([True, False], "acceleration: element 0 is True; expected a number"),
    ([[0.1], [0.2, 0.3]], "acceleration: .*inhomogeneous.*; expected rows of equal length"),
]
NO_NUMBERS = ("0.02", True, np.array([0.02, 0.02]))


@pytest.mark.parametrize(("samples", "says"), ACCELERATION)
def test_bad_samples_are_refused_with_their_place(samples, says):
    with pytest.raises(ValueError, match=f"(?s){says}"):
        Record(0.02, samples)


@pytest.mark.parametrize(
    ("make", "value", "says"),
    [
        *((lambda x: Record(x, SAMPLES), x, f"time_step.*{x:g}")
          for x in (0.0, -0.02, math.nan, math.inf)),
        *((FIVE.scaled, x, str(x)) for x in (math.nan, math.inf)),
        *((lambda x: Record(x, SAMPLES), x, r"^time_step is .*; expected a number$")
          for x in NO_NUMBERS),
        *((FIVE.scaled, x, r"^factor is .*; expected a number$") for x in NO_NUMBERS),
        (FIVE.excitation, "0.02", r"^t: element 0 is '0\.02'; expected a number$"),
    ],
)  # fmt: skip
def test_bad_number_is_refused_by_name(make, value, says):
    with pytest.raises(ValueError, match=says):
        make(value)


def test_peaks_are_the_largest_acceleration_and_the_integral_of_the_straight_lines():
    assert Record(0.02, [0.1, -0.4, 0.3]).peak_acceleration == 0.4
    expected = 0.2 * 0.02 * STANDARD_GRAVITY
    assert Record(0.02, [0.1, 0.3]).peak_velocity == pytest.approx(expected, rel=1e-14)
    time = np.linspace(0.0, 1.0, 2001)
    sine = Record(time[1], 0.3 * np.sin(2.0 * math.pi * time))
    expected = 2.0 * 0.3 * STANDARD_GRAVITY / (2.0 * math.pi)  # ∫ sin over the first half
    assert sine.peak_velocity == pytest.approx(expected, rel=1e-6)
    assert sine.scaled(-2.0).peak_velocity == pytest.approx(2.0 * expected, rel=1e-6)


def test_record_is_scaled_to_a_peak():
    record = Record(0.1, [0.0, 0.2, -0.5, 0.1])
    assert record.scaled_to(pga=1.0).peak_acceleration == pytest.approx(1.0)
    assert record.scaled_to(pgv=0.3).peak_velocity == pytest.approx(0.3)
    assert record.time == pytest.approx([0.0, 0.1, 0.2, 0.3])
    for wrong in ({}, {"pga": 1.0, "pgv": 1.0}):
        with pytest.raises(ValueError, match="expected one of both"):
            record.scaled_to(**wrong)
    with pytest.raises(ValueError, match="has no acceleration"):
        Record(0.1, [0.0, 0.0]).scaled_to(pga=1.0)


def certified():
    """Name, samples, time step (s) and peak (g) of each record, by the README of their folder."""
    text = (RECORDS / "README.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (\w+\.AT2) \|.*?\| (\d+) \| ([\d.]+) \| ([\d.]+) \|", text, re.M)
    return [(name, int(n), float(step), float(peak)) for name, n, step, peak in rows]


def test_every_record_in_the_repository_is_certified():
    assert sorted(path.name for path in RECORDS.glob("*.AT2")) == sorted(r[0] for r in certified())
    assert len(certified()) == 10


@pytest.mark.parametrize(("file", "samples", "time_step", "peak"), certified())
def test_record_has_the_certified_count_step_and_peak(file, samples, time_step, peak):
    record = read_record(RECORDS / file)
    assert (record.acceleration.shape, record.time_step) == ((samples,), time_step)
    assert record.duration == pytest.approx((samples - 1) * time_step, rel=1e-14)
    assert record.peak_acceleration == pytest.approx(peak, abs=5e-4)


SECONDS = ["s", "sec", "SEC", "second", "seconds"]
LENGTHS = {
    1.0: ["m", "M", "meter", "metres"],
    0.01: ["cm", "CM", "centimeters", "centimetre"],
    0.001: ["mm", "MM", "millimetres", "millimeter"],
}
FORMS = ["{l}/{s}/{s}", "{l}/{s}2", "{l}/{s}^2", "{l}/{s}**2", "{l}/{s}²", "{l} / {s}^(2)"]


FORMS += ["{l}/({s}^2)", "{l} {s}-2", "{l} {s}^-2", "{l}·{s}⁻²", "{l}.{s}**-2", "{l} {s}^(-2)"]


FORMS += ["{l} per {s} per {s}", "{l} per {s} squared", "{l}/{s} squared", "{l} per square {s}"]


SPELLINGS = {
    form.format(l=length, s=second): metres / STANDARD_GRAVITY
    for metres, lengths in LENGTHS.items()
    for length, second, form in itertools.product(lengths, SECONDS, FORMS)
}


SPELLINGS |= dict.fromkeys(["g", "G", "g's", "G'S", "g’s"], 1.0)
SPELLINGS |= dict.fromkeys(["gal", "Gal", "GAL", "gals"], 0.01 / STANDARD_GRAVITY)
SPELLINGS |= {"g/10": 0.1, "G/100": 0.01, "g / 1000": 0.001, "%g": 0.01, "% G": 0.01}
SPELLINGS |= {"percent of g": 0.01, "mg": 0.001, "milli-g": 0.001}
"""What is written, and one of it in g."""


HEADERS = [
    "UNITS: {}",
    "Units = {}",
    "units={}, corrected",
    "ACCELERATION TIME SERIES IN UNITS OF {}",
    "ACCELERATION TIME HISTORY IN UNITS OF {}.  FILTER POINTS: HP=0.1 Hz   LP=46.0 Hz",
    "The units are ({})",
    "UNITS {}",
    "units of acceleration: {}",
    "ACCELERATION IN {}",
    "Accelerations recorded in building 5, in {}",
    "Acceleration: {}",
    "8 values to a line, in {}",
    "ACCELERATION ({})",
    "Accel. [{}]",
    "({})",
    "OUTPUT ACCELERATION TIME HISTORY ({}): NIT = 2",
    "NPTS=  4000, DT= .005 SEC, UNITS: {}",
]


def test_every_spelling_is_understood():
    understood = {spelling: acceleration_in_g(spelling) for spelling in SPELLINGS}
    assert understood == pytest.approx(SPELLINGS, rel=1e-14)


@pytest.mark.parametrize("spelling", ["G", "GAL", "cm/s²", "CM/S/S", "m s^-2", "mm/sec^2", "g/10"])
@pytest.mark.parametrize("header", HEADERS)
def test_statement_is_found_wherever_it_stands(header, spelling):
    found = stated_acceleration(["El Centro, 0.02 sec", header.format(spelling)])
    assert found.in_g == pytest.approx(SPELLINGS.get(spelling, acceleration_in_g(spelling)))
    assert found.place == 2


@pytest.mark.parametrize(
    "text",
    [
        *("cm/s", "m/s^3", "m/s2/Hz", "g/s", "g*10", "g x 10", "g/20", "2 g", "0.1g", "cm s", "s"),
        *("ft/s2", "G-force", "gall", "kg", "gram", "ms-2", "", "counts", "g^2", "g·s", "gg"),
    ],
)
def test_what_is_no_certain_unit_of_acceleration_is_not_understood(text):
    assert acceleration_in_g(text) is None
    with pytest.raises(ValueError, match=r"line 2 states a unit that is not understood: 'UNITS:"):
        stated_acceleration(["title", f"UNITS: {text}" if text != "s" else "UNITS: s/s"])
    with pytest.raises(ValueError, match=r"lines 1 to 2 state no unit .*line 2 is 'ACCELERATION"):
        stated_acceleration(["title", f"ACCELERATION ({text})"])


@pytest.mark.parametrize(
    "line",
    [
        "Processed in 2014, cm/s/s over 980.665",  # mentions, not statements
        "PEAK ACCELERATION = -341.7 CM/SEC/SEC AT 2.12 SEC",
        "Unit 4 of a power house, Gilroy (Gavilan College), station G",
        "TIME UNITS: SEC",
        "PGA (g) = 0.319, peak velocity (cm/s)",
        "Peak acceleration in g: 0.319",
        "the largest is 0.319 (g)",
        "Amax (g) = 0.319",
        "Maximum acceleration in g: 0.319",
        "Acceleration data, source: G. Smith",
        "g = 9.81 m/s2",
        "",
    ],
)
def test_mention_of_a_unit_is_no_statement(line):
    with pytest.raises(ValueError, match="lines 1 to 1 state no unit of acceleration"):
        stated_acceleration([line])
    assert stated_acceleration([line, "UNITS OF G"]).in_g == 1.0


def test_two_units_that_contradict_are_refused_with_both_lines():
    says = r"line 1 states 'cm/s2' \('A \(cm/s2\)'\) and line 3 states 'G' \('UNITS OF G'\)"
    with pytest.raises(ValueError, match=says):
        stated_acceleration(["A (cm/s²)", "", "UNITS OF G"])
    with pytest.raises(ValueError, match=r"line 1 states 'g' .* and line 3 states 'cm/s2'"):
        stated_acceleration(["A (g)", "UNITS OF G", "A (cm/s²)"])


def test_two_units_that_agree_are_one():
    assert stated_acceleration(["UNITS OF CM/SEC/SEC (GAL)"]).unit == "CM/SEC/SEC"


def test_definition_of_g_in_brackets_is_no_second_unit():
    found = stated_acceleration(["UNITS OF CM/S2 (g = 980.665 cm/s2)"])
    assert found.unit == "CM/S2"


@pytest.mark.parametrize("text", ["s", "S", "sec", "SEC", "seconds"])
def test_seconds_are_understood(text):
    assert time_in_seconds(text) == 1.0
    assert time_in_seconds(f"milli{text}" if text == "seconds" else f"m{text}") == 1e-3


@pytest.mark.parametrize("text", ["", "min", "hz", "e", "us", "samples"])
def test_other_units_of_time_are_not(text):
    assert time_in_seconds(text) is None
