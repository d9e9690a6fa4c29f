"""Each figure, drawn from the published tables, shows these: its lines, points, areas and words.

The artists of each panel are put together by their look, as "#8c6d00 o-". The points of each look
have to be those of the tables; so have words with a decimal, a share or an angle, and the labels
of lines. Decoration may be there beside them, and so may what else is drawn of bodies.
"""

import math
import re
import runpy
from collections import defaultdict
from inspect import signature
from itertools import pairwise

import numpy as np
import pandas as pd
import pytest
from matplotlib import collections
from matplotlib.colors import to_hex
from matplotlib.text import Annotation

from replication.drawing import shades
from tests.cases import CONFIG, ROOT

INK, GREY, WHITE = "#1a1a1a", "#737373", "#ffffff"
OVERTURNS, SURVIVES, PREVENTED, CAUSED = "#c8501a", "#12715f", "#c79a0a", "#a3195b"
MODEL, FIXED = "#6a3d9a", "#8c6d00"
LIGHT, MIDDLE, DARK = (to_hex(colour) for colour in shades(3))  # the column, γ = 1 and γ → ∞
BOTH, AT_ONCE, ROCKS = "#f1d3c6", "#db8d6a", "#d0e3df"  # areas
SPECTRA_COLOURS = {0.0: LIGHT, 1.0: MIDDLE, math.inf: DARK}


def gamma(ratio):
    return "γ=∞" if math.isinf(ratio) else f"γ = {ratio:g}"


def by_gamma(table):
    """Return the rows of each γ with their colour, lighter for a lighter beam."""
    groups = list(table.groupby("mass_ratio"))
    return [
        (ratio, rows, to_hex(c))
        for (ratio, rows), c in zip(groups, shades(len(groups)), strict=True)
    ]


# What a figure shows ------------------------------------------------------------------------------


def plain(words):
    """Return words without the marks of mathematics."""
    for name, letter in {"gamma": "γ", "infty": "∞", "alpha": "α", "omega": "ω", "pi": "π"}.items():
        words = words.replace(f"\\{name}", letter)
    return " ".join(re.sub(r"[${}]|\\[a-z]+|\\", "", words.replace(r"\,", " ")).split())


def of_line(line):
    label, face = plain(str(line.get_label())), line.get_markerfacecolor()
    marker, dash = (
        "" if one in ("None", "none", None) else one
        for one in (line.get_marker(), line.get_linestyle())
    )
    if marker and to_hex(face) == WHITE:
        marker = f"hollow {marker}"
    look = f"{to_hex(line.get_color())} {marker}{dash if line.get_linewidth() else ''}"
    return f"{look} {'' if label.startswith('_') else label}".strip(), line.get_xydata()


def of_collection(one):
    if isinstance(one, collections.QuadMesh):
        corners = one.get_coordinates()
        centres = (corners[:-1, :-1] + corners[1:, 1:]) / 2
        colours = one.cmap(one.norm(one.get_array()))
        for colour in np.unique(colours.reshape(-1, 4), axis=0):
            if colour[3]:
                yield f"{to_hex(colour)} mesh", centres[(colours == colour).all(axis=2)]
    elif isinstance(one, collections.LineCollection):
        yield f"{to_hex(one.get_color()[0])} segments", np.vstack(one.get_segments())
    elif isinstance(one, collections.PathCollection):
        faces = [*map(to_hex, one.get_facecolor()), "none"]
        yield f"{faces[0]} in {to_hex(one.get_edgecolor()[0])}", np.array(one.get_offsets())
    else:
        area = np.vstack([path.vertices for path in one.get_paths()])
        yield f"{to_hex(one.get_facecolor()[0])} area", area


def shown(figure):
    """Yield panel, look and points of all artists, and panel, words and place of texts."""
    for panel, axis in enumerate(figure.axes):
        for line in axis.lines:
            yield panel, *of_line(line)
        for one in axis.collections:
            for look, points in of_collection(one):
                yield panel, look, points
        for one in axis.patches:
            vertices = one.get_patch_transform().transform(one.get_path().vertices)
            name = f"{to_hex(one.get_facecolor())} in {to_hex(one.get_edgecolor())}"
            yield panel, f"{name} {type(one).__name__}", vertices
        legend = axis.get_legend()
        handles = legend.get_texts() if legend else []
        ticks = [*axis.get_yticklabels(), *axis.get_xticklabels()]
        for text in [*axis.texts, *handles, axis.title, *ticks]:
            words = plain(text.get_text())
            is_number = re.fullmatch(r"[−\d.^ ]*|10\^-\d", words) is not None
            if words and not (is_number and text in ticks):
                place = text.xy if isinstance(text, Annotation) else (math.nan, math.nan)
                yield panel, f"{to_hex(text.get_color())} “{words}”", np.array([place])


