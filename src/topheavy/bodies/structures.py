"""A free-standing column, a rocking frame, and the rocking block that both become.

Makris & Vassiliou (2014): between impacts the frame obeys the equation of motion of a solitary
column, Eq. (23) against Eq. (3), with the same slenderness and a lower frequency parameter. Hence
the dynamics of either needs three numbers only: p, α and √r.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

from topheavy import checks
from topheavy.checks import short_repr

STANDARD_GRAVITY = 9.81
"""Acceleration of gravity g, m/s², as the paper's numbers imply it (2.15 m/s² = 0.219 g, p. 4)."""

MAX_COLUMNS = 10_000
"""Of a frame."""


@dataclass(frozen=True)
class RockingBlock:
    """The oscillator: frequency parameter, slenderness, restitution, and which equation it obeys.

    Parameters
    ----------
    frequency_parameter : float
        p of a column, p̂ of a frame, rad/s.
    slenderness : float
        α, rad, in (0, π/2).
    restitution : float
        √r, the ratio of the angular velocities after and before an impact, in [0, 1].
    linearised : bool
        Whether it obeys the equation linearised for slender columns (Allen et al. 1986) instead of
        the exact one, Eq. (23).

    Raises
    ------
    ValueError
        For a value outside its range.

    Examples
    --------
    >>> th.RockingBlock(2.0, 0.25, 0.9).linear().uplift_acceleration
    0.25
    """

    frequency_parameter: float
    slenderness: float
    restitution: float
    linearised: bool = False

    def __post_init__(self) -> None:
        p = self.frequency_parameter
        checks.set_fields(
            self,
            frequency_parameter=checks.positive("frequency_parameter", p, "rad/s"),
            slenderness=checks.within_quarter_turn("slenderness", self.slenderness),
            restitution=checks.fraction("restitution", self.restitution),
            linearised=checks.truth("linearised", self.linearised),
        )

    @property
    def uplift_acceleration(self) -> float:
        """Ground acceleration (g) above which it uplifts: tan α, or α when linearised."""
        return self.slenderness if self.linearised else math.tan(self.slenderness)

    def with_restitution(self, value: float) -> RockingBlock:
        """Return the same block with another √r in [0, 1]."""
        return replace(self, restitution=value)

    def linear(self) -> RockingBlock:
        """Return the same block under the linearised equation of motion."""
        return replace(self, linearised=True)

    def block(self) -> RockingBlock:
        """Return the block itself, so that columns, frames and blocks are used alike."""
        return self


@dataclass(frozen=True)
class Column:
    """A free-standing rigid rectangular column.

    Parameters
    ----------
    half_width, half_height : float
        b and h, m; otherwise than positive and finite, they raise ValueError.

    Examples
    --------
    >>> th.Column.of_dimensions(width=1.0, height=6.0)
    Column(half_width=0.5, half_height=3.0: 1 m wide, 6 m high)
    """

    half_width: float
    half_height: float

    def __post_init__(self) -> None:
        checks.set_fields(
            self,
            half_width=checks.positive("half_width", self.half_width, "m"),
            half_height=checks.positive("half_height", self.half_height, "m"),
        )

    def __repr__(self) -> str:
        """Return both fields and, as these are easily mistaken for the whole, the dimensions."""
        return (
            f"Column(half_width={self.half_width!r}, half_height={self.half_height!r}: "
            f"{2.0 * self.half_width:.6g} m wide, {2.0 * self.half_height:.6g} m high)"
        )

    @classmethod
    def of_dimensions(cls, *, width: float, height: float) -> Column:
        """Return the column of a width 2b and a height 2h, m."""
        return cls(
            checks.positive("width", width, "m") / 2.0, checks.positive("height", height, "m") / 2.0
        )

    @property
    def size(self) -> float:
        """R = √(b² + h²), m: half the diagonal (p. 2)."""
        return math.hypot(self.half_width, self.half_height)

    @property
    def slenderness(self) -> float:
        """α = atan(b/h), rad (p. 2)."""
        return math.atan2(self.half_width, self.half_height)

    @property
    def frequency_parameter(self) -> float:
        """p = √(3g/4R), rad/s, of Eq. (3)."""
        return math.sqrt(3.0 * STANDARD_GRAVITY / (4.0 * self.size))

    @property
    def restitution(self) -> float:
        """√r = 1 − (3/2) sin²α (Housner 1963, below Eq. (25)); negative beyond α = 54.7°."""
        return 1.0 - 1.5 * math.sin(self.slenderness) ** 2

    @property
    def uplift_acceleration(self) -> float:
        """tan α: the ground acceleration (g) above which it uplifts."""
        return math.tan(self.slenderness)

    def block(self, restitution: float | None = None) -> RockingBlock:
        """Return the rocking block of this column, with Housner's √r unless one is given.

        ValueError where Housner's √r is negative: such a column does not keep rocking.
        """
        return rocking_block(self, restitution, largest_slenderness(0.0))


