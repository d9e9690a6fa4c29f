"""The moment–rotation relation of column and frame, Fig. 1(b) of the paper."""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from topheavy.bodies.structures import Column, RockingFrame


def restoring_moment(structure: Column | RockingFrame, rotation: ArrayLike) -> NDArray[np.float64]:
    """Return the restoring moment normalised by m_c g R of one column at rotations θ (rad, signed).

    For the solitary column it is sin(α − |θ|), opposed to the rotation. In the frame each column
    also carries half of the cap beam at the end of its diagonal, twice as far from the pivot; the
    moment is therefore 1 + 2γ times as high. At θ = 0 the moment balances the ground motion, up to
    the value returned for θ → 0 from above.

    Raises
    ------
    ValueError
        For γ = ∞: columns without mass have no m_c g R.
    """
    share = 1.0
    if isinstance(structure, RockingFrame):
        if structure.mass_ratio == math.inf:
            raise ValueError("mass_ratio is inf; expected a finite γ, as m_c g R is 0 for γ = ∞")
        share += 2.0 * structure.mass_ratio
    theta = np.asarray(rotation, dtype=float)
    side = np.where(theta < 0.0, -1.0, 1.0)
    moment: NDArray[np.float64] = share * side * np.sin(structure.slenderness - np.abs(theta))
    return moment
