"""One motion until the first impacts, and ground velocities below which nothing overturns."""

import math

from palette import GREY, INK, PALE

from replication.drawing import DASHED, DOUBLE, gamma, letter, note, ring, shaded, sheet

BESIDE = {0.0: ("column", (-26, 0), "right"), math.inf: (gamma(math.inf), (-16, 0), "right")}
APART = 8  # %: least distance of two labels
FIRST = {"velocity_1": "$V_1$", "velocity_2": "$V_2$", "velocity": "$V^*$"}


def first_visit(above, below, order):
    """Draw the ground acceleration, and the rotation of each structure until its first impact."""
    courses = order.groupby("mass_ratio")
    lifted = order.time[order.rotation_over_alpha > 0.01]
    begin, end = lifted.min() - 1.3, lifted.max() + 0.2
    motion = order.drop_duplicates("time").sort_values("time")
    above.plot(motion.time, motion.acceleration, color=GREY, linewidth=0.8)
    above.sharex(below)
    above.tick_params(labelbottom=False)
    above.set(ylabel=r"$\ddot{u}_g$ (g)", xlim=(begin, end))
    below.axhspan(0, 1, color=PALE, linewidth=0)
    for (ratio, run), colour in shaded(courses):
        below.plot(run.time, run.rotation_over_alpha, color=colour)
        if (last := run.iloc[-1]).rotation_over_alpha < 0.2:
            ring(below, last.time, 0.0, colour)
        top = run.loc[run.rotation_over_alpha.idxmax()]
        words, shift, side = BESIDE.get(ratio, (gamma(ratio), (12, 0), "left"))
        note(below, words, (top.time, 0.8 * top.rotation_over_alpha), shift, ha=side, color=colour)
    most = order.rotation_over_alpha.max()
    below.set(xlabel="Time (s)", ylabel=r"$|\theta|/\alpha$ (–)", ylim=(0, most))


def velocities(axis, rows):
    """Draw V_1, V_2 and V* of the frames over γ; γ → ∞ has a place of its own."""
    ratios = [*rows.mass_ratio]
    places = range(len(ratios))
    for name, words in FIRST.items():
        axis.plot(places, 100 * rows[name], "o-", color=INK, markersize=2.5, linewidth=0.8)
        note(axis, words, (0.25, 100 * rows[name].iloc[0]), (0, 6), ha="center")
        for place in (ratios.index(1.0), len(ratios) - 1):
            number = 100 * rows[name].iloc[place]
            text = f"{number:.0f}" if number > 10 else f"{number:.1f}"
            note(axis, text, (place, number), (0, 6), ha="center")
    axis.set_xticks(places, [f"{ratio:g}".replace("inf", "∞") for ratio in ratios])
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", ylabel="Ground velocity (cm/s)", ylim=(0, 76))


def gains(axis, visits):
    """Draw the gain of each frame over the number of visits; dashed, with a lower √r of columns."""
    frames = visits[visits.mass_ratio >= 0.5].groupby("mass_ratio")
    place = -math.inf
    for (ratio, line), colour in shaded([None, *frames])[1:]:
        finite, limit = line[line.visits < math.inf], line[line.visits == math.inf].iloc[0]
        axis.plot(finite.visits, 100 * finite.gain, color=colour)
        words = f"{gamma(ratio)}: {100 * limit.gain:.0f} %"
        place = max(place + APART, 100 * limit.gain)
        note(axis, words, (finite.visits.max(), place), (3, 0), color=colour)
        if ratio == 1.0:
            lower = 100 * finite.gain_if_lower
            axis.plot(finite.visits, lower, color=colour, linestyle=DASHED)
            end = f"{100 * limit.gain_if_lower:.0f} %".replace("-", "−")
            note(axis, end, (finite.visits.max(), lower.iloc[-1]), (3, 0), color=colour)
    axis.axhline(0, color=GREY, linewidth=0.6)
    axis.set_xscale("log")
    axis.set_xticks([1, 10, 100], ["1", "10", "100"])
    axis.set(xlim=(1, 500), ylim=(-40, 75), xlabel="Number of visits, $n$ (–)")
    axis.set_ylabel("Gain in $V_n$ (%)")


def draw(guarantee, guarantee_visits, guarantee_order):
    figure, axes = sheet(DOUBLE, 52, "acd;bcd", width_ratios=(1.1, 1, 1), height_ratios=(0.35, 1))
    first_visit(axes["a"], axes["b"], guarantee_order)
    rows = guarantee[(guarantee.structure == "temple") & (guarantee.support == "frame")]
    velocities(axes["c"], rows)
    gains(axes["d"], guarantee_visits)
    titles = ["One motion until first impacts", "Guaranteed velocities", "Gain over the column"]
    letter([axes[key] for key in "acd"], titles)
    return figure