# What the tables have: panel, look, x and y; or panel and words ----------------------------------


def allen(allen_histories, allen_errors):
    for panel, motion in ((0, "pulse"), (1, "record")):
        run = allen_histories[allen_histories.motion == motion]
        change = run["all"].abs().max() / run.exact.abs().max() - 1
        yield panel, f"{GREY} -", run.time, run.acceleration
        yield panel + 3, f"{INK} -", run.time, run.exact
        yield panel + 3, f"{MODEL} -", run.time, run["all"]
        yield panel + 3, f"{MODEL} “peak −{-100 * change:.0f} %”"
    first = allen_errors.query("shape == 'one-sine' and frequency_ratio == 5").set_index("model")
    for model, look in {
        "linearised": f"{INK} o-- linearised",
        "massless frequency": f"{INK} o: p for γ∞",
        "massless restitution": f"{INK} o-- r for γ∞",
        "all": f"{MODEL} o- all three: Allen et al.",
    }.items():
        yield 2, look, first.loc[model].mass_ratio, 100 * first.loc[model].median_error
    for at in (0.5, 2.0, 10.0):
        error = 100 * first[first.mass_ratio == at].median_error["all"]
        yield 2, f"{MODEL} “{error:.0f} %”", at, error


def allen_maps(allen_maps):
    table = allen_maps
    outcomes = [WHITE, "#ad94c7", MODEL, BOTH]  # both survive, falsely overturned, falsely safe
    for panel, model in ((0, "linearised"), (1, "all")):
        for (exact, wrong), cells in table.groupby(["exact", model]):
            look = f"{outcomes[2 * exact + wrong]} mesh"
            yield panel, look, cells.frequency_ratio, cells.amplitude_over_uplift
        for words, exact in (("safe", 1), ("overturned", 0)):
            share = ((table.exact == exact) & (table[model] != exact)).mean()
            yield panel, f"#000000 “falsely {words}: {100 * share:.1f} %”"


def break_even(break_even, break_even_benefit):
    names = {  # rows from below
        (lowered, share): f"{lowered} {100 * share:g} % lower"
        for lowered in ("column alone", "both")
        for share in (0.1, 0.05)
    }
    names |= {("both", 0.0): "both of Eq. (25)", ("impulses within the contacts", 0.0): ""}
    for name, marker, off in (("near-fault", "o", 0.14), ("broadband", "hollow s", -0.14)):
        rows = break_even_benefit[break_even_benefit.set == name].set_index(
            ["lowered", "reduction"]
        )
        for place, key in enumerate(names):
            row = 100 * rows.loc[key, ["benefit", "benefit_low", "benefit_high"]]
            label = "" if place else f" {name}"
            yield 0, f"{INK} {marker}{label}", row.benefit, place + off
            yield 0, f"{INK} segments", row[["benefit_low", "benefit_high"]], [place + off] * 2
        at = np.arange(4) - off
        of = 100 * break_even[break_even.set == name].sort_values("velocity").iloc[:, -3:]
        yield 1, f"{INK} {marker}", at, of.end
        yield 1, f"{INK} segments", [*at, *at], [*of.end_low, *of.end_high]
    for words in filter(None, names.values()):
        yield 0, f"#000000 “{words}”"
    yield 0, "#000000 “(a) Benefit at 0.6 m/s, by r”"


