"""Histories under one pulse for increasing γ, and the minimum overturning accelerations."""

from string import ascii_lowercase

from figures.drawing import gamma
from figures.palette import OVERTURNS, SURVIVES
from replication.drawing import DOUBLE, GREY, INK, PALE, PAPER, make_figure, note, shades, sheet

NAMES = {0.0: ", solitary column"}
POINTS = {"textcoords": "offset points"}


def history(axis, run, case):
    """Draw one response within the band in which |θ| < α, over the time of the pulse (bar)."""
    fell = case.outcome == "overturned"
    colour = OVERTURNS if fell else SURVIVES
    words = "overturns" if fell else f"survives, peak {case.peak_over_alpha:.2f}$\\,\\alpha$"
    shaken = run.time[run.acceleration != 0.0].max()
    axis.axhspan(-1, 1, color=PALE, linewidth=0)
    axis.axvspan(0, shaken, ymax=0.04, color=GREY, linewidth=0)
    axis.plot(run.time, run.rotation_over_alpha, color=colour)
    how = {"xycoords": "axes fraction", "ha": "right", "color": colour}
    note(axis, words, (0.98, 0.2), **how)
    axis.set_title(gamma(case.mass_ratio) + NAMES.get(case.mass_ratio, ""))
    axis.set(xlim=(0, 4 * shaken), ylim=(-1.4, 1.4), yticks=(-1, 0, 1))
    return shaken


def thresholds(axis, heavier, colours, pulse):
    """Draw the minimum overturning acceleration of each, and the acceleration of the pulse."""
    for place, (case, colour) in enumerate(zip(heavier.itertuples(), colours, strict=True)):
        least = case.lowest_overturning_low
        axis.barh(place, least, color=colour, height=0.62)
        ink = PAPER if place > 0 else INK
        note(axis, f"{least:.3f} g", (0, place), xytext=(4, 0), color=ink, **POINTS)
    axis.axvline(pulse, color=INK, linewidth=0.9, linestyle=(0, (4, 2)))
    words, top = f"this pulse, {pulse:g} g", len(heavier) - 0.4
    note(axis, words, (pulse, top), xytext=(-3, 0), ha="right", color=INK, **POINTS)
    axis.set(yticks=range(len(heavier)), yticklabels=map(gamma, heavier.mass_ratio))
    axis.set(ylim=(-0.5, top + 0.3), xlabel="Acceleration amplitude (g)")
    axis.set_title("Minimum overturning acceleration")


def draw(heavier_histories, heavier):
    keys = ascii_lowercase[: len(heavier)]
    half = (len(keys) + 1) // 2
    mosaic = f"{keys[:half]}Z;{keys[half:].ljust(half, '.')}Z"
    figure, axes = sheet(DOUBLE, 80, mosaic, width_ratios=(*[1] * half, 1.25))
    colours, runs = shades(len(heavier)), heavier_histories.groupby("mass_ratio")
    for key, case in zip(keys, heavier.itertuples(), strict=True):
        shaken = history(axes[key], runs.get_group(case.mass_ratio), case)
        axes[key].tick_params(labelleft=key in (keys[0], keys[half]), labelbottom=key >= keys[half])
        if key >= keys[half]:
            axes[key].set_xlabel("Time, $t$ (s)")
        if key in (keys[0], keys[half]):
            axes[key].set_ylabel(r"Rotation, $\theta/\alpha$ (–)")
    note(axes[keys[0]], "pulse", (shaken, -1.24), xytext=(3, 0), color=GREY, **POINTS)
    thresholds(axes["Z"], heavier, colours, heavier_histories.acceleration.abs().max())
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
