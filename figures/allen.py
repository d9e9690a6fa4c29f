"""The model of Allen et al. beside the exact frame: histories and error of the peak."""

from palette import GREY, INK, MODEL, PAPER

from replication.drawing import DASHED, DOUBLE, gamma, letter, logarithmic, note, sheet

MODELS = {  # the simplifications of Allen et al. (1986): words, line, face of the markers
    "all": ("all three: Allen et al.", "-", MODEL),
    "massless frequency": (r"mass neglected in $\hat{p}$", ":", INK),
    "massless restitution": (r"mass neglected in $\sqrt{r}$", (0, (5, 1, 1, 1)), INK),
    "linearised": ("linearised", DASHED, PAPER),
}
MOTIONS = {"pulse": "One-sine pulse", "record": "El Centro 1940, scaled"}


def history(above, below, run):
    above.plot(run.time, run.acceleration, color=GREY, linewidth=0.7)
    above.set_ylabel(r"$\ddot{u}_g$ (g)")
    below.plot(run.time, run.exact, color=INK, linewidth=0.8)
    below.plot(run.time, run["all"], color=MODEL, linewidth=0.8)
    change = run["all"].abs().max() / run.exact.abs().max() - 1
    words = f"peak {100 * change:+.0f} %".replace("-", "−")
    note(below, words, (0.985, 0.93), xycoords="axes fraction", ha="right", color=MODEL)
    below.set(
        ylim=(-1, 1.1),
        ylabel=r"$\theta/\alpha$ (–)",
        xlabel="Time, $t$ (s)",
        xlim=(0, run.time.max()),
    )


def errors(axis, table):
    """Draw the median error over γ under the first pulse, of each simplification and of all."""
    pulse = ["shape", "frequency_ratio"]
    quoted = table[(table[pulse] == table[pulse].iloc[0]).all(axis=1)]
    for model, (words, dash, face) in MODELS.items():
        line = quoted[quoted.model == model]
        look = {"color": MODEL if model == "all" else INK, "marker": "o", "markerfacecolor": face}
        hollow = face == PAPER  # and larger: seen where two lines lie on each other
        look |= {"markersize": 5 if hollow else 3, "zorder": 3 - hollow, "linestyle": dash}
        axis.plot(line.mass_ratio, 100 * line.median_error, label=words, **look)
    whole = quoted[quoted.model == "all"]
    for row in whole.iloc[[0, len(whole) // 2, -1]].itertuples():
        error = 100 * row.median_error
        note(axis, f"{error:.0f} %", (row.mass_ratio, error), (5, 5), color=MODEL)
    logarithmic(axis, sorted(table.mass_ratio.unique()))
    axis.set(xlabel=r"Mass ratio, $\gamma$ (–)", ylabel="Error of the peak (%)", ylim=(0, 30))
    axis.legend(loc="upper right", labelspacing=0.2)


def draw(allen_histories, allen_errors, config):
    figure, axes = sheet(DOUBLE, 56, "ace;bde", width_ratios=(1, 1, 1.15), height_ratios=(0.45, 1))
    for (above, below), motion in zip((("a", "b"), ("c", "d")), MOTIONS, strict=True):
        history(axes[above], axes[below], allen_histories[allen_histories.motion == motion])
        axes[above].sharex(axes[below])
        axes[above].tick_params(labelbottom=False)
    note(axes["b"], "exact", (0.5, 0.16), xycoords="axes fraction")
    note(axes["b"], "Allen et al.", (0.5, 0.05), xycoords="axes fraction", color=MODEL)
    errors(axes["e"], allen_errors)
    ratio = gamma(config["allen"]["mass_ratio"])
    titles = [*(f"{words}, {ratio}" for words in MOTIONS.values()), r"Median error over $\gamma$"]
    letter([axes["a"], axes["c"], axes["e"]], titles)
    return figure
