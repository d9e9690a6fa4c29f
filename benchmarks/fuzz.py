"""Search for inputs on which the solvers disagree.

Hypothesis draws structures, motions and arguments with their edges: √r of 0 and 1, γ of 0 and ∞, no
amplitude, the level of uplift to the last bit, plateaus, single samples. Maps and lists of factors,
`simulate` and `judge`, and the plain solver have to agree on each outcome that slight changes of
the motion leave as it is. An error may be the ArithmeticError of a history that bounces for too
long.

    python benchmarks/fuzz.py [minutes, 1 unless given] [seed, of the clock unless given]

prints the cases of each property. The first failure ends it with its smallest case and its seed.
"""

import math
import sys
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable
from functools import partial, wraps
from itertools import count, pairwise
from typing import Any
from unittest.mock import patch

import numpy as np
from hypothesis import HealthCheck, Phase, assume, given, seed, settings
from hypothesis import strategies as st

import audit
import topheavy as th
from steps.shared import plain
from topheavy.bodies import free_rocking
from topheavy.bodies.structures import RockingBlock, Structure, solitary_size
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.shapes import FINITE_SHAPES

#: Cases of a property in its turn, s of the processor for one (a search that ends without a proof
#: takes 60), and how far seeds of turns are apart, so that neighbouring seeds have other cases.
TURN, LONGEST, APART = 25, 300.0, 1000
#: Relative changes of a motion that leave a decided outcome, and what a peak may then differ, α.
NUDGES, CLOSE = (-1e-6, -1e-8, 1e-8, 1e-6), 1e-6
FARTHER = (*NUDGES, -1e-5, 1e-5)
#: The tolerance of slightly changed motions, which is to leave a decided outcome as well.
TIGHT = 1e-13
#: The largest error of the plain solver by its own steps, α: a larger one is a fault.
LARGE = 0.01


def edged(low: float, high: float, *edges: float) -> st.SearchStrategy[float]:
    """Return floats of a range, and its edges more often."""
    return st.one_of(st.floats(low, high), st.sampled_from([low, high, *edges]))


@st.composite
def blocks(draw: st.DrawFn) -> RockingBlock:
    return th.RockingBlock(
        draw(st.floats(0.3, 10.0)),
        draw(edged(0.01, 1.4, 0.25)),
        draw(edged(0.0, 1.0, 0.5, 1.0 - 1e-9)),
        linearised=draw(st.booleans()),
    )


@st.composite
def bodies(draw: st.DrawFn) -> Structure:
    """Draw any structure that rocks."""
    column = th.Column(h := draw(st.floats(0.05, 1.0)), draw(st.floats(1.5, 12.0)) * h)
    ratio = draw(edged(0.0, 50.0, math.inf, 1e-9))
    wide = draw(st.floats(2.1, 20.0)) * column.half_width
    lengths = [draw(edged(0.0, 2.0)) for _ in range(2)]
    fixed = th.FixedMassColumn(column, ratio, *lengths)
    portal = th.MonolithicPortal(column, ratio, wide, *lengths)
    structure = draw(st.sampled_from([th.RockingFrame(column, ratio), column, fixed, portal]))
    assume(structure.restitution >= 0.0)
    return structure


structures = st.one_of(blocks(), bodies())


@st.composite
def motions(draw: st.DrawFn, structure: Structure) -> Pulse | Record:
    """Draw a pulse that ends, or a record, from none to several times the level of uplift."""
    block = structure.block()
    level, p = block.uplift_acceleration, block.frequency_parameter
    beside = [math.nextafter(1.0, 2.0), math.nextafter(1.0, 0.0), 1.0 + 1e-9, 1.0]
    size = level * draw(edged(0.0, 12.0, *beside)) * draw(st.sampled_from([-1.0, 1.0]))
    if draw(st.booleans()):
        shape = draw(st.sampled_from(sorted(FINITE_SHAPES)))
        return th.Pulse(shape, size, angular_frequency=p * draw(edged(0.2, 30.0, 1.0)))
    samples = st.one_of(st.floats(-1.0, 1.0), st.sampled_from([0.0, 1.0, 1.0, -1.0, 0.5]))
    values = draw(st.lists(samples, min_size=2, max_size=40))
    return th.Record(draw(st.floats(0.005, 1.0)) / p, size * np.array(values), unit="g")


@st.composite
def shaken(draw: st.DrawFn, among: st.SearchStrategy[Structure] = structures) -> tuple[Any, ...]:
    """Draw a structure, a motion, and with some records a vertical one."""
    structure = draw(among)
    motion, vertical = draw(motions(structure)), None
    if isinstance(motion, Record) and draw(st.booleans()):
        values = draw(st.lists(edged(-0.8, 0.8, 0.0), min_size=2, max_size=40))
        ratio = draw(edged(0.3, 3.0, 1.0, 0.5))
        vertical = th.Record(ratio * motion.time_step, values, unit="g")
    return structure, motion, vertical


