"""What this study puts under the synthetic motions of study reversals, at which intensities."""

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from steps.shared.sweep import Asked, Subject
from steps.vase_shares import exchanged, subsets
from topheavy import STANDARD_GRAVITY, Column, FixedMassColumn, RockingBlock, RockingFrame

Settings = Mapping[str, Any]
Vector = NDArray[np.float64]

BARE, FREE, FIXED = "bare", "free", "fixed"
PGV, SCALED = "PGV", "p PGV/(g tan α)"
MEASURES = ("pgv", "pga")

HIGHEST = 0.995
"""Of √r: a block that loses nothing bounces without end, and no solver can follow it."""


def changed(block: RockingBlock, factor: float) -> RockingBlock:
    """Return the block with √r times a factor, at most HIGHEST."""
    if factor == 1.0:
        return block
    return block.with_restitution(min(HIGHEST, factor * block.restitution))


# Rates and stated intensities ---------------------------------------------------------------------


def rated(settings: Settings) -> Asked:
    """Return the bare column, also with a lower √r, and what carries each cap beam."""
    column = Column(**settings["column"])
    own, ratios = column.block(), settings["mass_ratios"]
    found = [
        (BARE, 0.0, share, own.with_restitution((1.0 - share) * own.restitution))
        for share in (0.0, *settings["lowered"])
    ]
    found += [(FREE, g, 0.0, RockingFrame(column, g).block()) for g in ratios]
    found += [(FIXED, g, 0.0, FixedMassColumn(column, g).block()) for g in ratios]
    subjects = [
        Subject({"structure": name, "mass_ratio": gamma, "lowered": share}, block)
        for name, gamma, share, block in found
    ]
    return Asked(subjects, velocities(settings), settings["motions"])


def grid(settings: Settings) -> Vector:
    """Return the PGVs, m/s, over which rates are summed: every other one is a grid, too."""
    spec = settings["velocities"]
    return np.geomspace(spec["lowest"], spec["highest"], spec["points"])


def stated(column: Column, settings: Settings) -> list[tuple[str, float, float]]:
    """Return measure, level and PGV (m/s) at which probabilities are stated."""
    unit = STANDARD_GRAVITY * column.uplift_acceleration / column.frequency_parameter
    return [(PGV, level, level) for level in settings["pgv"]] + [
        (SCALED, level, level * unit) for level in settings["scaled"]
    ]


def velocities(settings: Settings) -> Vector:
    """Return the PGVs of all outcomes: those of the grid, then those that are stated."""
    of_stated = [pgv for *_, pgv in stated(Column(**settings["column"]), settings)]
    return np.concatenate([grid(settings), of_stated])


# Where the benefit ends ---------------------------------------------------------------------------


def deficits(spec: Mapping[str, float]) -> Vector:
    """Return the shares by which √r is lowered, from 0 on."""
    return np.round(np.arange(int(spec["highest"] / spec["step"] + 1e-9) + 1) * spec["step"], 9)


def columns(settings: Settings) -> list[Column]:
    """Return the similar columns, in the order of `sizes`."""
    own = Column(**settings["column"])
    return [Column(s * own.half_width, s * own.half_height) for s in settings["sizes"]]


def lowered(column: Column, settings: Settings) -> Asked:
    """Return the column with each deficit of √r, in ascending order, and its frames."""
    height, own = 2.0 * column.half_height, column.block()
    found = [
        (0.0, float(share), own.with_restitution((1.0 - share) * own.restitution))
        for share in deficits(settings["deficits"])
    ]
    found += [(g, 0.0, RockingFrame(column, g).block()) for g in settings["mass_ratios"]]
    subjects = [
        Subject({"height": height, "mass_ratio": gamma, "deficit": share}, block)
        for gamma, share, block in found
    ]
    levels = np.array([pgv for *_, pgv in stated(column, settings)])
    return Asked(subjects, levels, settings["motions"])


# Supports of the mass -----------------------------------------------------------------------------


def similar(settings: Settings, structures: Settings) -> Iterator[tuple[str, Column, float]]:
    """Yield name, column and γ: similar to a named structure, so many times as large."""
    for entry in settings["columns"]:
        own = structures[entry["structure"]]
        column = Column(*(entry["scaled"] * own[key] for key in ("half_width", "half_height")))
        name = f"{2.0 * column.half_height:g} m {entry['structure']}"
        yield name, column, entry["mass_ratio"]


def supported(settings: Settings, structures: Settings, measure: str) -> Asked:
    """Return each column bare, under its free cap beam, and with that mass fixed to its top."""
    subjects = [
        Subject({"structure": name, "support": support, "mass_ratio": mass_ratio}, one.block())
        for name, column, gamma in similar(settings, structures)
        for support, mass_ratio, one in (
            (BARE, 0.0, column),
            (FREE, gamma, RockingFrame(column, gamma)),
            (FIXED, gamma, FixedMassColumn(column, gamma)),
        )
    ]
    return Asked(subjects, np.array(settings[measure]), settings["motions"], measure)


# √r of column and frame ---------------------------------------------------------------------------


def named(kind: str, factor: float) -> str:
    """Return the name of a structure with a factor on its √r."""
    return kind if factor == 1.0 else f"{kind}, √r {100.0 * (1.0 - factor):g} % lower"


def factored(settings: Settings) -> Asked:
    """Return column and frame with each factor on their √r."""
    column = Column(**settings["column"])
    both = {"column": column, "frame": RockingFrame(column, settings["mass_ratio"])}
    subjects = [
        Subject({"structure": named(kind, factor)}, changed(one.block(), factor))
        for (kind, one), factor in product(both.items(), settings["factors"])
    ]
    return Asked(subjects, np.array([settings["pgv"]]), settings["motions"])


# What carries the difference of vase and frame ----------------------------------------------------


def exchanges(settings: Settings) -> Asked:
    """Return the blocks in which some of α, p̂ and √r are the frame's, the others the vase's."""
    column, subjects = Column(**settings["column"]), []
    for gamma in settings["mass_ratios"]:
        ends = FixedMassColumn(column, gamma).block(), RockingFrame(column, gamma).block()
        subjects += [
            Subject({"mass_ratio": gamma, "free": subset}, exchanged(*ends, subset))
            for subset in subsets()
        ]
    return Asked(subjects, np.array(settings["pgv"]), settings["motions"])


def questions(
    rates: Settings,
    break_even: Settings,
    intensities: Settings,
    structures: Settings,
    benefit: Settings,
    shares: Settings,
) -> dict[str, Asked]:
    """Return all that this study asks of the ensemble, by name."""
    of_sizes = {f"break_even_{place}": one for place, one in enumerate(columns(break_even))}
    return {
        "rates": rated(rates),
        **{name: lowered(column, break_even) for name, column in of_sizes.items()},
        **{measure: supported(intensities, structures, measure) for measure in MEASURES},
        "benefit": factored(benefit),
        "shares": exchanges(shares),
    }
