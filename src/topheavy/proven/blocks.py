"""The block of a structure in balls: α, p and √r enclosed from the structure's own dimensions.

A float of the structure stands for the decimal that it is printed as. α, p and √r are no decimals:
to take the floats of `Column.block()` would prove something about another column.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from topheavy.bodies.fixed_mass import FixedMassColumn, MonolithicPortal
from topheavy.bodies.structures import (
    STANDARD_GRAVITY,
    Column,
    RockingBlock,
    RockingFrame,
    Structure,
    as_block,
)
from topheavy.proven.balls import arb, exact, within

Range = float | tuple[float, float]


@dataclass(frozen=True)
class BlockBox:
    """A box of rocking blocks: each value a number, or a pair (low, high) between which it lies.

    The values are those of `topheavy.RockingBlock`, in rad/s and rad.

    Raises
    ------
    ValueError
        For a pair that does not ascend, or a value outside the range of `RockingBlock`.
    """

    frequency_parameter: Range
    slenderness: Range
    restitution: Range
    linearised: bool = False

    def __post_init__(self) -> None:
        names = ("frequency_parameter", "slenderness", "restitution")
        for name in names:
            low, high = _ends(getattr(self, name))
            if not low <= high:
                raise ValueError(f"{name} is ({low!r}, {high!r}); expected the lower end first")
        for end in (0, 1):
            p, alpha, root = (_ends(getattr(self, name))[end] for name in names)
            RockingBlock(p, alpha, root)

    def block(self) -> RockingBlock:
        """Return the block of the lower ends."""
        ends = self.frequency_parameter, self.slenderness, self.restitution
        p, alpha, root = (_ends(x)[0] for x in ends)
        return RockingBlock(p, alpha, root, self.linearised)


@dataclass(frozen=True)
class Balls:
    """α (rad), p (rad/s) and √r as balls, and which equation they obey."""

    slenderness: arb
    frequency_parameter: arb
    restitution: arb
    linearised: bool

    @property
    def level(self) -> arb:
        """Ground acceleration (g) above which it uplifts: tan α, or α when linearised."""
        return self.slenderness if self.linearised else self.slenderness.tan()


def enclosed(structure: Structure | BlockBox, linearised: bool) -> Balls:
    """Return the balls of a structure; of one without dimensions, those of its block's decimals.

    Raises
    ------
    ValueError
        For what is no structure, or one whose √r is negative.
    """
    block = as_block(structure)
    linearised = linearised or block.linearised
    match structure:
        case RockingFrame(column=column, mass_ratio=ratio):
            return _frame(column, ratio, linearised)
        case Column():
            return _frame(structure, 0.0, linearised)
        case FixedMassColumn() | MonolithicPortal():
            return _one_body(structure, linearised)
        case _:
            of = structure if isinstance(structure, BlockBox) else block
            p, alpha, root = map(within, (of.frequency_parameter, of.slenderness, of.restitution))
            return Balls(alpha, p, root, linearised)


def _ends(value: Range) -> tuple[float, float]:
    return value if isinstance(value, tuple) else (value, value)


def _frame(column: Column, mass_ratio: float, linearised: bool) -> Balls:
    b, h = exact(column.half_width), exact(column.half_height)
    square = b * b + h * h
    if mass_ratio == math.inf:
        size, cap = exact(1.5), arb(1)
    else:
        gamma = exact(mass_ratio)
        size, cap = (1 + 3 * gamma) / (1 + 2 * gamma), 3 * gamma / (1 + 3 * gamma)  # Eq. (24)
    p = (3 * exact(STANDARD_GRAVITY) / (4 * square.sqrt() * size)).sqrt()  # Eq. (23)
    sine = b * b / square  # sin²α
    root = (1 - cap) * (1 - 3 * sine / 2) + cap * (1 - 2 * sine)  # Eq. (25)
    return Balls((b / h).atan(), p, root, linearised)


def _one_body(body: FixedMassColumn | MonolithicPortal, linearised: bool) -> Balls:
    """tan α' = B/H, p'² = g √(B² + H²)/(I/M), √r' = 1 − 2 B²/(I/M): `bodies.fixed_mass`."""
    b, h = exact(body.column.half_width), exact(body.column.half_height)
    depth = exact(body.cap_depth)
    if isinstance(body, MonolithicPortal):
        axis = exact(body.span) / 2
        width = 2 * (axis + b + exact(body.overhang))
    else:
        axis, width = arb(0), exact(body.cap_width)
    gamma = body.mass_ratio
    cap = arb(1) if gamma == math.inf else exact(gamma) / (1 + exact(gamma))
    base, top = axis + b, 2 * h + depth / 2
    centre = (1 - cap) * h + cap * top
    inertia = (1 - cap) * ((b**2 + h**2) / 3 + base**2 + axis**2 + h**2)
    inertia += cap * ((width**2 + depth**2) / 12 + base**2 + top**2)
    distance = (base**2 + centre**2).sqrt()
    p = (exact(STANDARD_GRAVITY) * distance / inertia).sqrt()
    return Balls((base / centre).atan(), p, 1 - 2 * base**2 / inertia, linearised)
