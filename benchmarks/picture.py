"""Draw the work–precision curves of the benchmark: `python benchmarks/picture.py`."""

from pathlib import Path

import matplotlib.pyplot as plt
import pandas as pd

from replication.drawing import DOUBLE, GREY, INK, letter, note, sheet

LOOKS = {
    "this kernel": {"color": INK, "linewidth": 1.8},
    "scalar kernel": {"color": INK, "linewidth": 0.9},
    "heyoka, our tail": {"color": INK, "linestyle": (0, (1, 1.5))},
    "heyoka": {"color": INK, "linestyle": (0, (4, 2))},
    "solve_ivp, our tail": {"color": GREY},
    "solve_ivp": {"color": GREY, "linestyle": (0, (4, 2))},
}


def draw(curves: pd.DataFrame, machine: str, path: Path) -> None:
    """Save the time of a history over its error, method by method."""
    plt.style.use("figures/style.mplstyle")
    figure, axes = sheet(DOUBLE, 78, ncols=2)
    for axis, what in zip(axes, ("pulse", "record"), strict=True):
        for method, curve in curves[curves.what == what].groupby("method"):
            curve = curve.sort_values("tolerance")
            look = LOOKS["heyoka, our tail" if (what, method) == ("record", "heyoka") else method]
            axis.loglog(curve.error_q99, curve.microseconds, marker="o", markersize=2.5, **look)
            last, is_steep = curve.iloc[0], (what, method) == ("record", "this kernel")
            note(
                axis,
                method,
                (last.error_q99, last.microseconds),
                xytext=(-5, -3) if is_steep else (0, 6),
                ha="right" if is_steep else "left",
                textcoords="offset points",
                color=look["color"],
            )
        axis.axvline(1e-8, color=GREY, linewidth=0.6, linestyle=":")
        axis.set(xlabel=r"99 % error of max|$\theta$|/$\alpha$ (–)", xlim=(1e-15, 1e-1))
        axis.set_ylabel("Time of a history, one thread (µs)")
    letter(axes, ["One-sine pulses", "Records: solve_ivp and heyoka at their best"])
    figure.supxlabel(machine, fontsize=6.5, color=GREY)
    figure.savefig(path, metadata={"Date": None})
    plt.close(figure)


if __name__ == "__main__":
    from steps.publish import machine

    table = pd.read_csv("results/benchmark/work_precision.csv")
    draw(table, machine(), Path("docs/benchmark.svg"))
