"""Coefficients of restitution, and frames across their plane, in a rigid-body engine."""

from palette import greys

from replication.drawing import DOUBLE, GREY, gamma, letter, note, shades, sheet

STYLES = ("o-", "s--", "^-.", "D:")


def draw(engine_restitution, engine_across):
    figure, axes = sheet(DOUBLE, 48, "ab")
    letter(axes.values(), ["Coefficient of restitution", "Across the plane"])
    _restitution(axes["a"], engine_restitution)
    _across(axes["b"], engine_across)
    return figure


def _across(axis, table):
    """Draw the first amplitude that overturns two columns in line over their depth, and others."""
    first = table.frequency_ratio == table.frequency_ratio.iloc[0]
    chosen = table[first & (table.section == "square")]
    chosen = chosen.drop_duplicates(["structure", "depth_over_width", "mass_ratio", "direction"])
    line = chosen[chosen.structure == "two in line"]
    gammas = sorted(line.mass_ratio.unique())
    for mass_ratio, colour in zip(gammas, shades(len(gammas) + 1)[1:], strict=True):
        part = line[line.mass_ratio == mass_ratio]
        across = part[part.direction > 0].sort_values("depth_over_width")
        axis.plot(across.depth_over_width, across.theory, color=colour, label=gamma(mass_ratio))
        axis.plot(across.depth_over_width, across.engine, "o", color=colour, markersize=3.5)
        level = part[part.direction == 0].theory.iloc[0]
        axis.axhline(level, color=colour, linewidth=0.8, linestyle=":")
    axis.axhline(1.0, color=GREY, linewidth=0.6)
    note(axis, "column alone", (2.0, 0.96), color=GREY, ha="right")
    note(axis, "frame, in the plane", (1.02, 1.18), color=GREY)
    axis.set(xlabel="Depth over width of the columns (–)", ylim=(0.5, 1.5))
    axis.set_ylabel("Amplitude over the\ncolumn's minimum (–)")
    axis.legend(loc="lower right")


def _restitution(axis, table):
    frames = table[table.mass_ratio > 0]
    frames = frames.assign(ratio=frames.engine / frames.theory)
    dampings = list(frames.groupby("damping_ratio"))
    for place, ((_, part), colour) in enumerate(zip(dampings, greys(len(dampings)), strict=True)):
        low, high = (part.groupby("time_constant").ratio.agg(end) for end in ("min", "max"))
        times = low.index * 1.07 ** (place - 1.5)  # side by side
        bars = {"linewidth": 0.9, "elinewidth": 1.3, "color": colour, "markersize": 3.5}
        axis.errorbar(
            times,
            (low + high) / 2,
            (high - low) / 2,
            fmt=STYLES[place],
            label=f"{part.point_restitution.iloc[0]:.2f}",
            **bars,
        )
    axis.axhline(1.0, color=GREY, linewidth=0.6)
    axis.set(xscale="log", xlabel=r"Time constant of the contact, $p\,\tau$ (–)")
    axis.set_ylabel(r"$\sqrt{r}$ over that of Eq. (25) (–)")
    axis.legend(loc="lower left", ncols=2, title="Rebound of a single point (–)")
