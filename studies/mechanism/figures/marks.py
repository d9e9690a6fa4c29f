"""What a figure shows in place of an experiment that was not run."""

import textwrap

from drawing import GREY, note


def untested(axis, table) -> bool:
    """Say on the axis why its table holds nothing, if so, and return whether it does."""
    if "not_tested" not in table:
        return False
    axis.set(xticks=(), yticks=())
    words = "not tested:\n" + textwrap.fill(table.not_tested.iloc[0], 40)
    note(axis, words, (0.5, 0.5), ha="center", color=GREY, xycoords="axes fraction")
    return True