def cycles(spectra_cycles):
    table = spectra_cycles[spectra_cycles.cycles == 3]
    wide = table.pivot_table("wide_minimum", ["slenderness_deg", "frequency_ratio"], "mass_ratio")
    lowest = table.pivot_table("minimum", ["slenderness_deg", "frequency_ratio"], "mass_ratio")
    ratios, colours = list(lowest), [to_hex(c) for c in shades(lowest.shape[1])]
    falls = {pair: wide[pair[1]] / lowest[pair[0]] for pair in pairwise(ratios)}
    slenderness, between = min((falls[p] for p in pairwise(ratios[1:])), key=min).idxmin()
    of_column = {heavy: (wide[heavy] / lowest[0.0]).loc[slenderness] for heavy in ratios[1:]}
    at = {1: between, 2: min(of_column.values(), key=min).idxmin()}
    wide, lowest = wide.loc[slenderness], lowest.loc[slenderness]
    for ratio, colour in zip(ratios, colours, strict=True):
        y = lowest[ratio].where(lowest[ratio] < 2.6)
        yield 0, f"{colour} - {gamma(ratio)}", lowest.index, y
    for light, heavy in pairwise(ratios):
        fell = wide[heavy][wide[heavy] < lowest[light]]
        yield 0, f"{CAUSED} hollow o", fell.index, fell
    upper = table[table.slenderness_deg == slenderness].set_index(["frequency_ratio", "mass_ratio"])
    for panel, frequency in at.items():
        yield panel, f"#000000 “({'abc'[panel]}) Lowest interval, ω = {frequency:.3g} p”"
        for place, (ratio, colour) in enumerate(zip(ratios, colours, strict=True)):
            low, high = wide[ratio][frequency], upper.wide_upper[frequency, ratio]
            below = place and low < lowest[ratios[place - 1]][frequency]
            ink = CAUSED if below else INK
            if low > 2.6:
                yield panel, f"{ink} “{low:.2f}”", place, 2.51
                continue
            x, y = place + 0.31 * np.array([-1, 1, 1, -1]), np.repeat([low, high], 2)
            yield panel, f"{colour} in #000000 Rectangle", x, y
            yield panel, f"{ink} “{low:.3f}”", place, low - 0.02


def engine(engine_restitution, engine_across):
    frames = engine_restitution[engine_restitution.mass_ratio > 0]
    greys = ("#b4b4b4 o-", "#818181 s--", "#4d4d4d ^-.", f"{INK} D:")
    for place, (look, (_, of)) in enumerate(
        zip(greys, frames.groupby("damping_ratio"), strict=True)
    ):
        ends = (of.engine / of.theory).groupby(of.time_constant).agg(["min", "max"])
        x = ends.index * 1.07 ** (place - 1.5)
        yield 0, look, x, ends.mean(axis=1)
        yield 0, f"{look[:7]} segments", [*x, *x], [*ends["min"], *ends["max"]]
        yield 0, f"#000000 “{of.point_restitution.iloc[0]:.2f}”"
    square = engine_across.query("structure == 'two in line' and section == 'square'")
    first = square[square.frequency_ratio == engine_across.frequency_ratio[0]]
    first = first.drop_duplicates(["depth_over_width", "mass_ratio", "direction"])
    for (ratio, of), colour in zip(first.groupby("mass_ratio"), (MIDDLE, DARK), strict=True):
        across = of[of.direction > 0]
        yield 1, f"{colour} - {gamma(ratio)}", across.depth_over_width, across.theory
        yield 1, f"{colour} o", across.depth_over_width, across.engine
        yield 1, f"{colour} :", [0, 1], [of[of.direction == 0].theory.iloc[0]] * 2
        yield 1, f"#000000 “{gamma(ratio)}”"


def friction(friction_pulses):
    table, bays = friction_pulses, [5.0, 2.4]
    alone = table[table.mass_ratio == 0].required
    for panel, bay in enumerate(bays):
        of = [
            (f"{c} - {gamma(g)}", rows.required) for g, rows, c in by_gamma(table[table.bay == bay])
        ]
        for look, required in [*of, (f"{INK} -- column alone", alone)]:
            share = 100 * required.rank(method="first", pct=True)
            yield panel, look, required, share
        yield panel, f"#000000 “({'ab'[panel]}) Bay of {bay:g} m”"


