"""Where the linearised equation, and the whole model of Allen et al., give a wrong outcome."""

from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from palette import CONSERVATIVE, MODEL, OVERTURNED, PAPER

from replication.drawing import DOUBLE, letter, note, sheet

OUTCOMES = {  # code: twice the outcome of the exact frame plus that of the model
    "both survive": PAPER,
    "falsely overturned": CONSERVATIVE,
    "falsely safe": MODEL,
    "both overturn": OVERTURNED,
}
TITLES = {
    "linearised": "Linearised equation only",
    "all": "Allen et al.: linearised, columns without mass",
}


def draw(allen_maps):
    figure, axes = sheet(DOUBLE, 56, ncols=2, sharey=True)
    for axis, model in zip(axes, TITLES, strict=True):
        code = 2 * allen_maps.exact + allen_maps[model]
        cells = allen_maps.assign(code=code)
        grid = cells.pivot(index="amplitude_over_uplift", columns="frequency_ratio", values="code")
        look = {"cmap": ListedColormap(OUTCOMES.values()), "vmin": 0, "vmax": 3, "rasterized": True}
        axis.pcolormesh(grid.columns, grid.index, grid, **look)
        wrong = [(2, "falsely safe"), (1, "falsely overturned")]
        patches = [
            Patch(facecolor=OUTCOMES[name], label=f"{name}: {100 * (code == number).mean():.1f} %")
            for number, name in wrong
        ]
        axis.legend(handles=patches, loc="lower right", handlelength=1.2)
        note(axis, "both survive", (6.6, 6.5), ha="center")
        note(axis, "both overturn", (2.6, 9.5), ha="center")
        ends = grid.columns[[0, -1]], grid.index[[0, -1]]
        axis.set(xlim=ends[0], ylim=ends[1], xlabel=r"Frequency of the pulse, $\omega/p$ (–)")
    axes[0].set_ylabel(r"Amplitude of the pulse, $a/(g\,\tan\alpha)$ (–)")
    letter(axes, TITLES.values())
    return figure
