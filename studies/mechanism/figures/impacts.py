"""The coefficient of restitution at the first impact in MuJoCo and in theory."""

from figures.palette import greys
from replication.drawing import GREY, SINGLE, make_figure, note, sheet
from studies.mechanism.figures.marks import untested

STYLES = ("o-", "s--", "^-.", "D:")
TICKS = (-50, -20, -10, -5, -2, -1, 0, 1, 2, 5)  # %; the axis is linear between −1 and 1


def draw(mechanism_rebounds):
    figure, axis = sheet(SINGLE, 62)
    if untested(axis, mechanism_rebounds):
        return figure
    frames = mechanism_rebounds[mechanism_rebounds.mass_ratio > 0]
    dampings = sorted(frames.damping_ratio.unique())
    for ratio, colour, style in zip(dampings, greys(len(dampings)), STYLES, strict=True):
        part = frames[frames.damping_ratio == ratio]
        low, high = (
            100 * part.groupby("time_constant").difference.agg(how) for how in ("min", "max")
        )
        restitution = part.point_restitution.iloc[0]
        label = f"{restitution:.2f}"
        axis.fill_between(low.index, low, high, color=colour, alpha=0.2, linewidth=0)
        axis.semilogx(low.index, (low + high) / 2, style, color=colour, markersize=3, label=label)
    axis.axhline(0.0, color=GREY, linewidth=0.5)
    axis.set(xlabel=r"Time constant of the contact, $p\,\tau$ (–)", ylim=(-100, 100))
    axis.set_yscale("symlog", linthresh=1, linscale=0.6)
    axis.set_yticks(TICKS, [f"{tick:g}".replace("-", "−") for tick in TICKS])
    axis.set_yticks([], minor=True)
    axis.set_ylabel(r"Difference from $\sqrt{r}$ of Eq. (25) (%)")
    note(axis, "Eq. (25)", (0.0031, 0.45), color=GREY)
    axis.legend(loc="upper left", ncols=2, title="Rebound of a single point (–)")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
