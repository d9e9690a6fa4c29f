"""Write the table, and draw how a column rocks after its release, in engines and by Eq. (23)."""

import json
import math
from pathlib import Path

import matplotlib.pyplot as plt
from rock import ALPHA, COLUMN, CONFIG, P

from topheavy import Pulse, RockingFrame, lowest_overturning, simulate

LIMITS = "uplift", "minimum"
COLOURS = "#c8501a", "#1f4e79", "#3a7d44", "#b8860b", "#7b3f8c", "#008b8b"


def released(mass_ratio):
    """Return the coefficient of restitution of Eq. (25), and the response by Eq. (23)."""
    structure = RockingFrame(COLUMN, mass_ratio) if mass_ratio else COLUMN
    release, duration = CONFIG["release"].values()
    response = simulate(structure, rotation=release * ALPHA, duration=duration)
    return structure.restitution, response


def rows(run):
    """Yield a row of the table for each structure: p̂ is over that of theory."""
    for free in run["free"]:
        restitution, response = released(free["mass_ratio"])
        ratio = response.impact_times[0] / free["upright"]
        limits = {key: run[key] if math.isfinite(run[key]) else "never" for key in LIMITS}
        yield (
            free
            | run
            | limits
            | {"frequency": ratio, "restitution": restitution, "free": 0, "history": 0}
        )


def draw(runs):
    plt.rcParams.update({"font.size": 8, "svg.hashsalt": "engines"})
    figure, axes = plt.subplots(1, 2, figsize=(6.7, 2.2), layout="constrained", sharey=True)
    colours = dict(zip(dict.fromkeys(run["engine"] for run in runs), COLOURS, strict=True))
    _, exact = released(0)
    for axis, is_default in zip(axes, (True, False), strict=True):
        axis.plot(exact.time, exact.rotation / ALPHA, color="#bbbbbb", linewidth=2.5)
        for run in (run for run in runs if run["is_default"] == is_default):
            style = {"color": colours[run["engine"]], "linewidth": 0.8, "label": run["engine"]}
            axis.plot(*run["free"][0]["history"], **style)
        axis.set(xlabel="Time (s)", title="Defaults" if is_default else "Closest settings")
    axes[0].set(ylabel="Rotation θ/α (–)", ylim=(-0.8, 0.55))
    axes[1].legend(frameon=False, ncols=3, loc="lower right", fontsize=6.5)
    figure.savefig("results/figure.svg", metadata={"Date": None})


if __name__ == "__main__":
    paths = [Path(f"results/run_{k}.json") for k in range(len(CONFIG["runs"]))]
    runs = [json.loads(path.read_text()) for path in paths]
    draw(runs)
    g_tan, pulse = (
        COLUMN.uplift_acceleration,
        Pulse("one-sine", 1.0, angular_frequency=CONFIG["pulse"]["frequency"] * P),
    )
    lowest = lowest_overturning(COLUMN, pulse, (g_tan, 3.0 * g_tan), floor=1e-3 * g_tan)
    numbers = {"rows": [row for run in runs for row in rows(run)]}
    numbers["minimum"] = lowest.acceleration / g_tan
    Path("results/summary.json").write_text(json.dumps(numbers))