def motions(motions_fragility, motions_gains):
    sets = CONFIG["motions"]
    temple = motions_fragility[motions_fragility.column == sets["structure"]]
    of = {"column": (LIGHT, 0), "fixed mass": (FIXED, 1), "frame": (MIDDLE, 1)}
    for panel, family in enumerate(("near-fault", "broadband")):
        for dash, quake in (("-", "M 6.5"), ("--", "M 7.3")):
            for name, (colour, ratio) in of.items():
                line = temple[(temple.structure == name) & (temple.mass_ratio == ratio)]
                line = line[line.model == f"{family}, {quake}"]
                yield panel, f"{colour} {dash}", line.velocity, line.probability
    for look, quake in ((f"{INK} - ", "M 6.5"), (f"{INK} -- ", "M 7.3")):
        yield 1, look + quake, [], []
        yield 1, f"#000000 “{quake}”"
    markers = {"trilith": ("^", 0.25), "temple": ("o", 0.0), "tall": ("s", -0.25)}
    of = motions_gains[motions_gains.mass_ratio == 1]
    for number, model in enumerate(of.model.unique()[::-1]):
        yield 2, f"#000000 “{model}”"
        for gain in of[of.model == model].itertuples():
            marker, aside = markers[gain.structure]
            height = f"{2 * CONFIG['structures'][gain.structure]['half_height']:g} m"
            ends = [100 * gain.gain_low, 100 * gain.gain_high]
            yield 2, f"{INK} {marker} {height}", 100 * gain.gain, number + aside
            yield 2, f"{GREY} segments", ends, [number + aside] * 2
            yield 2, f"#000000 “{height}”"


def parameters(mass_ratio, restitution):
    finite = mass_ratio[np.isfinite(mass_ratio.mass_ratio)]
    one = finite[finite.mass_ratio == 1.0].iloc[0]
    names = {"size_ratio": "size R/R", "frequency_ratio": "frequency parameter p/p"}
    for column, name in names.items():
        yield 0, f"{INK} -", finite.mass_ratio, finite[column]
        yield 0, f"{INK} hollow o", 1.0, one[column]
        yield 0, f"#000000 “{name} = {one[column]:.2f} at γ = 1”", 1.0, one[column]
    yield 0, f"{INK} o", 0, 1
    ends = {0.0: math.degrees(math.asin((2 / 3) ** 0.5)), math.inf: 45.0}
    for ratio, curve, colour in by_gamma(restitution):
        rocks = curve[curve.restitution >= 0]
        yield 1, f"{colour} :", curve.slenderness_deg, curve.restitution
        yield 1, f"{colour} - {gamma(ratio)}", rocks.slenderness_deg, rocks.restitution
        if ratio in ends:
            yield 1, f"{colour} o", ends[ratio], 0
            yield 1, f"#000000 “{ends[ratio]:.1f}°”", ends[ratio], 0


def spectra(spectra):
    cells = spectra[spectra.slenderness_deg == CONFIG["spectra"]["slendernesses"][1]]
    shapes = ("one-sine", "one-cosine", "ricker-symmetric", "ricker-antisymmetric")
    for panel in range(8):
        shape, scaled = shapes[panel % 4], panel > 3
        of = cells[cells["shape"] == shape]
        for ratio, colour in SPECTRA_COLOURS.items():
            mass = ratio / (1 + 2 * ratio) if ratio < math.inf else 0.5
            slower = math.sqrt(1 + mass) if scaled else 1.0  # p/p̂, Eq. (23)
            rows = of[of.mass_ratio == ratio]
            lowest = rows.groupby("frequency_ratio").lower.min()
            x = lowest.index * slower
            yield panel, f"{colour} - {gamma(ratio)}", x, lowest
            if lowest.iloc[-1] < 10.8 and x[-1] < 8:
                yield panel, f"{colour} hollow o", x[-1], lowest.iloc[-1]
            if scaled:
                rows = rows[rows["mode"] == "without impact"]
                lowest = rows.groupby("frequency_ratio").lower.min()
                yield panel, f"{GREY} -", lowest.index * slower, lowest
        yield panel, f"{GREY} -", [0, 1], [1, 1]
        if panel in (4, 5):
            x = np.linspace(0.5, 8.0, 61)
            yield panel, f"{GREY} :", x, x ** (2 if shape == "one-sine" else 3) / (2 * np.pi)


def structures(four_structures, moment_rotation):
    tall = four_structures[four_structures.structure == "column"].equivalent_size.iloc[0]
    for row in four_structures.itertuples():
        b, h, ratio = row.half_width, row.half_height, row.mass_ratio
        name = f"column {2 * h:g} m × {2 * b:g} m" if ratio == 0 else f"frame {gamma(ratio)}"
        size = f"{'R' if ratio else 'size'} = {row.equivalent_size / tall:.3g} R"
        yield 0, f"#000000 “{name} {size} {row.minimum_overturning:.3f} g”"
    level = four_structures.uplift_acceleration.iloc[-1]
    words = f"minimum overturning acceleration; all uplift at g α = {level:.3f} g"
    yield 0, f"{GREY} “{words}”"
    for panel, column in ((1, "moment"), (2, "moment_over_inertia")):
        loose = moment_rotation[moment_rotation.mass == "loose"]
        of = [(ratio, rows, colour, "") for ratio, rows, colour in by_gamma(loose)]
        fixed = moment_rotation[moment_rotation.mass == "fixed"]
        of += [(ratio, rows, FIXED, ", fixed") for ratio, rows in fixed.groupby("mass_ratio")]
        for ratio, rows, colour, end in of:
            y = rows[column] / loose[loose.mass_ratio == 0][column].max()
            label = f"{y.max():.2g}: {gamma(ratio) if ratio else 'column'}{end}"
            yield panel, f"{colour} - {label}", [0, *rows.rotation_over_alpha], [0, *y]
            yield panel, f"#000000 “{label}”"