@dataclass(frozen=True)
class RockingFrame:
    """Two or more equal free-standing columns under a freely supported rigid cap beam.

    Parameters
    ----------
    column : Column
        Each of them.
    mass_ratio : float
        γ = m_b / (N m_c), the mass of the cap beam over that of its columns (of two, m_b / 2 m_c);
        from 0 (the solitary column) to `math.inf` (the limit of Allen et al. 1986: columns without
        mass). A negative one raises ValueError.
    columns : int
        N, 2 or more: a cap beam on one column would tilt. The motion depends on N by γ alone, the
        forces at the contacts are computed for two.

    Examples
    --------
    >>> th.RockingFrame(th.Column(0.5, 3.0), mass_ratio=2.0).block().restitution
    0.9478764478764479
    """

    column: Column
    mass_ratio: float
    columns: int = 2

    def __post_init__(self) -> None:
        checked_column(self.column)
        checks.set_fields(self, mass_ratio=checked_mass_ratio(self.mass_ratio))
        object.__setattr__(self, "columns", checks.whole("columns", self.columns, 2, MAX_COLUMNS))

    @classmethod
    def of_masses(
        cls, column: Column, cap_mass: float, column_mass: float, columns: int = 2
    ) -> RockingFrame:
        """Return the frame by m_b of its cap beam and m_c of one column, in the same unit.

        The number N of columns enters by γ = m_b/(N m_c) alone; two give the paper's m_b/2m_c.
        src/derivation/mechanics.py of the repository derives the motion and √r for every N.
        """
        number = checks.whole("columns", columns, 2, MAX_COLUMNS)
        cap = checks.not_negative("cap_mass", cap_mass)
        return cls(column, cap / (number * checks.positive("column_mass", column_mass)), number)

    @property
    def slenderness(self) -> float:
        """α of the columns, rad: the cap beam does not change it."""
        return self.column.slenderness

    @property
    def frequency_parameter(self) -> float:
        """p̂ = p √((1 + 2γ)/(1 + 3γ)), rad/s, from Eq. (23)."""
        return self.column.frequency_parameter / math.sqrt(size_ratio(self.mass_ratio))

    @property
    def equivalent_size(self) -> float:
        """R̂ = R (1 + 3γ)/(1 + 2γ), m: size of the solitary column with this p̂, Eq. (24)."""
        return self.column.size * size_ratio(self.mass_ratio)

    @property
    def restitution(self) -> float:
        """√r = (1 − (3/2) sin²α + 3γ cos 2α)/(1 + 3γ), Eq. (25); may be negative when stocky."""
        cap = _cap_inertia_share(self.mass_ratio)
        return (1.0 - cap) * self.column.restitution + cap * math.cos(2.0 * self.slenderness)

    @property
    def uplift_acceleration(self) -> float:
        """tan α: the ground acceleration (g) above which it uplifts; that of its columns."""
        return self.column.uplift_acceleration

    def block(self, restitution: float | None = None) -> RockingBlock:
        """Return the rocking block of this frame, with √r of Eq. (25) unless one is given.

        ValueError where Eq. (25) gives a negative √r: such a frame does not keep rocking.
        """
        return rocking_block(self, restitution, largest_slenderness(self.mass_ratio))


class Structure(Protocol):
    """A structure that has a rocking block: every function of the dynamics accepts it.

    `Column`, `RockingFrame`, `FixedMassColumn`, `MonolithicPortal`, `RockingBlock`, or your own.

    >>> [structure.block().slenderness for structure in (th.Column(0.5, 3.0), th.Column(1.0, 6.0))]
    [0.16514867741462683, 0.16514867741462683]
    """

    def block(self) -> RockingBlock:
        """Return the block that rocks as the structure does."""


def as_block(structure: Structure) -> RockingBlock:
    """Return the rocking block of a structure, or raise ValueError for anything else."""
    if isinstance(structure, type) or not callable(getattr(structure, "block", None)):
        raise ValueError(
            f"structure is {short_repr(structure)}; expected a Column, a RockingFrame or another "
            "structure with a method block(), one at a time"
        )
    return structure.block()


Structures = Structure | Sequence[Structure] | Mapping[str, Structure]
"""One structure, or several: a list, or a mapping from names."""


