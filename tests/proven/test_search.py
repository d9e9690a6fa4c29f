"""Proven outcomes: those of the solvers, and undecided where no enclosure decides."""

import math

import numpy as np
import pytest

from topheavy import Column, Pulse, Record, RockingBlock, RockingFrame, judge, minimum_overturning
from topheavy.ground.shapes import ENDING
from topheavy.proven import outcome
from topheavy.proven.balls import Undecided, arb, hull, precision
from topheavy.proven.blocks import enclosed
from topheavy.proven.forcing import prepared
from topheavy.proven.march import March, Rest

COLUMN = Column(0.5, 3.0)
OMEGA = 2.0 * math.pi / 1.5
PULSE = Pulse("one-cosine", 1.0, OMEGA)
NOISE = Record(0.02, 0.3 * np.random.default_rng(3).standard_normal(400), "noise")


@pytest.mark.parametrize("linearised", [False, True])
@pytest.mark.parametrize("shape", ENDING)
def test_outcomes_and_peaks_are_those_of_the_solver(shape, linearised):
    frame = RockingFrame(COLUMN, 1.0)
    block = frame.block().linear() if linearised else frame.block()
    seen = set()
    for scale in (0.5, 1.02, 1.3, 2.1, 3.3, 5.2, 9.1):
        for ratio in (1.0, 3.3, 6.1):
            pulse = Pulse(shape, scale * block.uplift_acceleration, ratio * 1.5)
            found, ending = outcome(frame, pulse, linearised=linearised), judge(block, pulse)
            assert found.outcome == ("overturns" if ending.overturned else "survives")
            seen.add(found.outcome)
            if not ending.overturned:
                low, high = found.peak
                assert low - 1e-8 <= ending.peak <= high + 1e-8
                assert low <= high
    assert len(seen) == 2


def test_boundary_is_bracketed_to_twelve_digits():
    below, above = (outcome(COLUMN, PULSE, factor=0.272822711046 + x) for x in (0.0, 1e-12))
    assert (below.outcome, above.outcome) == ("survives", "overturns")
    low, high = minimum_overturning(COLUMN, PULSE, (0.2, 0.4), resolution=0.01)
    assert low - 1e-9 < 0.272822711046 < high + 1e-9


def test_box_that_contains_a_boundary_is_undecided():
    """The boundary is inside, wherever the middle of the box is."""
    for low, high in ((0.27282271, 0.27282272), (0.2728227, 0.272822712), (0.27282271, 0.2728228)):
        found = outcome(COLUMN, PULSE, factor=(low, high))
        assert (found.outcome, found.cause) == ("undecided", "separatrix")


def test_box_beside_a_boundary_is_decided_and_its_peak_holds_those_inside():
    found = outcome(COLUMN, PULSE, factor=(0.2701, 0.2702))
    assert found.outcome == "survives"
    for factor in (0.2701, 0.27013, 0.2702):
        low, high = outcome(COLUMN, PULSE, factor=factor).peak
        assert found.peak[0] <= low < high <= found.peak[1]
    assert outcome(COLUMN, PULSE, factor=(0.28, 0.2801)).outcome == "overturns"


def marched(phi, rate, linearised=False):
    block = enclosed(RockingBlock(2.0, 0.25, 0.9), linearised)
    march = March(block, prepared(PULSE), arb(1), 72, 1e-13, Rest(arb(0)))
    march.side, march.phi, march.rate = 1, phi, rate
    return march


@pytest.mark.parametrize("linearised", [False, True])
def test_exact_separatrix_is_undecided_and_its_sides_are_not(linearised):
    alpha = arb("0.25")
    with pytest.raises(Undecided, match="separatrix"):
        marched(alpha, arb(0), linearised)._rocks_freely()
    # around the point of unstable equilibrium, moving so that only a middle would tell
    with pytest.raises(Undecided, match="separatrix"):
        marched(alpha - hull("-1e-9", "2e-9"), arb(0), linearised)._rocks_freely()
    with precision(200):
        settled(linearised)


def settled(linearised):
    alpha, tiny = arb(1) / 4, arb("1e-15")
    for off, rate, ends in (
        (-tiny, arb(0), "survives"),
        (tiny, arb(0), "overturns"),
        (-tiny, arb("1e-9"), "overturns"),
        (tiny, arb("-1e-9"), "survives"),
    ):
        assert marched(alpha + off, rate, linearised)._rocks_freely().outcome == ends


def test_record_with_many_bounces_is_decided_as_by_the_solver():
    for factor in (0.5, 0.8, 1.0, 2.0):
        found, ending = outcome(COLUMN, NOISE, factor=factor), judge(COLUMN, NOISE.scaled(factor))
        assert found.outcome == ("overturns" if ending.overturned else "survives")
        if found.peak:
            assert found.peak[0] - 1e-8 <= ending.peak <= found.peak[1] + 1e-8
    assert found.impacts > 0


def test_block_that_reaches_the_ground_under_the_forcing_has_overturned():
    """A push of 30 g the other way does not raise it again."""
    ground = Record(0.25, [3.0] * 8 + [-30.0] * 8 + [0.0], unit="g")
    assert judge(COLUMN, ground).overturned
    assert outcome(COLUMN, ground).outcome == "overturns"


def test_lossless_bounces_are_given_up():
    ground = Record(0.1, [0.3, 0.2, *[0.1] * 800])
    found = outcome(RockingBlock(2.0, 0.25, 1.0), ground)
    assert (found.outcome, found.cause) == ("undecided", "impacts")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"factor": (2.0, 1.0)}, r"factor is \(2, 1\); expected the lower end first"),
        ({"factor": math.nan}, "factor is nan"),
        ({"excitation": Pulse("harmonic", 1.0, 1.0)}, "goes on forever"),
        ({"excitation": None}, "expected a Pulse or a Record"),
        ({"structure": Column(3.0, 1.0)}, "no rocking after an impact"),
        ({"structure": 5}, "structure is 5"),
        ({"bits": 600}, "bits is 600; expected at most 520"),
    ],
)
def test_bad_value_is_named(change, message):
    given = {"structure": COLUMN, "excitation": PULSE} | change
    with pytest.raises(ValueError, match=message):
        outcome(given.pop("structure"), given.pop("excitation"), **given)


@pytest.mark.parametrize("bits", [72, 136, 264])
def test_block_that_is_lifted_as_it_lands_without_rebound_is_not_at_rest(bits):
    """√r = 0, and |a| beyond the level at the landing: no state of rest is known exactly there."""
    pulse, factor = Pulse("one-cosine", 1.0, 5.0), 0.7330958355867645
    block = RockingBlock(2.0, 0.2, 0.0)
    assert judge(block, pulse.scaled(factor)).overturned
    assert outcome(block, pulse, factor=factor, bits=bits).outcome == "overturns"
