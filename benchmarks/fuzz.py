"""Search for inputs on which the solvers disagree, or a public function fails to keep its word.

Hypothesis draws structures, motions and arguments with their edges: √r of 0 and 1, γ of 0 and ∞, no
amplitude, the level of uplift to the last bit, plateaus, single samples. The lanes of the kernel,
the scalar `simulate` and `judge`, and SciPy (`reference`) have to agree on each outcome that slight
changes of the motion leave as it is, and each other function with a second way to its result. An
error may be a ValueError, or the ArithmeticError of a history that bounces for too long.

    python benchmarks/fuzz.py [minutes, 1 unless given] [seed, of the clock unless given]

prints the calls of each function. The first failure ends it with its smallest case and its seed.
"""

import inspect
import math
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable
from contextlib import suppress
from functools import partial, wraps
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np
from hypothesis import HealthCheck, Phase, assume, given, seed, settings
from hypothesis import strategies as st

import topheavy
from topheavy.bodies import free_rocking
from topheavy.bodies.structures import RockingBlock, Structure
from topheavy.forces.frame import centre_height
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.ground.shapes import ENDING
from topheavy.second import reference
from steps.shared.newton_euler import ThreeBodies, accelerations, impact

#: Cases of a property in its turn, s of the processor for one, and the first two of all turns.
TURN, LONGEST = 25, 60.0
#: Relative changes of a motion that leave a decided outcome, and what a peak may then differ, α.
NUDGES, CLOSE = (-1e-6, -1e-8, 1e-8, 1e-6), 1e-6
FARTHER = (*NUDGES, -1e-5, 1e-5)
#: A tolerance whose change of a decided outcome is as slight.
TIGHT = 1e-13


class Counted:
    """The public interface; it counts what is taken from it."""

    def __init__(self) -> None:
        self.calls: Counter[str] = Counter()

    def __getattr__(self, name: str) -> Any:
        self.calls[name] += 1
        return getattr(topheavy, name)


th = Counted()


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
def frames(draw: st.DrawFn, lightest: float = 0.0, heaviest: float = math.inf) -> Any:
    column = th.Column(h := draw(st.floats(0.05, 1.0)), draw(st.floats(1.5, 12.0)) * h)
    ratio = draw(edged(lightest, min(heaviest, 50.0), heaviest, max(lightest, 1e-9)))
    return th.RockingFrame(column, ratio)


@st.composite
def bodies(draw: st.DrawFn) -> Structure:
    """Draw any structure that rocks."""
    frame = draw(frames())
    wide = draw(st.floats(2.1, 20.0)) * frame.column.half_width
    lengths = [draw(edged(0.0, 2.0)) for _ in range(2)]
    found = draw(
        st.sampled_from(
            [
                frame,
                frame.column,
                th.FixedMassColumn(frame.column, frame.mass_ratio, *lengths),
                th.MonolithicPortal(frame.column, frame.mass_ratio, wide, *lengths),
            ]
        )
    )
    assume(found.restitution >= 0.0)
    return found


structures = st.one_of(blocks(), bodies())


@st.composite
def motions(draw: st.DrawFn, structure: Structure, most: int = 40) -> Pulse | Record:
    """Draw a pulse that ends, or a record, from none to several times the level of uplift."""
    block = structure.block()
    level, p = block.uplift_acceleration, block.frequency_parameter
    beside = [math.nextafter(1.0, 2.0), math.nextafter(1.0, 0.0), 1.0 + 1e-9, 1.0]
    size = level * draw(edged(0.0, 12.0, *beside)) * draw(st.sampled_from([-1.0, 1.0]))
    if draw(st.booleans()):
        shape = draw(st.sampled_from(sorted(ENDING)))
        return th.Pulse(shape, size, p * draw(edged(0.2, 30.0, 1.0)))
    samples = st.one_of(st.floats(-1.0, 1.0), st.sampled_from([0.0, 1.0, 1.0, -1.0, 0.5]))
    values = draw(st.lists(samples, min_size=2, max_size=most))
    return th.Record(draw(st.floats(0.005, 1.0)) / p, size * np.array(values), unit="g")


