"""What each figure shows: for each panel and look, the number of points and the sums of x, y, xy.

A look is the colour, style and label of an artist, or the words of a text. `make publish` draws all
figures from the published tables and writes tests/reference/figures.csv, with which the tests
compare. Look at a figure that you have changed before you commit the new rows.
"""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import Collection, PathCollection
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.text import Annotation, Text
from matplotlib.ticker import FixedFormatter

from documents.check import REFERENCE
from documents.draw import figure_of, scripts_of_figures
from replication.config import read_config
from replication.sections import Paper

TABLE = REFERENCE / "figures.csv"
NOWHERE = (math.nan, math.nan)
Look = tuple[str, np.ndarray]  # with its points


def names() -> list[str]:
    """Return the figures, each by the name of its script."""
    return [Path(script).stem for script in scripts_of_figures()]


def drawn(name: str) -> Figure:
    """Return a figure, drawn from the published tables."""
    tables = {path.stem: str(path) for path in REFERENCE.glob("*.csv")}
    config = read_config("config/config.yaml", Paper)
    with mpl.rc_context(fname="figures/style.mplstyle"):
        figure = figure_of(f"figures/{name}.py", tables, {"config": config})
    plt.close(figure)
    return figure


def table(name: str, figure: Figure) -> pd.DataFrame:
    """Return a row for each panel and look of a figure."""
    rows = [
        (panel, look, x, y)
        for panel, axes in enumerate(figure.axes)
        for look, points in looks(axes)
        for x, y in points
    ]
    points = pd.DataFrame(rows, columns=["panel", "look", "x", "y"])
    groups = points.assign(xy=points.x * points.y).groupby(["panel", "look"])
    sums = groups.sum().assign(figure=name, points=groups.size()).reset_index()
    return sums[["figure", "panel", "look", "points", "x", "y", "xy"]]


def looks(axes: Axes) -> Iterator[Look]:
    """Yield the look and the points of each artist of a panel, and the places of its words."""
    yield from map(of_line, axes.lines)
    for collection in axes.collections:
        yield from of_collection(collection)
    for patch in axes.patches:
        look = f"{colour(patch.get_facecolor())} in {colour(patch.get_edgecolor())} patch"
        yield look, patch.get_patch_transform().transform(patch.get_path().vertices)
    for text in texts(axes):
        place = text.xy if isinstance(text, Annotation) else NOWHERE
        words = " ".join(text.get_text().split())
        yield f"{colour(text.get_color())} “{words}”", np.array([place])


def of_line(line: Line2D) -> Look:
    marker, dash = line.get_marker(), line.get_linestyle() if line.get_linewidth() else ""
    style = "".join(mark for mark in (marker, dash) if mark not in ("None", "none", None))
    face = f" {colour(line.get_markerfacecolor())}" if style != dash else ""
    label = str(line.get_label())
    name = "" if label.startswith("_") else f" {label}"
    return f"{colour(line.get_color())} {style}{face}{name}", np.array(line.get_xydata())


def of_collection(collection: Collection) -> Iterator[Look]:
    """Yield the markers of a scatter at their places, and others by the corners of their paths."""
    collection.update_scalarmappable()
    parts: list[Any] = [path.vertices for path in collection.get_paths()]
    if isinstance(collection, PathCollection):
        parts = [[place] for place in collection.get_offsets()]
    sides = [collection.get_facecolor(), collection.get_edgecolor()]
    faces, edges = (
        np.resize(side if len(side) else np.zeros(4), (len(parts), 4)) for side in sides
    )
    for part, face, edge in zip(parts, faces, edges, strict=True):
        yield f"{colour(face)} in {colour(edge)} {type(collection).__name__}", np.array(part)


def texts(axes: Axes) -> list[Text]:
    """Return the texts of a panel that are not empty, but for numbers at its ticks."""
    words = [child for child in axes.get_children() if isinstance(child, Text)]  # also titles
    if legend := axes.get_legend():
        words += legend.get_texts()
    for axis in (axes.xaxis, axes.yaxis):
        words.append(axis.label)
        if isinstance(axis.get_major_formatter(), FixedFormatter):
            words += axis.get_ticklabels()
    return [text for text in words if text.get_text()]


def colour(value: Any) -> str:
    return to_hex(value, keep_alpha=True).removesuffix("ff")  # opaque


def write() -> None:
    """Write the table of all figures."""
    tables = [table(name, drawn(name)) for name in names()]
    pd.concat(tables).to_csv(TABLE, index=False, float_format="%.8g")