def trilith(trilith_map, trilith_thresholds, trilith_starts, trilith_histories):
    fell = trilith_map[trilith_map.outcome == "overturned"]
    yield 0, f"{AT_ONCE} mesh", fell.frequency_hz, fell.amplitude_mm
    tested = trilith_thresholds.set_index("quantity").tested
    to_lift = trilith_thresholds.set_index("quantity").to_lift
    x = np.linspace(trilith_map.frequency_hz.min(), trilith_map.frequency_hz.max(), 361)
    y = to_lift["amplitude"] * (tested["frequency"] / x) ** 2  # the peak acceleration is constant
    assert to_lift["amplitude"] * tested["frequency"] ** 2 == pytest.approx(
        tested["amplitude"] * to_lift["frequency"] ** 2
    )
    yield 0, f"{INK} -", x, y
    test = tested["frequency"], tested["amplitude"]
    yield 0, f"{INK} o", *test
    yield 0, f"#000000 “test: {test[0]:g} Hz, {test[1]:g} mm”", *test
    runs, steady = trilith_histories, trilith_starts.late_peak_over_alpha.iloc[-1]
    yield 1, f"{SURVIVES} -", runs.time, runs.abrupt
    yield 1, f"{INK} -", runs.time, runs.smooth
    yield 1, f"{GREY} “steady amplitude {steady:.3f} α”"


def uplift(uplift):
    highest = uplift.peak_acceleration.max()
    yield 0, f"{INK} --", [0, highest], [0, highest]
    for ratio, of, colour in by_gamma(uplift):
        yield 0, f"{colour} o", of.peak_acceleration, of.base_shear
        yield 0, f"{colour} -", of.peak_acceleration, of.shear_after_uplift
        if ratio < math.inf:
            words = gamma(ratio) + ("" if ratio else ", column")
            level = of.sort_values("peak_acceleration").shear_after_uplift.iloc[-1]
            yield 0, f"{colour} “{words}”", 1.03 * highest, level


def vase(vase, vase_poses):
    poses, amplitudes = vase_poses, sorted(vase_poses.amplitude.unique())
    middles = {"column": 0.0, "fixed mass": 8.4, "frame": 19.3}
    for (amplitude, name), of in poses.groupby(["amplitude", "structure"]):
        ground = -10.2 * amplitudes.index(amplitude)
        over = of.outcome.iloc[0] == "overturned"
        colour, pale = (OVERTURNS, BOTH) if over else (SURVIVES, ROCKS)
        for (last, body), part in of.groupby(["last", "body"]):
            face = "#000000" if not last else colour if body == "cap" else pale
            yield 0, f"{face} in {colour} Polygon", part.x + middles[name], part.y + ground
        outcome = "overturns" if over else "survives"
        yield 0, f"{colour} “{outcome}”", middles[name], ground - 1.0
    for amplitude in amplitudes:
        yield 0, f"#000000 “{amplitude:g} g”"
    cosine = vase[vase["shape"] == "one-cosine"].sort_values("mass_ratio")
    finite = cosine[cosine.mass_ratio < math.inf]
    ratios = sorted(finite.mass_ratio.unique())
    end = math.ceil(ratios[-1]) + 1
    alone = cosine[cosine.structure == "column"].minimum_overturning.iloc[0]
    yield 1, f"{LIGHT} -", [0, end], [alone] * 2
    for name, colour in (("fixed mass", FIXED), ("frame", DARK)):
        of = cosine[cosine.structure == name].set_index("mass_ratio").minimum_overturning
        yield 1, f"{colour} o-", [0, *of.index[:-1]], [alone, *of.iloc[:-1]]
        yield 1, f"{colour} --", [ratios[-1], end], of.iloc[-2:]
        yield 1, f"{colour} o", end, of.iloc[-1]
    for amplitude in amplitudes:
        yield 1, f"{GREY} “{amplitude:g} g”", end, amplitude


