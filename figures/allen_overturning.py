"""Where the linearised equation, and the whole model of Allen et al., misjudge overturning."""

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from figures.palette import CONSERVATIVE, MODEL, OVERTURNED
from replication.drawing import DOUBLE, PAPER, letter, make_figure, note, sheet

OUTCOMES = {
    "both survive": PAPER,
    "both overturn": OVERTURNED,
    "falsely safe": MODEL,
    "falsely overturned": CONSERVATIVE,
}
TITLES = {
    "linearised": "Linearised equation only",
    "all": "Allen et al.: linearised, columns without mass",
}


def draw(allen_overturning):
    figure, axes = sheet(DOUBLE, 66, ncols=2, sharey=True)
    codes = {outcome: code for code, outcome in enumerate(OUTCOMES)}
    for axis, model in zip(axes, TITLES, strict=True):
        runs = allen_overturning[allen_overturning.model == model]
        cells = runs.loc[runs.index.repeat(runs.cells)]
        amplitudes = [np.linspace(run.lowest, run.highest, run.cells) for run in runs.itertuples()]
        cells = cells.assign(
            code=cells.verdict.map(codes), amplitude=np.round(np.concatenate(amplitudes), 9)
        )
        grid = cells.pivot_table(index="amplitude", columns="frequency_ratio", values="code")
        axis.pcolormesh(
            grid.columns,
            grid.index,
            grid,
            cmap=ListedColormap(OUTCOMES.values()),
            vmin=0,
            vmax=3,
            rasterized=True,
        )
        shares = 100 * cells.verdict.value_counts(normalize=True)
        wrong = [outcome for outcome in OUTCOMES if outcome.startswith("falsely")]
        patches = [
            Patch(facecolor=OUTCOMES[v], label=f"{v}: {shares.get(v, 0):.1f} %") for v in wrong
        ]
        axis.legend(handles=patches, loc="lower right", handlelength=1.2)
        note(axis, "both survive", (6.6, 6.5), ha="center")
        note(axis, "both overturn", (2.6, 9.5), ha="center")
        axis.set(xlim=(1, 8), ylim=(1, 12), xlabel=r"Frequency of the pulse, $\omega/p$ (–)")
    axes[0].set_ylabel(r"Amplitude of the pulse, $a/(g\,\tan\alpha)$ (–)")
    letter(axes, TITLES.values())
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
