"""Base shear of frames that rock and of a rigid one that is clamped, over the ground's peak."""

from palette import INK

from replication.drawing import DASHED, SINGLE, gamma, note, shaded, sheet


def draw(uplift):
    """Draw the base shear just after uplift (lines), and the largest of every survivor (dots)."""
    figure, axis = sheet(SINGLE, 56)
    highest = uplift.peak_acceleration.max()
    axis.plot([0.0, highest], [0.0, highest], color=INK, linewidth=0.8, linestyle=DASHED)
    note(axis, "clamped, rigid", (0.56, 0.53), ha="left")
    for ratio, colour in shaded(sorted(uplift.mass_ratio.unique())):
        rows = uplift[uplift.mass_ratio == ratio].sort_values("peak_acceleration")
        axis.plot(rows.peak_acceleration, rows.base_shear, "o", color=colour, markersize=2.2)
        axis.plot(rows.peak_acceleration, rows.shear_after_uplift, color=colour, linewidth=0.9)
        words = gamma(ratio) + (", column" if ratio == 0.0 else "")
        note(axis, words, (1.03 * highest, rows.shear_after_uplift.iloc[-1]), color=colour)
    axis.set(xlim=(0, 1.32 * highest), ylim=(0, 0.6), xticks=(0, 0.25, 0.5, 0.75, 1.0))
    axis.set_xticklabels(("0", "0.25", "0.5", "0.75", "1"))
    axis.set(xlabel="Peak ground acceleration (g)", ylabel="Base shear over weight (–)")
    return figure
