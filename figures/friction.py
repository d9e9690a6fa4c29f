"""Share of pulses under which a coefficient of friction prevents sliding."""

import numpy as np
from palette import GREY, INK

from replication.drawing import DOUBLE, gamma, letter, logarithmic, note, shaded, sheet

ENDS = (0.14, 1.2)  # ends of the axis of friction, –


def draw(friction_pulses):
    table = friction_pulses
    column = table[table.mass_ratio == 0.0]
    bays = [bay for bay in table.bay.unique() if bay > 0.0]
    figure, axes = sheet(DOUBLE, 48, ncols=len(bays), sharey=True)
    for axis, bay in zip(axes, bays, strict=True):
        for (mass_ratio, part), colour in shaded(table[table.bay == bay].groupby("mass_ratio")):
            _steps(axis, part.required, color=colour, label=gamma(mass_ratio))
        _steps(axis, column.required, color=INK, linestyle="--", label="column alone")
        axis.axvline(column.required.min(), color=GREY, linestyle=":", linewidth=0.8)
        logarithmic(axis, (0.2, 0.3, 0.5, 0.7, 1))
        axis.set(xlim=ENDS, ylim=(0, 100), xlabel="Coefficient of friction, μ (–)")
    note(axes[0], r"$\tan\alpha$", (0.158, 50), ha="center", rotation=90, color=GREY)
    axes[0].set_ylabel("Pulses without sliding (%)")
    axes[-1].legend(loc="lower right")
    letter(axes, [f"Bay of {bay:g} m" for bay in bays])
    return figure


def _steps(axis, required, **look):
    """Draw the share of pulses that require at most so much friction, in % of those survived."""
    axis.step(
        np.sort(required),
        100.0 * np.arange(1, len(required) + 1) / len(required),
        where="post",
        **look,
    )
