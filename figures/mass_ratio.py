"""Size and frequency parameter of the equivalent column against mass ratio: Eqs. (23), (24)."""

import numpy as np

from replication.drawing import DOUBLE, GREY, INK, PAPER, letter, make_figure, note, sheet

GAMMA = r"Mass ratio, $\gamma = m_\mathrm{b}/2m_\mathrm{c}$ (–)"


def draw(mass_ratio):
    finite = mass_ratio[np.isfinite(mass_ratio.mass_ratio)]
    last = mass_ratio.iloc[-1]
    figure, axes = sheet(DOUBLE, 56, ncols=2)
    panels = (
        ("size_ratio", "share_of_size_gain", r"limit $3/2$", r"$\hat{R}$"),
        ("frequency_ratio", "share_of_frequency_gain", r"limit $\sqrt{2/3}$", r"$\hat{p}$"),
    )
    for axis, (name, share, limit, of) in zip(axes, panels, strict=True):
        up = 1 if last[name] > 1.0 else -1
        beside = {"textcoords": "offset points"}
        axis.axhline(last[name], color=GREY, linestyle=(0, (4, 2)), linewidth=0.8)
        limit += r" for $\gamma\to\infty$"
        note(axis, limit, (10, last[name]), xytext=(0, 7 * up), ha="right", color=GREY, **beside)
        axis.plot(finite.mass_ratio, finite[name], color=INK)
        axis.plot(0, 1, "o", color=INK, markersize=3.5, clip_on=False, zorder=3)
        note(axis, "solitary column", (0, 1), xytext=(8, 0), **beside)
        for part in (0.5, 0.9):
            at = np.interp(part, finite[share], finite.mass_ratio)
            reached = np.interp(part, finite[share], finite[name])
            text = f"{100 * part:.0f} % of the change in {of} at $\\gamma$ = {at:.2g}"
            axis.plot(at, reached, "o", color=INK, markerfacecolor=PAPER, markersize=3.5, zorder=3)
            note(axis, text, (at, reached), xytext=(5, -9 * up), **beside)
    axes[0].set(xlabel=GAMMA, ylabel=r"Size, $\hat{R}/R$ (–)", ylim=(0.97, 1.55))
    axes[1].set(xlabel=GAMMA, ylabel=r"Frequency parameter, $\hat{p}/p$ (–)", ylim=(0.79, 1.01))
    for axis in axes:
        axis.set_xlim(0, 10)
    letter(axes, ["Size of the equivalent column", "Frequency parameter of the frame"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
