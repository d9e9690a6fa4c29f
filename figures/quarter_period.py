"""The period of free rocking against its amplitude, exact and linearised."""

from figures.palette import greys
from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, sheet


def draw(quarter_period):
    figure, (left, right) = sheet(DOUBLE, 52, ncols=2)
    exact = quarter_period[~quarter_period.linearised].groupby("slenderness_deg")
    linear = quarter_period[quarter_period.linearised].groupby("slenderness_deg")
    for (slenderness, line), colour in zip(exact, greys(len(exact)), strict=True):
        other = linear.get_group(slenderness)
        excess = 100.0 * (other.quarter_period.to_numpy() / line.quarter_period - 1.0)
        right.plot(line.start_fraction, excess, color=colour)
        middle = line.start_fraction.sub(0.1).abs().argmin()
        text = f"$\\alpha$ = {slenderness:g}°"
        at = (line.start_fraction.iloc[middle], excess.iloc[middle])
        note(right, text, at, xytext=(5, -7), textcoords="offset points")
    left.plot(line.start_fraction, line.quarter_period, color=INK)
    left.axvline(1.0, color=GREY, linewidth=0.8, linestyle=(0, (4, 2)))
    note(left, "barrier at $\\alpha$", (0.985, 0.35), ha="right", color=GREY)
    note(
        left,
        f"drawn: exact, $\\alpha$ = {slenderness:g}°;\n"
        "other $\\alpha$ and the linearised\nequation lie within its line",
        (0.06, 3.6),
        color=GREY,
    )
    left.set(ylabel=r"Quarter period, $pT/4$ (–)", ylim=(0, 5.6))
    right.axhline(0, color=GREY, linewidth=0.6)
    right.set_ylabel("Change by linearisation (%)")
    for axis in (left, right):
        axis.set(xlabel=r"Rotation amplitude, $\theta_0/\alpha$ (–)", xlim=(0, 1.02))
    letter(
        [left, right], ["Quarter period against amplitude", "Effect of linearisation on the period"]
    )
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