@st.composite
def shaken(draw: st.DrawFn, given: st.SearchStrategy[Structure] = structures) -> tuple[Any, ...]:
    """Draw a structure, a motion, and with some records a vertical one."""
    structure = draw(given)
    motion, vertical = draw(motions(structure)), None
    if isinstance(motion, Record) and draw(st.booleans()):
        values = draw(st.lists(edged(-0.8, 0.8, 0.0), min_size=2, max_size=40))
        ratio = draw(edged(0.3, 3.0, 1.0, 0.5))
        vertical = th.Record(ratio * motion.time_step, values, unit="g")
    return structure, motion, vertical


Ends = Callable[..., free_rocking.Ending]


def decided(ends: Ends, motion: Any, found: free_rocking.Ending) -> float:
    """Return how far peaks may differ, rad; infinite where slight changes turn the outcome."""
    others = [ends(motion.scaled(1.0 + nudge)) for nudge in NUDGES]
    others.append(ends(motion, tolerance=TIGHT))
    if any(other.overturned != found.overturned for other in others):
        return math.inf
    return 0.0 if found.overturned else 10.0 * max(abs(one.peak - found.peak) for one in others)


def agree(block: RockingBlock, motion: Any, ends: Ends, other: Ends, why: str) -> None:
    """Hold the endings of two solvers, functions of a motion, against each other."""
    one, two = ends(motion), other(motion)
    same = one.overturned == two.overturned
    if same and (one.overturned or abs(one.peak - two.peak) <= CLOSE * block.slenderness):
        return
    slack = max(decided(ends, motion, one), decided(other, motion, two))
    assert slack == math.inf or same, f"{why}: {one} and {two}"
    if same:
        assert abs(one.peak - two.peak) <= slack + CLOSE * block.slenderness, f"{one}, {two}"


PROPERTIES: dict[Callable[..., None], tuple[st.SearchStrategy[Any], ...]] = {}


def over(*strategies: st.SearchStrategy[Any]) -> Callable[..., Any]:
    """Have a property tried on what the strategies draw."""

    def listed(held: Callable[..., None]) -> Callable[..., None]:
        PROPERTIES[held] = strategies
        return held

    return listed


@over(shaken())
def endings(case: Any) -> None:
    structure, motion, vertical = case
    block, above = structure.block(), {"vertical": vertical}
    ends = partial(th.judge, structure, **above)
    agree(block, motion, ends, partial(reference.judge, structure, **above), "judge, SciPy")
    whole, end = th.simulate(structure, motion, **above), ends(motion)
    if whole.overturned != end.overturned:
        assert decided(ends, motion, end) == math.inf, f"{whole.outcome}, {end}"
    elif not end.overturned:
        slack = decided(ends, motion, end)
        assert abs(whole.peak_rotation - end.peak) <= slack + CLOSE * block.slenderness
        assert np.isfinite(whole.rotation).all(), "a survivor without a rotation"
    assert (np.diff(whole.impacts) >= 0.0).all()


@over(shaken(), st.data())
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
    one, two = (follow(structure, motion, **how) for follow in (th.simulate, reference.simulate))
    assert one.overturned or one.outcome == "no uplift" or np.isfinite(one.rotation).all()
    apart = np.nanmax(np.abs(one.rotation - two.rotation), initial=0.0)
    if one.overturned == two.overturned and apart <= CLOSE * alpha:
        return
    near = [th.simulate(structure, motion.scaled(1.0 + nudge), **how) for nudge in FARTHER]
    for nudge in FARTHER:  # a start may have the energy of the barrier to the last bit
        begun = {name: value * (1.0 + nudge) for name, value in start.items()}
        near.append(th.simulate(structure, motion, **(how | begun)))
    near.append(th.simulate(structure, motion, **how, tolerance=TIGHT))
    if {each.outcome for each in near} == {one.outcome}:
        spread = max(np.nanmax(np.abs(each.rotation - one.rotation), initial=0.0) for each in near)
        assert one.overturned == two.overturned, f"{one.outcome} and {two.outcome}"
        assert apart <= CLOSE * alpha + 10.0 * spread, f"{apart / alpha:.2g} α apart"


