"""First impact in MuJoCo and in theory: its time, and the coefficient of restitution."""

from figures.drawing import gamma
from figures.palette import greys
from replication.drawing import DOUBLE, GREY, letter, make_figure, note, shades, sheet
from studies.mechanism.figures.marks import untested

STYLES = ("o-", "s--", "^-.", "D:")
TICKS = (-50, -20, -10, -5, -2, -1, 0, 1, 2, 5)  # %; the axis is linear between −1 and 1


def draw(mechanism_first_impacts, mechanism_rebounds):
    figure, (left, right) = sheet(DOUBLE, 68, ncols=2)
    letter((left, right), ["Time of the first impact", "Coefficient of restitution"])
    if untested(left, mechanism_first_impacts) or untested(right, mechanism_rebounds):
        return figure
    steps = mechanism_first_impacts[mechanism_first_impacts.step > 0]
    models = list(steps.groupby(["structure", "mass_ratio"], sort=False))
    for ((structure, mass_ratio), part), colour in zip(models, shades(len(models)), strict=True):
        label = f"{structure}, {gamma(mass_ratio)}"
        worst = part.groupby("step").difference.agg(lambda values: values.abs().max())
        left.loglog(worst.index, worst, "o-", color=colour, markersize=3, label=label)
    left.set(xlabel=r"Time step, $p\,\Delta t$ (–)", ylabel="Relative difference (–)")
    left.set_xticks(ticks := sorted(steps.step.unique()), [f"{1e4 * tick:g}" for tick in ticks])
    left.set_xlabel(r"Time step, $10^4\,p\,\Delta t$ (–)")
    left.set_xticks([], minor=True)
    left.legend(loc="lower right")

    frames = mechanism_rebounds[mechanism_rebounds.mass_ratio > 0]
    dampings = sorted(frames.damping_ratio.unique())
    for ratio, colour, style in zip(dampings, greys(len(dampings)), STYLES, strict=True):
        part = frames[frames.damping_ratio == ratio]
        low, high = (
            100 * part.groupby("time_constant").difference.agg(how) for how in ("min", "max")
        )
        restitution = part.point_restitution.iloc[0]
        label = f"{restitution:.2f}"
        right.fill_between(low.index, low, high, color=colour, alpha=0.2, linewidth=0)
        right.semilogx(low.index, (low + high) / 2, style, color=colour, markersize=3, label=label)
    right.axhline(0.0, color=GREY, linewidth=0.5)
    right.set(xlabel=r"Time constant of the contact, $p\,\tau$ (–)", ylim=(-100, 100))
    right.set_yscale("symlog", linthresh=1, linscale=0.6)
    right.set_yticks(TICKS, [f"{tick:g}".replace("-", "−") for tick in TICKS])
    right.set_yticks([], minor=True)
    right.set_ylabel(r"Difference from $\sqrt{r}$ of Eq. (25) (%)")
    note(right, "Eq. (25)", (0.0031, 0.45), color=GREY)
    right.legend(loc="upper left", ncols=2, title="Rebound of a single point (–)")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
