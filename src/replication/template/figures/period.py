"""Period of a pendulum against amplitude: two routes, and the series as printed and as meant."""

from replication.drawing import ACCENT, GREY, INK, SINGLE, make_figure, note, sheet


def draw(period):
    figure, axis = sheet(SINGLE, 60)
    x = period.amplitude_deg
    axis.plot(x, period.by_elliptic_integral, color=INK)
    axis.plot(x[::2], period.by_integration[::2], "o", color=INK, markersize=2.5)
    axis.plot(x, period.as_meant, color=GREY, linestyle=(0, (4, 2)))
    axis.plot(x, period.as_printed, color=ACCENT, linestyle=(0, (4, 2)))
    note(axis, "elliptic integral (line),\nintegration in time (dots)", (138, 2.05), ha="right")
    note(axis, "$1+\\theta_0^2/16$, as meant", (178, 1.2), ha="right", color=GREY)
    note(axis, "$1-\\theta_0^2/16$, as printed", (88, 0.62), ha="right", color=ACCENT)
    axis.set(xlabel=r"Amplitude, $\theta_0$ (°)", ylabel="Period over that of small swings (–)")
    axis.set(xlim=(0, 180), ylim=(0.4, 3), xticks=range(0, 181, 30))
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