@over(st.lists(structures, min_size=1, max_size=4), st.data())
def lanes(several: list[Any], data: st.DataObject) -> None:
    structure, motion, vertical = data.draw(shaken(st.just(several[0])))
    factors = data.draw(st.lists(edged(0.0, 1.0), min_size=1, max_size=12))
    above = {"vertical": vertical}
    table = th.overturned_together(several, motion, factors, **above, scale_vertical=False)
    for one, row in zip(several, table, strict=True):
        ends = partial(th.judge, one, **above)
        alone = th.overturned_by(one, motion, factors, **above, scale_vertical=False)
        assert (row == alone).all(), "a row depends on the others"
        for factor, overturned in zip(factors, row, strict=True):
            scaled = motion.scaled(factor)
            end = ends(scaled)
            assert overturned == end.overturned or decided(ends, scaled, end) == math.inf
    if isinstance(motion, Pulse):
        cells = th.overturning_map(
            structure,
            motion.shape,
            [motion.angular_frequency],
            abs(motion.amplitude) * np.array(factors),
        )
        each = [th.Pulse(motion.shape, float(a), motion.angular_frequency) for a in cells.amplitude]
    else:
        assume(motion.peak_acceleration > 1e-9)
        sizes = [topheavy.bodies.structures.solitary_size(several[0].block().frequency_parameter)]
        peaks = motion.peak_acceleration * np.array(factors)
        block = structure.block()
        cells = th.overturning_map_of_record(block, motion, sizes, peaks)
        structure, each = block, [motion.scaled(factor) for factor in factors]
    ends = partial(th.judge, structure)
    for k, pulse in enumerate(each):
        end, peak = ends(pulse), float(cells.peak_rotation.values.ravel()[k])
        slack = decided(ends, pulse, end)
        assert math.isnan(peak) == end.overturned or slack == math.inf
        close = slack + CLOSE * structure.block().slenderness
        assert end.overturned or math.isnan(peak) or abs(peak - end.peak) <= close


@over(shaken())
def searches(case: Any) -> None:
    structure, motion, vertical = case
    search = th.Search(structure, motion, (0.0, 1.5), vertical, False)
    above = {"vertical": vertical, "scale_vertical": False}
    found = th.overturning_intervals(structure, motion, (0.0, 1.5), resolution=0.05, **above)
    lowest = th.minimum_overturning(structure, motion, (0.0, 1.5), resolution=0.05, **above)
    assert (lowest is None) == (not found)
    assert not found or found[0].lower[0] <= lowest[0] <= lowest[1] <= found[0].lower[1]
    assert th.intervals_together([search, search], resolution=0.05) == [found, found]
    assert th.minima_together([search], resolution=0.05) == [lowest]
    for one in found:
        outcomes = th.overturned_by(structure, motion, [*one.lower, *(one.upper or ())], **above)
        assert outcomes[1:3].all(), f"{one} has safe ends"
    deep = th.lowest_overturning(structure, motion, (0.0, 1.5), floor=0.05, **above)
    grid = np.linspace(0.0, 1.5, 33)
    overturned = th.overturned_by(structure, motion, grid, **above)
    assert not (overturned & (grid < deep.factor)).any() if deep.bracket else not overturned.any()
    assert deep.bracket is None or th.overturned_by(structure, motion, [deep.factor], **above)[0]


@over(shaken())
def proofs(case: Any) -> None:
    structure, motion, _ = case
    found, end = th.proven.outcome(structure, motion), th.judge(structure, motion)
    if found.outcome != "undecided":
        assert end.overturned == (found.outcome == "overturns"), f"proven {found}, judged {end}"
        low, high = found.peak or (end.peak, end.peak)
        # Rounding grows by exp(pt) where a long push just lifts the block.
        close = max(CLOSE, 1e-5) * structure.block().slenderness
        assert end.overturned or low - close <= end.peak <= high + close, f"{found}, {end}"


@over(st.lists(structures, min_size=1, max_size=3), st.data())
def curves(several: list[Any], data: st.DataObject) -> None:
    draw = motions(several[0]).filter(
        lambda m: isinstance(m, Record) and m.peak_acceleration > 1e-9
    )
    shaking = data.draw(st.lists(draw, min_size=1, max_size=4))
    levels = sorted(data.draw(st.sets(st.floats(0.05, 5.0), min_size=1, max_size=4)))
    found = th.fragility(several, shaking, levels, "PGA", resamples=100)
    for i, motion in enumerate(shaking):
        factors = np.array(levels) / motion.peak_acceleration
        for j, one in enumerate(several):
            assert (found.outcomes[i, j] == th.overturned_by(one, motion, factors)).all()
    share = found.curves.probability.values
    assert (share == found.outcomes.mean(axis=0)).all()
    low, high = found.curves.probability_low.values, found.curves.probability_high.values
    assert ((low <= share) & (share <= high)).all()


