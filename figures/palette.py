"""The colours of the figures. Each has one meaning in all of them.

What has no meaning of its own is drawn in ink and grey, and told apart by marker, dash and label.
γ is shown by lightness (`replication.drawing.shades`).
"""

from matplotlib.colors import to_hex, to_rgb

from replication import drawing
from replication.drawing import shades

INK, GREY, PALE, PAPER = drawing.INK, drawing.GREY, drawing.PALE, drawing.PAPER
LIGHTEST, DARKEST = drawing.LIGHTEST, drawing.DARKEST


def tint(colour: str, share: float) -> str:
    """Return a colour mixed with white: `share` of it, from 0 (white) to 1."""
    return to_hex([share * part + (1.0 - share) for part in to_rgb(colour)])


# What happens to one structure.
OVERTURNS, SURVIVES = "#c8501a", "#12715f"
OVERTURNED = tint(OVERTURNS, 0.25)  # areas in which it overturns
AT_ONCE = tint(OVERTURNS, 0.65)  # … without an impact, where the two modes differ
ROCKS = tint(SURVIVES, 0.2)  # areas in which it rocks and survives

# What a cap beam, or a heavier one, does to the outcome.
PREVENTED, CAUSED = "#c79a0a", "#a3195b"
PREVENTS = "#876600"  # words of the first, 5 to 1 on white

# What is compared with what.
MODEL = "#6a3d9a"  # simplified models: linearised, columns without mass
CONSERVATIVE = tint(MODEL, 0.55)  # … where they are wrong to the conservative side
FIXED = "#8c6d00"  # the cap's mass fixed to the column
ALONE, EQUAL, _ = shades(3)  # the column alone, and under a cap of γ = 1, below γ → ∞

# Bodies that are drawn, and arrows and points on them.
STONE, CAP, EARTH = "#e8e5df", "#b9b1a2", "#d5d1c8"
FORCE = "#0b6e99"
