"""Factors on the record that overturn"""

from replication.drawing import ACCENT, DOUBLE, GREY, sheet

ALT = "Two strips of lines: those of the column begin lower and are denser than those of the bent."


def draw(example_capacity):
    figure, axis = sheet(DOUBLE, 30)
    for place, (body, colour) in enumerate({"column": GREY, "bent": ACCENT}.items()):
        overturning = example_capacity.factor[example_capacity[body]]
        axis.eventplot(
            overturning, lineoffsets=place, linelengths=0.7, linewidths=0.2, colors=colour
        )
    axis.set(yticks=[0, 1], yticklabels=["one column", "bent"], xlabel="Factor on the record (–)")
    return figure