def where(spectra, spectra_areas, spectra_histories):
    run = spectra_histories[["slenderness_deg", "shape"]].iloc[0]
    cells = spectra[(spectra[run.index] == run).all(axis=1)]
    for ratio, colour in ((0.0, LIGHT), (math.inf, DARK)):
        of = cells[cells.mass_ratio == ratio].assign(upper=cells.upper.fillna(16.0).clip(upper=16))
        after = of[of["mode"] == "with impact"]
        widest = after.loc[(after.upper - after.lower).groupby(after.frequency_ratio).idxmax()]
        for rows in (of[of["mode"] == "without impact"], widest):
            yield 0, f"{colour} -", [*rows.frequency_ratio] * 2, [*rows.lower, *rows.upper]
        history = spectra_histories[spectra_histories.mass_ratio == ratio]
        ink = OVERTURNS if ratio else SURVIVES
        x, y = history.time_over_period.to_numpy(), history.rotation_over_alpha.to_numpy()
        yield 1, f"{ink} -", x, y
        yield 1, f"{ink} hollow o", x[np.flatnonzero(y[:-1] * y[1:] < 0)[0]], 0.0
    pulse = spectra_histories.iloc[0]
    place = pulse.frequency_ratio, pulse.amplitude_over_uplift
    yield 0, f"{INK} hollow o", *place
    yield 0, f"#000000 “(a) One cosine, α = {pulse.slenderness_deg:g}°”"
    areas = spectra_areas.query("change == 'frame' and beside == 'column'")
    areas = areas[areas.mass_ratio == math.inf].sort_values("slenderness_deg")
    share = 100 * areas[(areas[run.index] == run).all(axis=1)].iloc[0][["caused", "prevented"]]
    yield 0, f"{CAUSED} “overturning caused on {share.caused:.1f} % of the map”", 3.2, 8.1
    yield 0, f"{INK} “overturning prevented on {share.prevented:.1f} % of the map”"
    shapes = ("one-sine", "one-cosine", "ricker-symmetric", "ricker-antisymmetric")
    for look, name in ((f"{PREVENTED} o", "prevented"), (f"{CAUSED} v", "caused")):
        for group, shape in enumerate(shapes):
            of = 100 * areas[areas["shape"] == shape][name]
            yield 2, look, group + 0.17 * (np.arange(len(of)) - (len(of) - 1) / 2), of
        mean = 100 * areas[name].mean()
        yield 2, f"{look[:7]} --", [0, 1], [mean] * 2
        yield 2, f"{look[:7]} “mean {mean:.1f}”", 3.48, mean + 1.8
    angles = ", ".join(f"{angle:.2g}" for angle in areas.slenderness_deg.unique())
    yield 2, f"#000000 “(c) Four pulses, each with α = {angles}°”"


FIGURES = (
    allen, allen_maps, break_even, cycles, engine, friction, motions, parameters,
    spectra, structures, trilith, uplift, vase, where,
)  # fmt: skip


def drawn(name, monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "figures")
    draw = runpy.run_path(str(ROOT / f"figures/{name}.py"))["draw"]
    wanted = signature(draw).parameters
    return draw(**{one: CONFIG if one == "config" else table(one) for one in wanted})


def table(name):
    return pd.read_csv(ROOT / f"tests/reference/{name}.csv")


def gathered(entries):
    """Return the points of each panel and look, each point once, in order."""
    series = defaultdict(list)
    for panel, look, points in entries:
        series[panel, look].append(np.asarray(points, dtype=float).reshape(-1, 2))
    return {
        key: np.unique(points[~np.isnan(points).any(axis=1)].round(7) + 0.0, axis=0)
        for key, parts in series.items()
        for points in [np.vstack(parts)]
    }


# Marks and areas without a series of their own, and words without a result.
DECORATION = re.compile(
    rf"{GREY} [-:]|Rectangle$|PathPatch$|area$|“(γ = [\d.]+”|(?!.*(\d\.\d|\d ?[%°])).*)$"
)


