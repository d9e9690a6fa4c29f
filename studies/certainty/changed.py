"""Column and frames, the √r of one of them changed, that the steps on the break-even share."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from studies.certainty.steps.restitution import HIGHEST
from topheavy import Column, RockingBlock, RockingFrame

COLUMN, FRAME = "column lowered", "frame raised"


@dataclass(frozen=True)
class Subject:
    """A column (γ = 0) with √r lowered, or a frame with √r raised, by a share of Eq. (25)."""

    height: float  # of the columns, m
    column: Column
    mass_ratio: float
    change: float
    block: RockingBlock

    @property
    def labels(self) -> dict[str, Any]:
        return {"height": self.height, "mass_ratio": self.mass_ratio, "change": self.change}


def shares(spec: Mapping[str, float]) -> NDArray[np.float64]:
    """Return the shares by which √r is changed, from 0 on."""
    return np.round(np.arange(int(spec["highest"] / spec["step"] + 1e-9) + 1) * spec["step"], 9)


def columns(settings: Mapping[str, Any]) -> list[Column]:
    """Return the similar columns, in the order of `sizes`."""
    own = Column(**settings["column"])
    return [Column(s * own.half_width, s * own.half_height) for s in settings["sizes"]]


def subjects(column: Column, settings: Mapping[str, Any]) -> list[Subject]:
    """Return the column with each deficit, and the frames with each raise, to HIGHEST at most."""
    height, own, found = 2.0 * column.half_height, column.block(), []
    for share in shares(settings["deficits"]):
        lower = own.with_restitution((1.0 - share) * own.restitution)
        found.append(Subject(height, column, 0.0, float(share), lower))
    for gamma in settings["mass_ratios"]:
        frame = RockingFrame(column, gamma).block()
        raises, most = shares(settings["raises"]), HIGHEST / frame.restitution - 1.0
        if raises[-1] > most:
            raises = np.append(raises[raises < most], most)
        for share in raises:
            block = frame.with_restitution((1.0 + share) * frame.restitution)
            found.append(Subject(height, column, gamma, float(share), block))
    return found
