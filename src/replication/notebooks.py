"""The pictures of the notebooks: in the style of the figures, at the size of a screen."""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from IPython.display import display
from matplotlib.figure import Figure

STYLE = [Path(__file__).parents[2] / "figures/style.mplstyle", {"figure.dpi": 150}]


def blues(count: int) -> np.ndarray:
    """Return colours of the figures for increasing mass ratios, from light to dark."""
    return plt.colormaps["Blues"](np.linspace(0.6, 1.0, count))


def show(figure: Figure, alt: str) -> None:
    """Show a figure with an alternative text, for readers who cannot see it."""
    display(figure, metadata={"image/png": {"alt": alt}})
    plt.close(figure)
