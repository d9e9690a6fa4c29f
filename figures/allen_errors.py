"""Error of the peak rotation by the model of Allen et al., and by each of its simplifications."""

from figures.drawing import MODELS, gamma
from replication.drawing import DOUBLE, GREY, note, publish, shades, sheet

LOWEST, HIGHEST = -40, 60  # %


def draw(allen_errors):
    ratios = sorted(allen_errors.mass_ratio.unique())
    shown = sorted(allen_errors.slenderness_deg.unique())[::2]
    figure, axes = sheet(DOUBLE, 116, nrows=3, ncols=4, sharex=True, sharey=True)
    for row, mass_ratio in zip(axes, ratios, strict=True):
        for axis, (model, words) in zip(row, MODELS.items(), strict=True):
            of = (allen_errors.mass_ratio == mass_ratio) & (allen_errors.model == model)
            cells = allen_errors[of]
            axis.axhline(0, color=GREY, linewidth=0.6)
            for slenderness, colour in zip(shown, shades(len(shown)), strict=True):
                line = cells[cells.slenderness_deg == slenderness]
                axis.plot(
                    line.amplitude_over_uplift,
                    100 * line.relative_error,
                    color=colour,
                    linewidth=1,
                    label=f"{slenderness:g}°",
                )
            wrong = (cells.exact_overturned != cells.overturned).sum()
            note(
                axis, f"{wrong} of {len(cells)} verdicts wrong", (4.95, 52), ha="right", color=GREY
            )
            highest = 100 * cells.relative_error.max()
            if highest > HIGHEST:
                note(axis, f"up to {highest:+.0f}%", (1.65, 38), color=GREY)
            if mass_ratio == ratios[0]:
                axis.set_title(words, loc="left")
            if mass_ratio == ratios[-1]:
                axis.set_xlabel(r"Amplitude, $a/(g\,\tan\alpha)$ (–)")
        row[0].set_ylabel(f"{gamma(mass_ratio)}\nError of the peak (%)")
    axes[0, 0].set(xlim=(1, 5), ylim=(LOWEST, HIGHEST), xticks=range(1, 6))
    axes[2, 2].legend(
        title=r"Slenderness, $\alpha$",
        ncols=3,
        loc="lower center",
        bbox_to_anchor=(0.5, 0.44),
        handlelength=1.2,
        columnspacing=0.8,
        labelspacing=0.2,
    )
    return figure


if __name__ == "__main__":
    publish(snakemake, draw)