@over(frames(1e-3, 50.0), st.data())
def forces(frame: Any, data: st.DataObject) -> None:
    """The forces in closed form against Newton and Euler for three bodies."""
    column, gamma = frame.column, frame.mass_ratio
    cap = th.Cap(
        column.half_width * data.draw(st.floats(2.1, 30.0)), data.draw(st.floats(0.05, 2.0))
    )
    theta = (
        data.draw(st.floats(1e-6, 1.2)) * frame.slenderness * data.draw(st.sampled_from([-1, 1]))
    )
    rate = data.draw(st.floats(-2.0, 2.0)) * column.frequency_parameter
    ground = data.draw(st.floats(-2.0, 2.0))
    three = ThreeBodies(frame, cap.span, 2.0 * cap.half_depth)
    side, weight = int(math.copysign(1, theta)), 2.0 * (1.0 + gamma) * th.STANDARD_GRAVITY
    q, q_rate = np.zeros(9), np.zeros(9)
    q[[2, 5]], q_rate[[2, 5]] = theta, rate
    _, expected = accelerations(three, (side, side), q, q_rate, ground)
    found = th.contact_forces(frame, cap, theta, rate, ground)
    got = np.array([[one.horizontal, one.vertical] for one in found.contacts], dtype=float)
    scale = 1.0 + np.abs(expected).max() / weight
    assert np.abs(got - expected / weight).max() <= 1e-9 * scale * cap.span / column.half_width
    whole = th.frame_forces(frame, cap, theta, rate, ground)
    assert abs(whole.base_shear - expected[:2, 0].sum() / weight) <= 1e-9 * scale
    course = (np.array([[0.0, each]]) for each in (theta, rate, ground))
    largest = th.largest_forces(frame, cap, *course)[0]
    assert largest[0] == abs(whole.base_shear)
    assert largest[1] == abs(whole.overturning_moment)
    alone = th.column_forces(column, theta, rate, ground)
    still = th.contact_forces(th.RockingFrame(column, 0.0), cap, theta, rate, ground)
    assert abs(2.0 * still.base_left.vertical - alone.vertical) <= 1e-9 * scale
    tan, small = math.tan(frame.slenderness), 1e-6
    beyond = th.frame_forces(frame, cap, -1e-14, 0.0, tan + small).base_shear
    assert abs(beyond - tan - small * th.base_shear_slope(frame)) <= 1e-10
    assert abs(th.frame_forces(frame, cap, 0.0, 0.0, tan / 2).overturning_moment) <= (
        (1.0 + 1e-12) * centre_height(frame, cap) * tan / 2
    )
    assume(column.restitution >= 0.0 and frame.restitution >= 0.0)
    behind, impulses = impact(three, (side, side), _before(three, -side, abs(rate)))
    struck = th.impact_impulses(frame, cap, side * abs(rate))
    got = np.array([[one.horizontal, one.vertical] for one in struck.contacts], dtype=float)
    mass = 2.0 * (1.0 + gamma)
    assert abs(behind[2] - side * frame.restitution * abs(rate)) <= 1e-9 * (1.0 + abs(rate))
    bound = 1e-9 * (1.0 + np.abs(impulses).max() / mass) * cap.span / column.half_width
    assert np.abs(got - impulses / mass).max() <= bound
    still = th.impact_impulses(th.RockingFrame(column, 0.0), cap, abs(rate))
    alone = th.column_impulse(column, abs(rate))
    assert abs(2.0 * still.base_left.vertical - alone.vertical) <= 1e-9 * (1.0 + abs(rate))


def _before(three: ThreeBodies, side: int, rate: float) -> np.ndarray:
    """Return q̇ of the upright frame that turns about the corners of a side, towards the other."""
    found, column = np.zeros(9), three.frame.column
    turn = -side * rate
    found[[2, 5]] = turn
    found[[0, 3]], found[[1, 4]] = turn * column.half_height, turn * side * column.half_width
    found[6], found[7] = 2.0 * turn * column.half_height, 2.0 * turn * side * column.half_width
    return found


