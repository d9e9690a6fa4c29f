"""Fragility of bare column, fixed mass and frame; and the forces that uplift limits."""

from figures.drawing import gamma
from figures.palette import ALONE, EQUAL, FIXED
from replication.drawing import DOUBLE, GREY, PAPER, letter, make_figure, note, shades, sheet

LOOKS = {"bare": ("column", ALONE), "fixed": ("mass fixed", FIXED), "free": ("mass carried", EQUAL)}
HEAVIEST = shades(2)[1]  # γ = 4 of frames, here
LABELS = {"bare": (1.28, 0.42), "fixed": (0.42, 0.80), "free": (1.28, 0.28)}
SHOWN = (0.0, 1.0, 4.0)  # γ of the forces
FORCES = {
    "base_shear": "base shear",
    "overturning_moment": "overturning",
    "bending_moment": "bending",
}


def fragility(axis, cells, labelled):
    ratios = sorted(cells.mass_ratio.unique())
    for (name, ratio), line in cells.groupby(["structure", "mass_ratio"]):
        heaviest = ratio == ratios[-1]
        colour = HEAVIEST if heaviest and name == "free" else LOOKS[name][1]
        if not heaviest:
            band = (line.intensity, line.probability_low, line.probability_high)
            axis.fill_between(*band, color=colour, alpha=0.18, linewidth=0)
        axis.plot(line.intensity, line.probability, "--" if heaviest else "-", color=colour)
    for name, (label, colour) in LOOKS.items():
        if labelled:
            side = {"ha": "right"} if name == "fixed" else {}
            note(axis, label, LABELS[name], color=colour, **side)
    axis.set(xscale="log", xlim=(0.15, 2.4), ylim=(0, 1))
    axis.set_xticks((0.2, 0.5, 1, 2), ("0.2", "0.5", "1", "2"))
    axis.set_xticks([], minor=True)
    axis.set(xlabel=r"Intensity, $p\,\mathrm{PGV}/(g\,\tan\alpha)$ (–)")


def forces(axis, bands):
    of = bands[(bands.held == "rigid") & (bands.family == "near-fault") & (bands.top == "pinned")]
    ratios, levels = [g for g in SHOWN if (of.mass_ratio == g).any()], sorted(of.intensity.unique())
    for place, force in enumerate(FORCES):
        for shift, (ratio, colour) in enumerate(zip(ratios, shades(len(ratios)), strict=True)):
            for later, level in enumerate(levels):
                cells = of[(of.force == force) & (of.mass_ratio == ratio) & (of.intensity == level)]
                row = cells.iloc[0]
                x = place + 0.25 * (shift - 1) + 0.08 * later
                axis.vlines(x, row.ratio_low, row.ratio_high, color=colour, linewidth=1.0)
                face = colour if later else PAPER
                axis.plot(x, row.ratio, "o", color=colour, markersize=3.5, markerfacecolor=face)
    for shift, (ratio, colour) in enumerate(zip(ratios, shades(len(ratios)), strict=True)):
        note(axis, gamma(ratio), (1.75, 0.92 - 0.09 * shift), color=colour)
    axis.axhline(1.0, color=GREY, linewidth=0.6)
    axis.set(ylim=(0, 1.1), xlim=(-0.5, 2.6), ylabel="Rocking over rigid held (–)")
    axis.set_xticks(range(len(FORCES)), FORCES.values())


def draw(reversals_vase, reversals_uplift):
    figure, axes = sheet(DOUBLE, 66, ncols=3)
    for place, family in enumerate(("near-fault", "broadband")):
        cells = reversals_vase[reversals_vase.family == family]
        fragility(axes[place], cells, labelled=place == 0)
    axes[0].set_ylabel("Probability of overturning (–)")
    forces(axes[2], reversals_uplift)
    letter(axes, ["Near-fault motions", "Broadband motions", "Largest forces"])
    return figure


if __name__ == "__main__":
    make_figure(snakemake, draw)
