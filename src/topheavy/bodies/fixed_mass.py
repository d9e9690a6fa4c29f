"""The cap beam's mass fixed rigidly: to the top of one column (a vase), or to both (a portal).

    FixedMassColumn(column, γ)         ─┐
                                        ├─►  RockingBlock(p', α', √r')
    MonolithicPortal(column, γ, span)  ─┘

Either is one rigid body, symmetric about its vertical axis, that rocks about the edges of its base.
With half its base B, the height H of its centre of gravity and its moment of inertia I about an
edge, for the mass M,

    tan α' = B/H,    p'² = M g √(B² + H²) / I,    √r' = 1 − 2 M B²/I

src/derivation/fixed_mass.py of the repository derives all three from the balances of column and
cap. The paper has neither structure; they are what its cap beam would do if it could not turn
against the columns.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from topheavy import checks
from topheavy.bodies.structures import (
    STANDARD_GRAVITY,
    Column,
    RockingBlock,
    checked_column,
    checked_mass_ratio,
    rocking_block,
    solitary_size,
    weights,
)


@dataclass(frozen=True)
class RigidBody:
    """One rigid body, symmetric about its vertical axis, on the two edges of its base."""

    column: Column
    mass_ratio: float

    def __post_init__(self) -> None:
        checked_column(self.column)
        checks.set_fields(self, mass_ratio=checked_mass_ratio(self.mass_ratio))

    @property
    def _cap(self) -> tuple[float, float, float]:
        """Distance of the columns' axes from the middle, width and depth of the cap, m."""
        raise NotImplementedError

    @property
    def half_base(self) -> float:
        """B, m: from the vertical axis to the edge that it rocks about."""
        return self._cap[0] + self.column.half_width

    @property
    def centre_height(self) -> float:
        """H, m: of the centre of gravity above the ground."""
        h, cap = self.column.half_height, weights(self.mass_ratio)[1]
        return (1.0 - cap) * h + cap * (2.0 * h + self._cap[2] / 2.0)

    @property
    def inertia(self) -> float:
        """I/M, m²: moment of inertia about the edge over the mass."""
        b, h, (axis, width, depth) = self.column.half_width, self.column.half_height, self._cap
        cap, base = weights(self.mass_ratio)[1], self.half_base**2
        of_columns = (b**2 + h**2) / 3.0 + base + axis**2 + h**2
        of_cap = (width**2 + depth**2) / 12.0 + base + (2.0 * h + depth / 2.0) ** 2
        return (1.0 - cap) * of_columns + cap * of_cap

    @property
    def slenderness(self) -> float:
        """α' = atan(B/H), rad."""
        return math.atan2(self.half_base, self.centre_height)

    @property
    def frequency_parameter(self) -> float:
        """p' = √(M g √(B² + H²)/I), rad/s."""
        distance = math.hypot(self.half_base, self.centre_height)
        return math.sqrt(STANDARD_GRAVITY * distance / self.inertia)

    @property
    def equivalent_size(self) -> float:
        """3g/4p'², m: size R of the solitary rectangular column with this p'."""
        return solitary_size(self.frequency_parameter)

    @property
    def restitution(self) -> float:
        """√r' = 1 − 2MB²/I, from the balance of impulses; may be negative when stocky."""
        return 1.0 - 2.0 * self.half_base**2 / self.inertia

    @property
    def uplift_acceleration(self) -> float:
        """tan α': the ground acceleration (g) above which it uplifts."""
        return self.half_base / self.centre_height

    def block(self, restitution: float | None = None) -> RockingBlock:
        """Return the rocking block of this body, with √r' unless a restitution is given.

        ValueError where √r' is negative: such a body does not keep rocking. The message names the
        largest α of a body with the same H and the same central moment of inertia.
        """
        central = self.inertia - self.half_base**2  # √r' = 0 where B² reaches this
        largest = math.atan2(math.sqrt(central), self.centre_height)
        return rocking_block(self, restitution, largest)


@dataclass(frozen=True)
class FixedMassColumn(RigidBody):
    """A column with a cap fixed rigidly to its top: a T, or a vase.

    Parameters
    ----------
    column : Column
    mass_ratio : float
        γ, the mass of the cap over that of the column: the share of the cap beam that one column
        of a `RockingFrame` with this γ carries. From 0 to `math.inf`.
    cap_width, cap_depth : float
        Of the cap, a homogeneous rectangle centred on the column, m. Both are 0 for a mass that is
        concentrated at the top.

    Raises
    ------
    ValueError
        For a γ or a length outside its range.

    Examples
    --------
    >>> th.FixedMassColumn(th.Column(0.5, 3.0), mass_ratio=1.0).block().slenderness
    0.11065722117389565
    """

    cap_width: float = 0.0
    cap_depth: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.set_fields(
            self,
            cap_width=checks.not_negative("cap_width", self.cap_width, "m"),
            cap_depth=checks.not_negative("cap_depth", self.cap_depth, "m"),
        )

    @property
    def _cap(self) -> tuple[float, float, float]:
        return 0.0, self.cap_width, self.cap_depth


@dataclass(frozen=True)
class MonolithicPortal(RigidBody):
    """Two columns with the cap beam fixed rigidly to both: it rocks about its outer edges.

    Parameters
    ----------
    column : Column
        Either of the two.
    mass_ratio : float
        γ = m_b / 2 m_c, as of `RockingFrame`.
    span : float
        L, m, between the axes of the columns, which must not overlap.
    cap_depth, overhang : float
        Depth of the cap beam, and how far it extends beyond the outer faces of the columns, m.

    Raises
    ------
    ValueError
        For a γ or a length outside its range.

    Examples
    --------
    >>> portal = th.MonolithicPortal(th.Column(0.5, 3.0), mass_ratio=1.0, span=5.0)
    >>> portal.block().slenderness
    0.5880026035475675
    """

    span: float
    cap_depth: float = 0.0
    overhang: float = 0.0

    def __post_init__(self) -> None:
        super().__post_init__()
        checks.set_fields(
            self,
            span=checks.wider_than_column(self.span, 2.0 * self.column.half_width),
            cap_depth=checks.not_negative("cap_depth", self.cap_depth, "m"),
            overhang=checks.not_negative("overhang", self.overhang, "m"),
        )

    @property
    def _cap(self) -> tuple[float, float, float]:
        width = self.span + 2.0 * (self.column.half_width + self.overhang)
        return self.span / 2.0, width, self.cap_depth
