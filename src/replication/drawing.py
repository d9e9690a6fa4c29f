"""Common parts of all figures: read the tables, apply the style, save the same bytes each time."""

import io
import math
from collections.abc import Iterable, Sequence
from typing import Any
from xml.sax.saxutils import escape

import matplotlib as mpl

mpl.use("svg")

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

SINGLE, DOUBLE = 88.0, 180.0  # widths of one and of two columns, mm

# Ink and greys for what has no meaning of its own, and one hue by lightness.
INK, GREY, PALE, PAPER = "#1a1a1a", "#737373", "#f2f2f2", "#ffffff"
DASHED = (0, (4, 2))
STROKES = ["-", (0, (6, 1.5)), (0, (1.5, 1)), (0, (6, 1.2, 1.2, 1.2))]  # told apart without colour
LIGHTEST, DARKEST = (0.36, 0.58, 0.80), (0.02, 0.12, 0.32)  # 3 to 1 on white, and more

PULSES = {
    "one-sine": "One sine",
    "one-cosine": "One cosine",
    "ricker-symmetric": "Symmetric Ricker",
    "ricker-antisymmetric": "Antisymmetric Ricker",
}

PLACES = 6  # decimals of the places of axes, over the size of the figure


def picture(figure: Figure, title: str, alt: str) -> str:
    """Return a figure as an SVG with a title and a description, and no date."""
    settle(figure)
    file = io.StringIO()
    figure.savefig(file, format="svg", metadata={"Date": None})
    plt.close(figure)
    return described(file.getvalue(), title, alt)


def settle(figure: Figure) -> None:
    """Lay a figure out, and round the places of its axes: the same bytes in each process.

    The last bits of the layout depend on where the process keeps its objects, and Matplotlib names
    the clip paths of an SVG by all bits.
    """
    if engine := figure.get_layout_engine():
        engine.execute(figure)
        figure.set_layout_engine("none")
    for axes in figure.axes:
        axes.set_position(np.round(axes.get_position(original=True).bounds, PLACES))


def described(svg: str, title: str, alt: str) -> str:
    """Return an SVG with a role, a title and a description, which a screen reader tells.

    Raises
    ------
    ValueError
        When the title or the alternative text is empty, or the text is no SVG.
    """
    before, tag, after = svg.partition("<svg ")
    if not (title.strip() and alt.strip() and tag):
        raise ValueError(
            f"title {title!r} and alt {alt!r} of {svg[:40]!r}…; expected two texts and an SVG: "
            "write title and alt of the figure in captions.yaml"
        )
    attributes, _, body = after.partition(">")
    texts = "".join(
        f"\n <{name}>{escape(' '.join(text.split()))}</{name}>"
        for name, text in (("title", title), ("desc", alt))
    )
    return f'{before}<svg role="img" {attributes}>{texts}{body}'


def sheet(width: float, height: float, mosaic: str = "", **grid) -> tuple[Figure, Any]:
    """Return a figure of a size in mm, and its axes: an array, or a dictionary for a mosaic."""
    size = (width / 25.4, height / 25.4)
    if mosaic:
        return plt.subplot_mosaic(mosaic, figsize=size, **grid)
    return plt.subplots(figsize=size, **grid)


def beside(width: float, height: float, shares: Sequence[float]) -> tuple[Figure, list[Axes]]:
    """Return a figure of a size in mm, and its panels in a row, each laid out by itself."""
    figure = plt.figure(figsize=(width / 25.4, height / 25.4))
    parts = figure.subfigures(1, len(shares), width_ratios=shares)
    return figure, [part.subplots() for part in parts]


def shades(count: int) -> list[tuple[float, float, float]]:
    """Return colours of one hue, from the lightest to the darkest."""
    steps = [i / max(count - 1, 1) for i in range(count)]
    pairs = list(zip(LIGHTEST, DARKEST, strict=True))
    return [tuple(low + (high - low) * step for low, high in pairs) for step in steps]


def letter(axes: Sequence[Axes], titles: Sequence[str]) -> None:
    """Title the panels (a), (b), …"""
    for axis, mark, title in zip(axes, "abcdefgh", titles, strict=False):
        axis.set_title(f"({mark}) {title}")


def note(
    axis: Axes, text: str, place: tuple[float, float], aside: tuple[float, float] = (), **look
) -> None:
    """Write a label at a point of the data, or beside it by an offset in points."""
    if aside:
        look |= {"xytext": aside, "textcoords": "offset points"}
    axis.annotate(text, place, **{"fontsize": 7.5, "va": "center"} | look)


def ring(axis: Axes, x: Any, y: Any, colour: Any = INK, size: float = 3.5, **look) -> None:
    """Draw open circles."""
    how = {"color": colour, "markerfacecolor": PAPER, "markersize": size}
    axis.plot(x, y, "o", **how | look)


def logarithmic(axis: Axes, ticks: Sequence[float], name: str = "x") -> None:
    """Scale the x or y of a panel by the logarithm, with ticks at some numbers alone."""
    axis.set(**{f"{name}scale": "log"})
    side = axis.xaxis if name == "x" else axis.yaxis
    side.set_ticks(ticks, [f"{tick:g}" for tick in ticks])
    side.set_ticks([], minor=True)


def shaded(levels: Iterable[Any]) -> list[tuple[Any, tuple[float, float, float]]]:
    """Return each level with its colour, the later the darker."""
    levels = list(levels)
    return list(zip(levels, shades(len(levels)), strict=True))


def gamma(value: float) -> str:
    """Return "γ = …" for a mass ratio."""
    return r"$\gamma=\infty$" if math.isinf(value) else f"$\\gamma$ = {value:g}"