def are_several(structures: Structures) -> bool:
    """Return whether structures are several, of which a result has an axis."""
    return isinstance(structures, Mapping | Sequence)


def named_blocks(structures: Structures) -> dict[str, RockingBlock]:
    """Return the block of each structure by its name, or raise ValueError.

    In a list the names are "Column 1", "RockingFrame 2" and so on; of one alone, "Column".
    """
    if not isinstance(structures, Mapping | Sequence):
        return {type(structures).__name__: as_block(structures)}
    if not isinstance(structures, Mapping):
        structures = {f"{type(one).__name__} {i + 1}": one for i, one in enumerate(structures)}
    if not structures:
        raise ValueError("structures is empty; expected one, a list, or a mapping from names")
    blocks = {}
    for name, structure in structures.items():
        try:
            blocks[name] = as_block(structure)
        except ValueError as error:
            raise ValueError(f"structures, {name}: {error}") from None
    return blocks


def checked_column(value: object) -> None:
    """Raise ValueError unless an argument is a Column."""
    if not isinstance(value, Column):
        raise ValueError(f"column is {short_repr(value)}; expected a Column")


def checked_mass_ratio(value: float) -> float:
    """Return γ as a float, or raise ValueError unless it is a number from 0 to infinity."""
    if not (ratio := checks.number("mass_ratio", value)) >= 0.0:
        raise ValueError(
            f"mass_ratio is {ratio:.6g}; expected γ = m_b / (N m_c) from 0 to infinity"
        )
    return ratio


def size_ratio(mass_ratio: float) -> float:
    """Return R̂/R = 1 + γ/(1 + 2γ), Eq. (24); 3/2 for γ = ∞."""
    return 1.5 if mass_ratio == math.inf else 1.0 + 0.5 * mass_ratio / (0.5 + mass_ratio)


def weights(mass_ratio: float) -> tuple[float, float]:
    """Return the shares of one column and of the cap beam in the weight of the frame."""
    if mass_ratio == math.inf:
        return 0.0, 1.0
    return 0.5 / (1.0 + mass_ratio), mass_ratio / (1.0 + mass_ratio)


def solitary_size(frequency_parameter: float) -> float:
    """Return R = 3g/4p² (m) of the solitary rectangular column with this p (rad/s), of Eq. (3)."""
    return 3.0 * STANDARD_GRAVITY / (4.0 * frequency_parameter**2)


def largest_slenderness(mass_ratio: float) -> float:
    """Return the largest α (rad) that keeps rocking after an impact: √r of Eq. (25) is zero there.

    54.7° for the solitary column, 45° for γ → ∞.
    """
    cap = _cap_inertia_share(mass_ratio)
    return math.asin(math.sqrt(1.0 / (1.5 * (1.0 - cap) + 2.0 * cap)))


def _cap_inertia_share(mass_ratio: float) -> float:
    """Return 3γ/(1 + 3γ), the cap beam's share of the frame's inertia: the weight in Eq. (25)."""
    return 1.0 if mass_ratio == math.inf else mass_ratio / (1.0 / 3.0 + mass_ratio)


def rocking_block(structure: Any, restitution: float | None, largest: float) -> RockingBlock:
    """Return a structure's block with a given √r or its own, or raise ValueError if it has none."""
    alpha, own = structure.slenderness, structure.restitution
    if restitution is None and own < 0.0:
        raise ValueError(
            f"slenderness is {alpha:.6g} rad ({math.degrees(alpha):.4g}°), for which √r is "
            f"{own:.4g}: no rocking after an impact; the largest α that rocks is "
            f"{largest:.6g} rad ({math.degrees(largest):.4g}°). Are width and height swapped? Or "
            "give a restitution from 0 to 1"
        )
    return RockingBlock(
        structure.frequency_parameter, alpha, own if restitution is None else restitution
    )


# The model of Allen et al. (1986) as the paper describes it (p. 1): linearised, with massless
# columns, γ → ∞. The paper does not say which impact law they used; we assume Eq. (25) in the same
# limit, √r = cos 2α. Each of the three simplifications can be applied alone.


def simplified(frame: RockingFrame) -> dict[str, RockingBlock]:
    """Return the exact block of a frame, and those with each simplification and with all three.

    They are the equation of motion, p̂ of γ = ∞, and √r of γ = ∞; together, Allen et al. (1986).
    """
    exact, massless = frame.block(), RockingFrame(frame.column, math.inf).block()
    return {
        "exact": exact,
        "linearised": exact.linear(),
        "massless frequency": massless.with_restitution(exact.restitution),
        "massless restitution": exact.with_restitution(massless.restitution),
        "all": massless.linear(),
    }