@over(frames(1e-3, 50.0), st.data())
def fixed(frame: Any, data: st.DataObject) -> None:
    cap = th.Cap(3.0 * frame.column.half_width, data.draw(st.floats(0.05, 1.0)))
    held = th.FixedFrame(frame, cap, data.draw(st.sampled_from(["pinned", "guided"])))
    motion = data.draw(motions(frame, most=10))
    period = data.draw(st.floats(0.1, 3.0)) * min(1.0, motion.duration)
    (one,), two = (
        th.peak_elastic([held], motion, period),
        th.peak_elastic_by_scipy(held, motion, period),
    )
    rigid = th.peak_rigid(held, motion)
    scale = np.abs([*rigid]) + np.abs([*two]) + 1e-12
    assert (np.abs(np.subtract(one, two)) <= 2e-3 * scale).all(), f"{one}, {two}"


WORDS = st.sampled_from(
    ["g", "cm/s2", "m/s/s", "units of", "NPTS=", "DT=", "5", "1e-2", ",", "\n", "%"]
)


@over(shaken(), st.lists(st.one_of(WORDS, st.text(max_size=8))), st.integers(0, 400))
def files(case: Any, words: list[str], place: int) -> None:
    """What is written is read; what is spoilt is read, or refused by a ValueError."""
    motion = case[1]
    assume(isinstance(motion, Record) and 1e-6 < motion.peak_acceleration < 5.0)
    step, values = round(motion.time_step, 6), [float(value) for value in motion.acceleration]
    assume(step > 2e-6)
    lines = "\n".join(map(repr, values))
    rows = "\n".join(f"{k * step!r},{value!r}" for k, value in enumerate(values))
    texts = {
        "a.AT2": f"A site\nUNITS OF G\nNPTS= {len(values)}, DT= {step:.6f} SEC\n{lines}\n",
        "a.csv": f"time (s),acceleration (g)\n{rows}\n",
    }
    with tempfile.TemporaryDirectory() as folder:
        for name, read in {"a.AT2": th.read_at2, "a.csv": th.read_csv}.items():
            path = Path(folder, name)
            path.write_text(texts[name], encoding="utf-8")
            for one in (read(path), th.read_record(path)):
                assert (one.acceleration == values).all()
                assert math.isclose(one.time_step, step, rel_tol=1e-9)
            spoilt = texts[name][:place] + " ".join(words) + texts[name][place:]
            path.write_text(spoilt, encoding="utf-8", errors="replace")
            with suppress(ValueError):
                read(path)


