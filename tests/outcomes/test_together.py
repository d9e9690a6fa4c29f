"""Factors and searches together: each is judged as alone, to the last bit, in fewer calls."""

import numpy as np
import pytest

import topheavy as th
from tests.cases import BLOCK, COLUMN
from tests.outcomes.test_overturning import CASES, HARMONIC, SHAKING, SINE, scans  # noqa: F401
from topheavy.outcomes.overturning import Search, outcomes_by

FACTORS = np.linspace(0.0, 6.0, 61)
UP = th.Record(0.013, 0.2 * np.cos(0.3 * np.arange(160)), "up")
RECORD = th.Record(0.02, 0.25 * np.sin(0.11 * np.arange(140)) + 0.1 * np.sin(0.4 * np.arange(140)))
MANY = [
    COLUMN,
    th.RockingFrame(COLUMN, 2.0),
    th.FixedMassColumn(COLUMN, 1.0),
    th.MonolithicPortal(COLUMN, 1.0, 1.2),
]
MANY.append(COLUMN.block().linear())


@pytest.mark.parametrize("excitation", [SINE, SHAKING, CASES["antisymmetric"][1]], ids=str)
@pytest.mark.parametrize("structure", [BLOCK, MANY[1]])
def test_each_factor_is_judged_as_the_scaled_excitation(structure, excitation):
    ends = [th.judge(structure, excitation.scaled(factor)) for factor in FACTORS]
    overturned, impacts = outcomes_by(structure, excitation, FACTORS)
    assert overturned.tolist() == [end.overturned for end in ends]
    assert impacts.tolist() == [end.impacts for end in ends]
    np.testing.assert_array_equal(th.overturned_by(structure, excitation, FACTORS), overturned)
    assert 0 < overturned.sum() < FACTORS.size


def searches():
    """Unlike structures under unlike motions, of which some are the same object."""
    pulses = [
        th.Pulse("one-sine", 0.2, 3.0),
        th.Pulse("one-sine", 0.2, 5.5),
        th.Pulse("constant", 0.3, 4.0),
    ]
    found = [Search(structure, RECORD, (0.5, 4.0)) for structure in MANY]
    found += [Search(structure, RECORD, (0.5, 4.0), UP) for structure in MANY[:3]]
    found += [Search(MANY[1], RECORD, (0.5, 4.0), UP, scale_vertical=False)]
    return found + [Search(one, pulse, (0.9, 7.0)) for one in MANY[::2] for pulse in pulses]


def test_searches_together_find_what_each_finds_alone_in_fewer_calls(scans):  # noqa: F811
    """To the last bit, in their order."""
    together, found = th.intervals_together(searches(), resolution=0.07, most_impacts=1), []
    joint, low = len(scans), th.minima_together(searches(), resolution=0.07)
    scans.clear()
    for search in searches():
        named = {"vertical": search.vertical, "scale_vertical": search.scale_vertical}
        found.append(
            th.overturning_intervals(*search[:3], most_impacts=1, resolution=0.07, **named)
        )
    assert joint < 0.6 * len(scans)
    assert together == found
    for search, bracket, intervals in zip(searches(), low, found, strict=True):
        named = {"vertical": search.vertical, "scale_vertical": search.scale_vertical}
        assert bracket == (intervals[0].lower if intervals else None)
        assert bracket == th.minimum_overturning(*search[:3], resolution=0.07, **named)
    assert len({intervals[0].lower for intervals in together if intervals}) > 12


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: th.overturned_by(BLOCK, SHAKING, [1.0, -1.0]), "factors goes down to -1"),
        (lambda: th.overturned_by(BLOCK, SHAKING, []), "factors has shape"),
        (lambda: th.overturned_by(BLOCK, HARMONIC, FACTORS), "goes on forever"),
        (
            lambda: th.overturned_together([], RECORD, [1.0]),
            "structures is empty; expected one or m",
        ),
        (
            lambda: th.overturned_together(None, RECORD, [1.0]),
            "structures is None; expected a list of",
        ),
        (
            lambda: th.overturned_together(MANY, RECORD, np.ones((2, 3))),
            r"shape \(2, 3\); expected .* each of the 5 structures",
        ),
        (
            lambda: th.overturned_together(MANY, RECORD, [-1.0, 2.0]),
            "goes down to -1; it cannot be n",
        ),
        *(
            (lambda f=f, given=given: f(given, resolution=0.1), says)
            for f in (th.intervals_together, th.minima_together)
            for given, says in (
                ([], "searches is empty; expected one or more"),
                (
                    [*searches(), Search(COLUMN, None, (0.0, 1.0))],
                    "excitation is None; expected a Pu",
                ),
            )
        ),
    ],
)
def test_several_are_refused_with_what_was_expected(call, says):
    with pytest.raises(ValueError, match=says):
        call()
