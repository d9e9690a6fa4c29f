"""Proven outcomes: of histories, of rest, below a bound, and bounds of functions."""

import copy
import json
import math
from fractions import Fraction
from itertools import pairwise, product

import numpy as np
import pytest

from topheavy import (
    Column,
    Pulse,
    Record,
    RockingBlock,
    RockingFrame,
    judge,
    overturning_intervals,
    simulate,
)
from topheavy.ground.shapes import ENDING
from topheavy.proven import certified, outcome, survives_below
from topheavy.proven.balls import Undecided, arb, hull, precision, within
from topheavy.proven.blocks import Balls, enclosed
from topheavy.proven.bounds import SIDES, START, Bounded
from topheavy.proven.checking import Refused, check
from topheavy.proven.flight import Law
from topheavy.proven.forcing import prepared
from topheavy.proven.march import March, Rest
from topheavy.proven.rest import dies_out

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
    low, high = overturning_intervals(COLUMN, PULSE, (0.2, 0.4), resolution=0.01)[0].lower
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


ROOT = 0.9


def asked(push, rate, root=ROOT, linearised=True):
    """Of a block with α = 0.25 under a constant push, in a clock with κ = 1."""
    law = Law(Balls(arb("0.25"), arb(1), arb(root), linearised), arb(1))
    return dies_out(law, prepared(Pulse("constant", push, 1.0)), arb(1), 0, arb("0.5"), arb(rate))


@pytest.mark.parametrize("push", [0.0, 0.05, 0.15])
def test_all_bounces_end_before_the_bound_and_stay_below_it(push):
    rate = 1e-3
    until, highest = asked(push, rate)
    time, speed, top, side = 0.5, rate, 0.0, -1
    for _ in range(500):  # φ'' = φ − α − s a, in closed form
        side = -side
        depth = 0.25 + side * push
        time += 2.0 * math.atanh(speed / depth)
        top = max(top, depth - math.sqrt(depth**2 - speed**2))
        speed *= ROOT
    assert time < until
    assert top < highest
    assert until < 0.5 + 8.0 * (time - 0.5)


@pytest.mark.parametrize("linearised", [False, True])
def test_bounces_under_more_than_the_uplift_or_without_loss_are_not_said_to_end(linearised):
    assert asked(0.1, 1e-3, linearised=linearised) is not None
    assert asked(0.26, 1e-3, linearised=linearised) is None
    assert asked(0.1, 1e-3, root=1.0, linearised=linearised) is None
    assert asked(0.1, 0.2, linearised=linearised) is None


SLOW_PULSE = Pulse("one-cosine", 1.0, 2.0 * math.pi / 1.5)


def edges(certificates):
    return [[float(Fraction(x)) for x in each["factor"]] for each in certificates]


def without_gap(found, high):
    """Return the number of boxes, which have to follow each other from zero up to `high`."""
    assert not found.open
    boxes = edges(found.certificates)
    assert (boxes[0][0], boxes[-1][1]) == (0.0, high)
    assert all(one[1] == other[0] for one, other in pairwise(boxes))
    return len(boxes)


def kinds(certificates):
    return [{event["event"] for event in each["events"]} for each in certificates]


@pytest.mark.parametrize("shape", ["one-cosine", "one-sine"])
def test_boxes_are_whole_below_a_bound(shape):
    pulse, high = Pulse(shape, 1.0, SLOW_PULSE.angular_frequency), 0.172
    found = survives_below(COLUMN, pulse, high)
    without_gap(found, high)
    assert any("bounded" in each for each in kinds(found.certificates))
    assert not any(
        judge(COLUMN, pulse.scaled(top)).overturned for _, top in edges(found.certificates)
    )


def bounded(factor):
    found, certificate = certified(COLUMN, SLOW_PULSE, factor=factor, bits=72, bounded=True)
    return found, json.loads(json.dumps(certificate))


@pytest.mark.parametrize("factor", [(0.2728, 0.2729), (0.2728, 0.3), (0.28, 0.29)])
def test_box_in_which_one_overturns_is_not_said_to_survive(factor):
    assert judge(COLUMN, SLOW_PULSE.scaled(factor[1])).overturned
    assert bounded(factor)[0].outcome in ("undecided", "overturns")


@pytest.fixture(scope="module")
def box():
    """From below uplift to 1 % above it: the lemma alone."""
    found, certificate = bounded((0.1664, 0.1685))
    assert found.outcome == "survives"
    assert kinds([certificate]) == [{"bounded"}]
    return certificate


def test_lemma_is_proven_again(box):
    assert check(box) == "survives"


def smaller(event, place, by="9999/10000"):
    steps = event["steps"]
    steps[40][place] = str(Fraction(steps[40][place]) * Fraction(by))


