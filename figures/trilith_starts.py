"""The trilith below its uplift acceleration: two starts of the shake table."""

from figures.palette import SURVIVES
from replication.drawing import DOUBLE, GREY, INK, PALE, PAPER, letter, make_figure, note, sheet


def draw(trilith_starts, trilith_histories):
    figure, (left, right) = sheet(DOUBLE, 62, ncols=2, width_ratios=(1.3, 1))
    histories = trilith_histories.groupby("share_of_speed")
    abrupt, smooth = histories.get_group(1.0), histories.get_group(0.0)
    steady = trilith_starts.late_peak_over_alpha.iloc[-1]
    left.plot(abrupt.time, abrupt.rotation_over_alpha, color=SURVIVES, linewidth=0.8)
    left.plot(smooth.time, smooth.rotation_over_alpha, color=INK, linewidth=1.6)
    for level in (-steady, steady):
        left.axhline(level, color=GREY, linewidth=0.7, linestyle=(0, (4, 2)))
    note(
        left,
        "table at full speed from the first instant: keeps rocking",
        (1.6, 0.108),
        color=SURVIVES,
    )
    note(left, f"steady amplitude {steady:.3f}$\\,\\alpha$", (11.9, -0.08), ha="right", color=GREY)
    note(left, "table from rest: stays at rest", (1.6, -0.105), color=INK)
    left.annotate(
        "",
        (1.5, 0),
        (1.75, -0.095),
        arrowprops={"arrowstyle": "-", "color": INK, "linewidth": 0.6, "shrinkB": 0},
    )
    left.set(
        xlabel="Time, $t$ (s)",
        ylabel=r"Rotation, $\theta/\alpha$ (–)",
        xlim=(0, abrupt.time.max()),
        ylim=(-0.125, 0.125),
    )

    share, rocking = trilith_starts.share_of_speed, trilith_starts.outcome == "rocking"
    last_rest, first_rocking = share[~rocking].max(), share[rocking].min()
    right.axvspan(last_rest, first_rocking, color=PALE, linewidth=0)
    for kept in (~rocking, rocking):
        part = trilith_starts[kept]
        right.plot(
            part.share_of_speed,
            part.peak_over_alpha,
            "o-",
            color=INK,
            markersize=3,
            markerfacecolor=PAPER,
            linewidth=0.8,
        )
        right.plot(part.share_of_speed, part.late_peak_over_alpha, "o-", color=INK, markersize=3)
    note(right, "largest rotation", (1.0, 0.126), ha="right")
    note(right, "steady rotation", (1.0, 0.055), ha="right", color=INK)
    note(right, "comes to rest", (0.25, 0.03), ha="center")
    note(right, "keeps rocking", (0.775, 0.09), ha="center")
    right.set(
        xlabel=r"Share of the speed $2\pi f u_0$ taken up at once (–)",
        xlim=(-0.02, 1.03),
        ylabel=r"Amplitude, $|\theta|/\alpha$ (–)",
        ylim=(-0.004, 0.135),
    )
    titles = [
        "Histories for two starts of the table",
        "Rotation against initial speed of the table",
    ]
    letter([left, right], titles, first="c")
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