Ends = Callable[..., free_rocking.Outcome]


def decided(ends: Ends, motion: Any, end: free_rocking.Outcome) -> float:
    """Return how far peaks may differ, rad; infinite where slight changes turn the outcome."""
    others = [ends(motion.scaled(1.0 + nudge), tolerance=TIGHT) for nudge in NUDGES]
    is_same = all(other.overturned == end.overturned for other in others)
    return 10.0 * max(apart(*pair) for pair in pairwise(others)) if is_same else math.inf


def apart(one: Any, two: Any) -> float:
    """Return how far two outcomes are apart: their peaks, rad, or infinitely."""
    if one.overturned != two.overturned:
        return math.inf
    return 0.0 if one.overturned else abs(one.peak_rotation - two.peak_rotation)


def finer() -> Any:
    """Let the plain solver halve its steps, and call at rest what bounces a tenth as high.

    It has no tolerance, and bounces that it leaves out may lift a block later, most without loss.
    """
    return patch.multiple(audit, LONGEST_STEP=audit.LONGEST_STEP / 2, REST=audit.REST / 10)


def agree(
    block: RockingBlock, motion: Any, ends: Ends, other: Ends, *, has_own_error: bool = False
) -> None:
    """Compare the endings by two solvers, which are functions of a motion."""
    one, two, close = ends(motion), other(motion), CLOSE * block.slenderness
    if apart(one, two) > close and has_own_error:
        with finer():
            close += min(10.0 * apart(two, other(motion)), LARGE * block.slenderness)
    if apart(one, two) > close:
        slack = max(decided(ends, motion, one), decided(other, motion, two))
        assert apart(one, two) <= slack + close, f"{one} and {two}"


def endings(case: Any) -> None:
    structure, motion, vertical = case
    block, above = structure.block(), {"vertical": vertical}
    ends = partial(th.judge, structure, **above)

    def plainly(motion: Any, **_: float) -> free_rocking.Outcome:
        return plain.judge(structure, motion, **above)

    agree(block, motion, ends, plainly, has_own_error=True)
    agree(block, motion, ends, partial(th.simulate, structure, **above))
    whole = th.simulate(structure, motion, **above)
    assert whole.overturned or np.isfinite(whole.rotation).all(), "a survivor without a rotation"
    assert (np.diff(whole.impact_times) >= 0.0).all()


def histories(case: Any, data: st.DataObject) -> None:
    structure, motion, vertical = case
    block = structure.block()
    alpha, p = block.slenderness, block.frequency_parameter
    start = {
        "rotation": alpha * data.draw(edged(-1.2, 1.2, 0.0, -0.0)),
        "velocity": alpha * p * data.draw(edged(-1.5, 1.5, 0.0)),
    }
    assume(abs(start["rotation"]) < math.pi / 2)
    length = data.draw(edged(0.01, 1.0)) * max(1.0, p * motion.duration) / p
    times = data.draw(st.one_of(st.integers(2, 50), st.just([length])))
    how = {**start, "vertical": vertical, "duration": length, "samples": times}
    one, two = (follow(structure, motion, **how) for follow in (th.simulate, plain.simulate))
    assert one.overturned or one.outcome == "no uplift" or np.isfinite(one.rotation).all()
    difference = np.nanmax(np.abs(two.rotation - one.rotation), initial=0.0)
    if one.overturned == two.overturned and difference <= CLOSE * alpha:
        return
    with finer():
        own = np.abs(plain.simulate(structure, motion, **how).rotation - two.rotation)
    own = np.fmin(10.0 * own, LARGE * alpha)
    near, how = [], how | {"tolerance": TIGHT}
    for nudge in FARTHER:  # a start may have the energy of the barrier to the last bit
        begun = {name: value * (1.0 + nudge) for name, value in start.items()}
        near.append(th.simulate(structure, motion.scaled(1.0 + nudge), **how))
        near.append(th.simulate(structure, motion, **(how | begun)))
    if {other.outcome for other in near} == {one.outcome}:
        assert one.overturned == two.overturned, f"{one.outcome} and {two.outcome}"
        slack = 10.0 * np.nanmax(np.ptp([other.rotation for other in near], axis=0), initial=0.0)
        slack += np.nanmax(own, initial=0.0)
        assert difference <= CLOSE * alpha + slack, f"{difference / alpha:.2g} α apart"


