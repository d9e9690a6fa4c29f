"""One slip apart: what counts as a misprinted number."""

import pytest

from replication.judging.misprints import one_slip_apart


@pytest.mark.parametrize(
    ("printed", "meant", "decimals"),
    [
        (0.275, 0.225, 3),  # a wrong digit
        (3.54, 3.4495, 2),  # two neighbours exchanged
        (12.5, 1.5, 1),  # an added digit
        (1.5, 12.5, 1),  # a lost one
        (-0.4, 0.4, 1),  # the sign
        (0.434, 4.34, 3),  # the decimal point
        (345, 3.45, 0),
        (3.57, 3.5699457, 4),  # rounded to the wrong side
    ],
)
def test_slip_is_told(printed, meant, decimals):
    assert one_slip_apart(printed, meant, decimals)


@pytest.mark.parametrize(
    ("printed", "meant", "decimals"),
    [
        (0.275, 0.2751, 3),  # no slip: the rounding
        (0.275, 0.300, 3),
        (3.57, 3.5698, 4),  # two units of the last digit, which carry
        (0.275, 0.572, 3),  # two digits that are no neighbours
        (0.275, 0.296, 3),
        (0.275, 0.382, 3),
        (125, 512, 0),
        (12.5, 0.1, 1),
    ],
)
def test_two_slips_or_none_are_no_misprint(printed, meant, decimals):
    assert not one_slip_apart(printed, meant, decimals)
