"""Real records scaled from uplift: where only the solitary column or only the frame overturns."""

import numpy as np
from matplotlib.colors import ListedColormap

from figures.drawing import RECORDS
from figures.palette import CAUSED, OVERTURNED, PREVENTED, UNDECIDED
from replication.drawing import DOUBLE, GREY, PAPER, letter, make_figure, note, sheet
from steps.shared.outcomes import FALLS, UNKNOWN, read

CASES = {  # the outcomes of the column and of the frame with γ → ∞
    "both survive": PAPER,
    "both overturn": OVERTURNED,
    "prevented: only the column overturns": PREVENTED,
    "caused: only the frame overturns": CAUSED,
    "cannot be decided": UNDECIDED,
}
FACTORS = (1, 2, 5, 10, 20)
COLUMNS = 4
CROSS = {  # on a cell that cannot be decided: black and magenta are alike in grey print
    "marker": "x",
    "color": PAPER,
    "linestyle": "none",
    "markersize": 2.4,
    "markeredgewidth": 0.6,
}


def cells(light, heavy):
    """Return the place in CASES of every structure (row) at every factor."""
    one, other = read(light.outcomes), read(heavy.outcomes)
    falls, capped_falls = one == FALLS, other == FALLS
    places = np.select([falls & capped_falls, falls, capped_falls], [1, 2, 3], 0)
    return np.where((one == UNKNOWN) | (other == UNKNOWN), 4, places)


def panel(axis, run):
    run = run.sort_values(["slenderness_deg", "size"])
    light, heavy = (run[run.mass_ratio == end] for end in (0.0, np.inf))
    places, colours = cells(light, heavy), ListedColormap(list(CASES.values()))
    rows, columns = places.shape
    steps = (np.arange(columns + 1) - 0.5) / (columns - 1)
    first, last = light["first"].iloc[0], light["last"].iloc[0]
    edges = first * (last / first) ** steps
    axis.pcolormesh(
        edges, np.arange(rows + 1), places, cmap=colours, vmin=-0.5, vmax=4.5, edgecolor="face"
    )
    middles = np.sqrt(edges[:-1] * edges[1:])
    untold_rows, untold_columns = np.nonzero(places == len(CASES) - 1)
    axis.plot(middles[untold_columns], untold_rows + 0.5, **CROSS)
    axis.set(xscale="log", xlabel="Scale over that at uplift (–)")
    axis.set_xticks(FACTORS, map(str, FACTORS))
    axis.set_xticks([], minor=True)
    each = light["size"].nunique()
    for place in range(1, light.slenderness_deg.nunique()):
        axis.axhline(place * each, color=GREY, linewidth=0.6)
    for place, slenderness in enumerate(light.slenderness_deg.unique()):
        words = rf"$\alpha$ = {slenderness:.3g}°"
        note(axis, words, (1.04 * first, (place + 1) * each - 1.1))
    sizes = light["size"].to_numpy()
    marked = [row for row in range(len(sizes)) if row % each in (1, each // 2, each - 2)]
    axis.set_yticks([row + 0.5 for row in marked], [f"{sizes[row]:.2g}" for row in marked])


def draw(reversals_records):
    table = reversals_records
    records = table.groupby("record", sort=False)
    rows = 1 + len(records) // COLUMNS  # the last place is for the key
    figure, axes = sheet(DOUBLE, 50 * rows, nrows=rows, ncols=COLUMNS)
    for axis in axes.flat[len(records) :]:
        axis.axis("off")
    for axis, (_, run) in zip(axes.flat, records, strict=False):
        panel(axis, run)
    for row in axes:
        row[0].set_ylabel("Size of a column, $R$ (m)")
    letter(
        axes.flat[: len(records)],
        [RECORDS.get(name, name.replace("_", " ")) for name, _ in records],
    )
    key = axes[-1, -1]
    for place, (words, colour) in enumerate(CASES.items()):
        height = 0.9 - 0.11 * place
        key.plot(
            [0.06],
            [height],
            "s",
            color=colour,
            markersize=8,
            markeredgecolor=GREY,
            markeredgewidth=0.4,
        )
        note(key, words, (0.13, height))
    key.plot([0.06], [height], **CROSS | {"markersize": 4})
    note(key, "Frame: $\\gamma=\\infty$.", (0.02, 0.26))
    key.set(xlim=(0, 1), ylim=(0, 1))
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
