"""Units of acceleration: every usual spelling, what is refused, and where a header states one."""

import itertools

import pytest

from topheavy import STANDARD_GRAVITY
from topheavy.ground.records.units import acceleration_in_g, stated_acceleration, time_in_seconds

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