ODD = st.sampled_from(
    [math.nan, math.inf, -math.inf, -1.0, 0.0, 1e4, -1e4, 1e-2, "1", None, True, [], [1.0], {}]
)
COLUMN, PULSE = topheavy.Column(0.5, 3.0), topheavy.Pulse("one-sine", 0.3, 6.0)
FRAME, CAP = topheavy.RockingFrame(COLUMN, 1.0), topheavy.Cap(3.0, 0.3)
RECORD = topheavy.Record(0.05, 0.4 * np.sin(np.arange(60.0)))
PORTAL = topheavy.MonolithicPortal(COLUMN, 1.0, 5.0)
FIXED = topheavy.FixedFrame(FRAME, CAP, "pinned")
MOVED = {"rotation": 0.1, "velocity": 0.0, "ground_acceleration": 0.2}
SOUGHT = {"structure": COLUMN, "excitation": PULSE, "scale_range": (0.5, 2.0)}
SCALED = {"excitation": RECORD, "factors": [0.5, 1.0]}
HELD = {"excitation": RECORD, "period": 0.4}
# fmt: off
CALLS: dict[str, dict[str, Any]] = {  # what may be spoilt is not what a type has checked
    "Cap": {"span": 3.0, "half_depth": 0.3},
    "Column": {"half_width": 0.5, "half_height": 3.0},
    "FixedMassColumn": {"column": COLUMN, "mass_ratio": 1.0, "cap_width": 1.0, "cap_depth": 0.1},
    "MonolithicPortal": {"column": COLUMN, "mass_ratio": 1.0, "span": 4.0, "overhang": 0.1},
    "Pulse": {"shape": "one-sine", "amplitude": 0.3, "angular_frequency": 6.0},
    "Record": {"time_step": 0.1, "acceleration": [0.0, 0.5, 0.0]},
    "RockingBlock": {"frequency_parameter": 2.0, "slenderness": 0.2, "restitution": 0.9},
    "RockingFrame": {"column": COLUMN, "mass_ratio": 1.0},
    "cap_displacement": {"column": COLUMN, "rotation": 0.1},
    "column_forces": {"column": COLUMN, **MOVED},
    "column_impulse": {"column": COLUMN, "velocity": 0.3},
    "contact_forces": {"frame": FRAME, "cap": CAP, **MOVED},
    "fragility": {"structures": [COLUMN], "motions": [RECORD], "levels": [0.1, 0.4]},
    "frame_forces": {"frame": FRAME, "cap": CAP, **MOVED},
    "impact_impulses": {"frame": FRAME, "cap": CAP, "velocity": 0.3},
    "judge": {"structure": FRAME, "excitation": PULSE, "tolerance": 1e-9, "vertical": None},
    "largest_forces": {"frame": FRAME, "cap": CAP} | {k: [[0.0, v]] for k, v in MOVED.items()},
    "lowest_overturning": {**SOUGHT, "floor": 0.1},
    "minimum_overturning": {**SOUGHT, "resolution": 0.1},
    "overturned_by": {"structure": COLUMN, **SCALED},
    "overturned_together": {"structures": [COLUMN], **SCALED},
    "overturning_intervals": {**SOUGHT, "resolution": 0.1, "most_impacts": 3},
    "overturning_map": {"structure": COLUMN, "shape": "one-sine", "angular_frequencies": [6.0],
                        "amplitudes": [0.4]},
    "overturning_map_of_record": {"structure": FRAME, "record": RECORD, "sizes": [1.0, 3.0],
                                  "peak_accelerations": [0.4]},
    "peak_elastic": {"fixed": [FIXED], **HELD},
    "peak_elastic_by_scipy": {"fixed": FIXED, **HELD},
    "peak_rigid": {"fixed": FIXED, "excitation": PULSE},
    "resting_portal_forces": {"portal": PORTAL, "bases": "fixed", "ground_acceleration": 0.1},
    "rocking_portal_forces": {"portal": PORTAL, **MOVED},
    "simulate": {"structure": COLUMN, "excitation": PULSE, "rotation": 0.01, "velocity": 0.1,
                 "duration": 2.0, "samples": 5, "tolerance": 1e-9},
}
# fmt: on


@over(st.sampled_from(sorted(CALLS)), st.data())
def refusals(name: str, data: st.DataObject) -> None:
    """An odd argument is taken, or refused by a ValueError: there is no other error."""
    key = data.draw(
        st.sampled_from(sorted({*CALLS[name]} - {"frame", "cap", "column", "fixed", "portal"}))
    )
    arguments = CALLS[name] | {key: data.draw(ODD)}
    with suppress(ValueError), np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it asks whether a number is meant
        getattr(th, name)(**arguments)


def public() -> set[str]:
    """Return the names of all public functions."""
    return {name for name in dir(topheavy) if inspect.isfunction(getattr(topheavy, name))}


def tried(held: Callable[..., None], number: int, most: int) -> int:
    """Try a property on as many cases at most; return how many there were."""
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
        max_examples=most,
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
    for unlikely in (
        "few records exceed",
        "few exceed",
        "few pulses exceed",
        "the same unit",
        "few are longer",
    ):
        warnings.filterwarnings("ignore", message=f".*{unlikely}")
    for number, held in ((number, held) for number in count(first) for held in PROPERTIES):
        if time.monotonic() > end and cases[held.__name__]:
            break
        try:
            cases[held.__name__] += tried(held, number, TURN)
        except Exception as error:
            print(f"{held.__name__} fails; to repeat it: make fuzz SEED={number}")
            print(*traceback.format_exception(error, limit=-2), sep="")
            return 1
    print(f"seed {first}:", ", ".join(f"{name} {n}" for name, n in cases.items()), "cases")
    print("calls:", ", ".join(f"{name} {th.calls[name]}" for name in sorted(public())))
    return 0


if __name__ == "__main__":
    given_minutes = float(sys.argv[1]) if len(sys.argv) > 1 else 1.0
    sys.exit(main(given_minutes, int(sys.argv[2]) if len(sys.argv) > 2 else int(time.time())))
