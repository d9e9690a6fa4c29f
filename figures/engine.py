"""Frames across their plane in a rigid-body engine."""

from palette import GREY

from replication.drawing import SINGLE, gamma, note, shaded, sheet


def draw(engine_across):
    """Draw the first amplitude that overturns two columns in line over their depth, and others."""
    figure, axis = sheet(SINGLE, 48)
    table = engine_across
    first = table.frequency_ratio == table.frequency_ratio.iloc[0]
    chosen = table[first & (table.section == "square")]
    chosen = chosen.drop_duplicates(["structure", "depth_over_width", "mass_ratio", "direction"])
    line = chosen[chosen.structure == "two in line"]
    gammas = sorted(line.mass_ratio.unique())
    for mass_ratio, colour in shaded([0.0, *gammas])[1:]:
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
    return figure
