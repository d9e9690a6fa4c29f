"""Forces at the four contacts during one history, and the required coefficient of friction."""

from replication.drawing import DOUBLE, GREY, INK, letter, make_figure, note, sheet

LINES = {  # contact: label, colour, dashes
    "base_left": ("left base", INK, "-"),
    "base_right": ("right base", INK, "--"),
    "seat_left": ("left column top", GREY, "-"),
    "seat_right": ("right column top", GREY, "--"),
}


def draw(mechanism_forces):
    table, last = mechanism_forces, mechanism_forces.time.max()
    figure, axes = sheet(DOUBLE, 80, nrows=2, ncols=2, sharex=True)
    motion, vertical, horizontal, demand = axes.ravel()
    motion.plot(table.time, table.rotation, color=INK)
    motion.plot(table.time, table.ground, color=GREY, linewidth=0.8)
    note(motion, r"$\ddot{u}_g/(g\,\tan\alpha)$", (1.0, 1.7), color=GREY)
    note(motion, r"$\theta/\alpha$", (2.3, 0.85))
    for name, (label, colour, dashes) in LINES.items():
        how = {"color": colour, "linestyle": dashes, "label": label, "linewidth": 1.0}
        vertical.plot(table.time, table[f"{name}_vertical"], **how)
        horizontal.plot(table.time, table[f"{name}_horizontal"], **how)
        demand.plot(table.time, table[f"{name}_demand"], **how)
    for axis in axes.ravel():
        axis.axhline(0.0, color=GREY, linewidth=0.5)
    demand.axhline(1.0, color=GREY, linewidth=0.5, linestyle=":")
    motion.set(ylabel="Rotation, shaking (–)")
    vertical.set(ylabel="Force over weight (–)", ylim=(0, None))
    horizontal.set(ylabel="Force over weight (–)")
    demand.set(ylabel=r"Friction, $\mu/\tan\alpha$ (–)", ylim=(0, None), xlim=(0, last))
    for axis in (horizontal, demand):
        axis.set_xlabel(r"Time, $pt$ (–)")
    figure.legend(*vertical.get_legend_handles_labels(), loc="outside upper right", ncols=4)
    letter(
        axes.ravel(),
        ["Motion", "Vertical forces", "Horizontal forces", "Required coefficient of friction"],
    )
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
