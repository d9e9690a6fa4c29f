"""The outcome of a motion from rest, proven.

    survives | overturns | undecided

A narrow problem that stays undecided is tried again with more digits and terms. A box of factors or
structures is not: its own width decides. Infinitely many impacts in a finite time end in rest.
"""

from __future__ import annotations

from typing import Any

from topheavy import checks
from topheavy.bodies.structures import Structure
from topheavy.ground.excitation import no_excitation
from topheavy.ground.pulses import Pulse
from topheavy.ground.records import Record
from topheavy.proven.balls import Undecided, arb, precision, within
from topheavy.proven.blocks import Balls, BlockBox, Range, enclosed
from topheavy.proven.forcing import Forcing, prepared
from topheavy.proven.march import March, Outcome, Rest

LADDER = ((72, 1e-13), (104, 1e-20), (136, 1e-28), (264, 1e-60), (392, 1e-95), (520, 1e-130))
"""Bits of the balls, and what the last terms of a step may amount to, relative to 1 rad."""


def outcome(
    structure: Structure | BlockBox,
    excitation: Pulse | Record,
    *,
    factor: Range = 1.0,
    linearised: bool = False,
    bits: int = 72,
    bounded: bool = False,
    trace: list[dict[str, Any]] | None = None,
) -> Outcome:
    """Return whether a structure at rest survives a ground motion, proven, or that it is undecided.

    Parameters
    ----------
    structure : Structure or BlockBox
        Column, RockingFrame, FixedMassColumn and MonolithicPortal are enclosed from their
        dimensions; the numbers of a RockingBlock are exact; a BlockBox is a box of blocks.
    excitation : Pulse or Record
        One that ends. Each float stands for the decimal that it is printed as.
    factor : float or (float, float)
        On the acceleration; a pair stands for all factors between, if they share an outcome.
    linearised : bool
        Whether the structure obeys the linearised equation.
    bits : int
        The least precision of the balls: up to 520.
    bounded : bool
        Whether a motion under a pulse that cannot be followed is bounded instead, by the lemma of
        `topheavy.proven.bounds`: for boxes of factors that survive.
    trace : list, optional
        Filled with the steps of the proof, for a certificate (`topheavy.proven.certificate`).

    Returns
    -------
    Outcome
        "survives" and "overturns" are as defined in `topheavy.judge`; all impacts count.

    Raises
    ------
    ValueError
        For no or an endless excitation, a factor that is not finite or does not ascend, more bits
        than 520, and a structure whose √r is negative.
    """
    if not isinstance(excitation, (Pulse, Record)):
        raise no_excitation(excitation)
    ends = factor if isinstance(factor, tuple) else (factor, factor)
    low, high = (checks.finite("factor", end) for end in ends)
    if low > high:
        raise ValueError(f"factor is ({low:.6g}, {high:.6g}); expected the lower end first")
    rungs = [rung for rung in LADDER if rung[0] >= bits]
    if not rungs:
        raise ValueError(f"bits is {bits}; expected at most {LADDER[-1][0]}")
    if low < high or bounded or isinstance(structure, BlockBox):
        del rungs[1:]
    if bounded and not isinstance(excitation, Pulse):
        raise ValueError("bounded is for a Pulse; a Record has none")
    settings: dict[int, tuple[Balls, Forcing, arb]] = {}
    rest, height = Rest(arb(0)), 0
    while True:
        bits, accuracy = rungs[height]
        with precision(bits):
            if height not in settings:
                range_ = within((low, high) if low < high else low)
                settings[height] = enclosed(structure, linearised), prepared(excitation), range_
            march = March(*settings[height], bits, accuracy, rest, trace)
            march.bounded = bounded
            try:
                found = march.run(until_rest=height > 0)
            except Undecided as undecided:
                if height + 1 == len(rungs) or str(undecided) == "impacts":
                    return Outcome("undecided", march.impacts, None, str(undecided), bits)
                rest, height = march.rest, height + 1
                continue
        if found is not None:
            return found
        rest, height = march.rest, 0