@pytest.mark.parametrize("published", FIGURES, ids=lambda one: one.__name__)
def test_figure_shows_the_published_tables(published, monkeypatch):
    figure = drawn(published.__name__, monkeypatch)
    ours = gathered(shown(figure))
    theirs, words = [], set()
    for panel, look, *points in published(*map(table, signature(published).parameters)):
        if not points:
            words.add((panel, look))
        x, y = np.broadcast_arrays(*points or (math.nan, math.nan))
        theirs.append((panel, look, np.column_stack([x.ravel(), y.ravel()])))
    theirs = gathered(theirs)
    more = {key for key in ours.keys() - theirs.keys() if not DECORATION.search(key[1])}
    more -= {(0, look) for _, look in more if published in (structures, vase) and "“" not in look}
    assert (more, theirs.keys() - ours.keys()) == (set(), set())
    for key, points in theirs.items():
        if key not in words:
            assert ours[key].shape == points.shape, key
            np.testing.assert_allclose(ours[key], points, 1e-5, 2e-7, err_msg=str(key))


def test_areas_of_the_map_are_the_intervals_that_overturn_frame_and_column(monkeypatch):
    axis = drawn("where", monkeypatch).axes[0]
    cells = table("spectra").query("slenderness_deg == 5 and shape == 'one-cosine'")
    paths = [(to_hex(p.get_facecolor()), p.get_path(), p.get_clip_path()) for p in axis.patches]
    assert [colour for colour, *_ in paths] == [CAUSED, PREVENTED, BOTH]  # from below
    clip = paths[2][2].get_fully_transformed_path()
    assert len(clip.vertices) == len(paths[0][1].vertices)  # both: the column's within the frame's
    for (_, path, _), ratio in zip(paths, (math.inf, 0.0, 0.0), strict=True):
        of = cells[(cells.mass_ratio == ratio) & (cells.lower < 16)]
        of = of.assign(upper=of.upper.fillna(16.0).clip(upper=16)).sort_values("lower")
        at, step = of.frequency_ratio.unique(), np.diff(np.sort(of.frequency_ratio.unique())).min()
        for frequency in at[(at > at.min()) & (at < at.max())]:
            rows = of[of.frequency_ratio == frequency]
            inside = [path.contains_point((frequency, y)) for y in (rows.lower + rows.upper) / 2]
            gaps = (rows.upper.to_numpy()[:-1] + rows.lower.to_numpy()[1:]) / 2
            assert all(inside)
            assert not any(path.contains_point((frequency, y)) for y in gaps)
            after = rows[rows["mode"] == "with impact"]
            narrow = after.drop((after.upper - after.lower).nlargest(1).index)
            for y in (narrow.lower + narrow.upper) / 2:
                for side in (-0.49, 0.49):
                    assert path.contains_point((frequency + side * step, y))


def test_free_body_is_in_equilibrium_and_moves_as_the_equations_say(monkeypatch):
    figure = drawn("free_body", monkeypatch)
    left, right = figure.axes
    shapes = [patch.get_xy()[:4] for patch in left.patches if hasattr(patch, "get_xy")]
    (cap, moved), columns = shapes[:2], shapes[2::2]
    width, height = np.ptp(columns[0], axis=0)
    diagonal, slenderness = math.hypot(width, height), math.atan(width / height)
    lean = slenderness - 0.6 * slenderness  # α + θ
    u = diagonal * (math.sin(lean) - math.sin(slenderness))  # Eq. (4), θ < 0
    v = diagonal * (math.cos(lean) - math.cos(slenderness))  # Eq. (7)
    np.testing.assert_allclose(moved - cap, np.tile([u, v], (4, 1)))
    arrows = [text for text in right.texts if text.arrow_patch]
    vectors = {}
    for arrow, label in zip(arrows, right.texts[1::2], strict=False):
        vectors[label.get_text()] = np.subtract(arrow.xy, arrow.xyann) / (5.0, 1.0)
    (x1, _), (x2, _), (_, z1), (_, z2), (inertia, _), (_, weight) = vectors.values()
    assert x1 + x2 == pytest.approx(-inertia)  # Eq. (13)
    assert z1 + z2 == pytest.approx(-weight)  # Eq. (16)
    assert x2 - x1 == pytest.approx((z2 - z1) * math.tan(lean))  # Eq. (12)
    seats = np.array([line.get_xydata()[0] for line in right.lines])
    arms = seats - moved.mean(axis=0)
    forces = np.array([[x1, z1], [x2, z2]])
    assert arms[:, 0] @ forces[:, 1] == pytest.approx(arms[:, 1] @ forces[:, 0])
