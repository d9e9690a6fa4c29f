"""A column whose √r alone is lowered, and its frames, that the steps on the break-even share."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from topheavy import Column, RockingBlock, RockingFrame


@dataclass(frozen=True)
class Subject:
    """A column (γ = 0) with √r lowered by a share, or a frame with that of Eq. (25)."""

    height: float  # of the columns, m
    mass_ratio: float
    deficit: float
    block: RockingBlock

    @property
    def labels(self) -> dict[str, Any]:
        return {"height": self.height, "mass_ratio": self.mass_ratio, "deficit": self.deficit}


def shares(spec: Mapping[str, float]) -> NDArray[np.float64]:
    """Return the shares by which √r is lowered, from 0 on."""
    return np.round(np.arange(int(spec["highest"] / spec["step"] + 1e-9) + 1) * spec["step"], 9)


def columns(settings: Mapping[str, Any]) -> list[Column]:
    """Return the similar columns, in the order of `sizes`."""
    own = Column(**settings["column"])
    return [Column(s * own.half_width, s * own.half_height) for s in settings["sizes"]]


def subjects(column: Column, settings: Mapping[str, Any]) -> list[Subject]:
    """Return the column with each deficit, in ascending order, and its frames."""
    height, own = 2.0 * column.half_height, column.block()
    lowered = [
        Subject(height, 0.0, float(s), own.with_restitution((1.0 - s) * own.restitution))
        for s in shares(settings["deficits"])
    ]
    ratios = settings["mass_ratios"]
    return lowered + [Subject(height, g, 0.0, RockingFrame(column, g).block()) for g in ratios]
