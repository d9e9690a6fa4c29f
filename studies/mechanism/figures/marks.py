"""The note in a figure whose experiment was not run."""

import textwrap

from replication.drawing import GREY, note


def untested(axis, table) -> bool:
    """Write on the axis why its table is empty, if it is; return whether it holds results."""
    if "not_tested" not in table:
        return False
    axis.set(xticks=(), yticks=())
    words = "not tested:\n" + textwrap.fill(table.not_tested.iloc[0], 40)
    note(axis, words, (0.5, 0.5), ha="center", color=GREY, xycoords="axes fraction")
    return True