def grids(several: list[Any], data: st.DataObject) -> None:
    structure, motion, vertical = data.draw(shaken(st.just(several[0])))
    factors = data.draw(st.lists(edged(0.0, 1.0), min_size=1, max_size=12))
    above = {"vertical": vertical}
    table = th.overturned_by(several, motion, factors, **above, scale_vertical=False)
    for one, row in zip(several, table, strict=True):
        ends = partial(th.judge, one, **above)
        alone = th.overturned_by(one, motion, factors, **above, scale_vertical=False)
        assert (row == alone).all(), "a row depends on the others"
        for factor, overturned in zip(factors, row, strict=True):
            scaled = motion.scaled(factor)
            end = ends(scaled)
            assert overturned == end.overturned or decided(ends, scaled, end) == math.inf
    block = structure.block()
    if isinstance(motion, Pulse):
        omega, sizes = motion.angular_frequency, abs(motion.amplitude) * np.array(factors)
        cells = th.overturning_map(structure, motion.shape, [omega], sizes)
        each = [
            th.Pulse(motion.shape, float(size), angular_frequency=omega) for size in cells.amplitude
        ]
    else:
        assume(motion.peak_acceleration > 1e-9)
        sizes = motion.peak_acceleration * np.array(factors)
        cells = th.overturning_map(block, motion, [solitary_size(block.frequency_parameter)], sizes)
        each = [motion.scaled(factor) for factor in factors]
    for scaled, peak in zip(each, cells.peak_rotation.values.ravel(), strict=True):
        cell = free_rocking.Outcome(math.isnan(peak), float(peak), 0)
        agree(block, scaled, partial(th.judge, structure), lambda *_, _cell=cell, **__: _cell)


def searches(case: Any) -> None:
    structure, motion, vertical = case
    above = {"vertical": vertical, "scale_vertical": False}
    ends = partial(th.judge, structure, vertical=vertical)

    def overturns(factor: float) -> bool:  # a search, which counts impacts, has other steps
        scaled = motion.scaled(factor)
        safe = not th.overturned_by(structure, motion, [factor], **above)[0]
        return not safe or decided(ends, scaled, ends(scaled)) == math.inf

    for one in th.overturning_intervals(structure, motion, (0.0, 1.5), resolution=0.05, **above):
        inside = [one.lower[1], *(one.upper or ())[:1]]
        assert all(map(overturns, inside)), f"{one} has safe ends"
    deep = th.lowest_overturning(structure, motion, (0.0, 1.5), floor=0.05, **above)
    grid = np.linspace(0.0, 1.5, 33)
    overturned = th.overturned_by(structure, motion, grid, **above)
    assert not (overturned & (grid < deep.factor)).any() if deep.bracket else not overturned.any()
    assert deep.bracket is None or overturns(deep.factor)


PROPERTIES = {
    endings: [shaken()],
    histories: [shaken(), st.data()],
    grids: [st.lists(structures, min_size=1, max_size=4), st.data()],
    searches: [shaken()],
}


def tried(held: Callable[..., None], number: int) -> int:
    """Try a property on new cases; return how many there were."""
    cases = 0

    @wraps(held)
    def timed(**drawn: Any) -> None:
        nonlocal cases
        cases, begin = cases + 1, time.process_time()
        try:
            held(**drawn)
        except ArithmeticError as error:  # of a history that bounces for too long, alone
            if type(error) is not ArithmeticError:
                raise
        taken = time.process_time() - begin
        assert taken < LONGEST, f"a case takes {taken:.0f} s"

    how = settings(
        max_examples=TURN,
        database=None,
        deadline=None,
        report_multiple_bugs=False,
        suppress_health_check=[*HealthCheck],
        phases=[Phase.generate, Phase.shrink],
    )
    seed(number)(how(given(*PROPERTIES[held])(timed)))()
    return cases


def main(minutes: float, first: int) -> int:
    """Try all properties in turns; print what was tried; return 1 if one failed, else 0."""
    end, cases = time.monotonic() + 60.0 * minutes, Counter[str]()
    warnings.simplefilter("error")
    warnings.filterwarnings("ignore", message="record: ")  # no plausible ground motion
    warnings.filterwarnings("ignore", message="no proof within")  # the outcome is then undecided
    for number, held in ((number, held) for number in count(first, APART) for held in PROPERTIES):
        if time.monotonic() > end and cases[held.__name__]:
            break
        try:
            cases[held.__name__] += tried(held, number)
        except Exception as error:
            print(f"{held.__name__} fails; to repeat it: python benchmarks/fuzz.py 1 {number}")
            print(*traceback.format_exception(error, limit=-2), sep="")
            return 1
    print(f"seed {first}:", ", ".join(f"{name} {n}" for name, n in cases.items()), "cases")
    return 0


if __name__ == "__main__":
    given_minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    sys.exit(main(given_minutes, int(sys.argv[2]) if len(sys.argv) > 2 else int(time.time())))