def wall(event, by="999/1000"):
    steps = event["steps"]
    steps[40][2] = [str(Fraction(x) * Fraction(by)) for x in steps[40][2]]


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (lambda c, e: e.update(steps=e["steps"][:-1]), "the bound ends before the pulse"),
        (lambda c, e: smaller(e, 1, "9/10"), "the energy may grow more"),
        (lambda c, e: wall(e), "a wall may be passed"),
        (lambda c, e: e.update(energy="-1"), "not negative"),
        (lambda c, e: c.update(factor=["1/10", "18/100"]), "may be passed|may grow|barrier"),
        (lambda c, e: c["events"].clear(), "may lift"),
    ],
)
def test_changed_bound_is_refused(box, change, reason):
    wrong = copy.deepcopy(box)
    change(wrong, wrong["events"][0])
    with pytest.raises(Refused, match=reason):
        check(wrong)


@pytest.mark.parametrize(("shape", "high"), [("half-sine", 0.3571855), ("one-cosine", 0.181)])
def test_boxes_of_the_column_are_proven_twice(shape, high):
    """Under the half-sine up to its minimum, under the one-cosine the first part only."""
    pulse, answers = Pulse(shape, 1.0, SLOW_PULSE.angular_frequency), []

    def proven_twice(certificate):
        try:
            answers.append(check(certificate) == "survives")
        except Refused:
            answers.append(False)
        return answers[-1]

    assert judge(COLUMN, pulse.scaled(high * 1.000001)).overturned == (shape == "half-sine")
    found = survives_below(COLUMN, pulse, high, accepts=proven_twice)
    assert sum(answers) == without_gap(found, high)
    assert not all(answers)  # what is refused is tried again narrower


LEVEL = COLUMN.uplift_acceleration


@pytest.fixture(autouse=True)
def balls():
    with precision(72):
        yield


def bound_of(factor, linearised=False):
    block, forcing = enclosed(COLUMN, linearised), prepared(PULSE)
    kappa = forcing.scale(block.frequency_parameter)
    return Bounded(Law(block, kappa * kappa), forcing, forcing.pieces[0], within(factor))


@pytest.mark.parametrize("linearised", [False, True])
def test_bound_from_rest_holds_the_motions_of_a_box(linearised):
    low, high = 1.05 * LEVEL, 1.0505 * LEVEL
    of = bound_of((low, high), linearised)
    block = COLUMN.block().linear() if linearised else COLUMN.block()
    steps = list(of.carried(of.start(arb(0), 0, arb(0), arb(0))))[:-1]  # samples end with it
    times = np.array([float(step.sigma) for step in steps]) / OMEGA
    for factor in np.linspace(low, high, 5):
        one = bound_of(float(factor), linearised)
        found = simulate(block, PULSE.scaled(factor), duration=1.5, samples=[0.0, *times])
        closest = 0.0
        for step, phi, rate in zip(steps, found.rotation[1:], found.velocity[1:], strict=True):
            side = 1 if phi > 0.0 else -1
            wall = step.walls[SIDES.index(side)]
            state = one.start(step.sigma, side, arb(abs(phi)), arb(rate / OMEGA))
            assert abs(phi) <= wall * (1.0 + 1e-9)
            assert state.energy / START <= step.energy + 1e-10
            closest = max(closest, abs(phi) / wall)
        assert closest > 0.5  # the first flight, which is all that is known of it


def test_bound_of_a_box_of_states_holds_its_corners():
    ends = [(0.8, 1.2), (0.01, 0.02), (-0.03, 0.03), (0.2, 0.3)]  # σ, φ, φ', factor
    sigma, phi, rate, _ = (hull(*map(str, pair)) for pair in ends)
    for side in SIDES:
        start = bound_of(ends[-1]).start(sigma, side, phi, rate)
        for *state, factor in product(*ends):
            one = bound_of(factor).start(arb(state[0]), side, *map(arb, state[1:]))
            assert one.energy <= start.energy * 1.001
            assert max(one.walls) <= max(start.walls)


def test_energy_behind_the_pulse_has_its_last_jump():
    of, phi, rate = bound_of(0.25), 0.05, 0.01
    end = of.piece.stop
    for side, gain in ((-1, 0.25), (1, 0.0)):  # a ends at +0.25 g, which pushed the side −1
        bound = of.start(end, side, arb(phi), arb(rate))
        free = arb(rate) ** 2 / 2 + of.law.potential(arb(phi), arb(0))
        behind = of.energy_behind(bound)
        assert behind > free
        lever = of.law.square * of.law.lever(arb(START * phi))
        assert float(behind) == pytest.approx(float(bound.energy + gain * lever), rel=1e-6)


def test_amplitude_that_overturns_is_not_bounded():
    assert judge(COLUMN, PULSE.scaled(0.28)).overturned
    of = bound_of(0.28)
    with pytest.raises(Undecided, match="bound"):
        list(of.carried(of.start(arb(0), 0, arb(0), arb(0))))
