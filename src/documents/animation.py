"""Animate a column, a column with a mass fixed to its top, and a frame that carries this mass.

All three are to scale and under the same ground motion, in real time, within the hundredth of a
second that a GIF can store. The first picture shows the outcome, for viewers that show one only.
It is played three times and then stands still.
"""

import io
import math
import runpy
from types import SimpleNamespace

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Polygon
from PIL import Image

from replication.drawing import GREY, INK, PAPER, settle
from replication.step import check, run
from steps.shared.poses import bodies, lying, structures
from topheavy import STANDARD_GRAVITY, Column, Pulse, RockingFrame, simulate
from topheavy.bodies.structures import Structure

P = SimpleNamespace(**runpy.run_path("figures/palette.py"))
BLENDS = 12  # of two colours
SIZE, DPI = (8.4, 4.2), 100  # inches
HELD = (1200, 1800)  # ms: how long the outcome is shown, at the beginning and at the end
PLAYS = 3
PLACES = {"column": 0.0, "fixed mass": 10.2, "frame": 22.6}  # m: the middle of each
NAMES = {
    "column": "Column",
    "fixed mass": "Fixed mass on top",
    "frame": "Frame: mass carried freely",
}
COLOURS = {"overturns": (P.OVERTURNED, P.OVERTURNS), "survives": (P.ROCKS, P.SURVIVES)}
"""Of a column, and of a mass and all edges."""
VIEW = (-4.5, 28.0, -1.6, 8.4)  # m
FALLING = 2.0  # of α: "overturns" is shown once the rotation stays above this
CALM = 0.5  # of α: "survives" is shown once the rotation stays below this


def rotations(structure: Structure, pulse: Pulse, times: np.ndarray, cap: dict) -> np.ndarray:
    """Return θ; a structure that has overturned lies on the ground with its column or its mass."""
    response = simulate(structure, pulse, samples=times)
    if not response.overturned:
        return response.rotation
    check(not isinstance(structure, RockingFrame), "the frame of the animation overturns")
    over = np.isnan(response.rotation)
    flat = math.copysign(lying(structure, cap), response.rotation[~over][-1])
    return np.clip(np.where(over, flat, response.rotation), -abs(flat), abs(flat))


def outcome_in_words(theta: np.ndarray, times: np.ndarray, alpha: float) -> tuple[str, float]:
    """Return the word for the outcome of a structure, and the time from which it is shown, s."""
    if abs(theta[-1]) > alpha:
        return "overturns", float(times[np.abs(theta) <= FALLING * alpha][-1])
    return "survives", float(times[np.abs(theta) > CALM * alpha][-1])


def ground_displacement(pulse: Pulse, times: np.ndarray) -> np.ndarray:
    """Return the displacement of the ground, m, by twice summing the acceleration finely."""
    fine = np.linspace(0.0, times[-1], 20_001)
    moved = STANDARD_GRAVITY * pulse.excitation(fine)
    for _ in range(2):
        moved = np.append(0.0, np.cumsum(moved[1:] + moved[:-1]) * (fine[1] - fine[0]) / 2)
    return np.interp(times, fine, moved)


def stage(pulse: Pulse, times: np.ndarray, settings: dict, column: dict):
    """Draw the fixed parts, and return the figure, the scene and the marker on the motion."""
    figure, (scene, trace) = plt.subplots(
        nrows=2, figsize=SIZE, dpi=DPI, height_ratios=(3.2, 1), layout="constrained"
    )
    scene.set(xlim=VIEW[:2], ylim=VIEW[2:], aspect="equal")
    scene.axis("off")
    for name, middle in PLACES.items():
        scene.text(middle, VIEW[3], NAMES[name], va="top", ha="center", fontsize=11, color=INK)
    fine = np.linspace(0.0, times[-1], 1400)
    trace.plot(fine, pulse.excitation(fine), color=GREY, linewidth=1.2)
    marker = trace.plot(times[-1:], [0.0], "o", color=INK, markersize=6, clip_on=False)[0]
    wave = settings["pulse"]
    words = f"one cosine, {wave['amplitude']:g} g, {wave['period']:g} s"
    words += f"; columns of {2 * column['half_height']:g} m × {2 * column['half_width']:g} m"
    words += f"; mass ratio γ = {settings['mass_ratio']:g}"
    trace.text(wave["period"] + 0.1, 0.25, words, fontsize=11, va="center", color=INK)
    trace.set(xlim=(0, times[-1]), ylim=(-0.45, 0.45), yticks=(-0.3, 0, 0.3))
    trace.set_xlabel("Time (s)", fontsize=9)
    trace.set_ylabel("Ground (g)", fontsize=9)
    return figure, scene, marker


def patch(scene, colour: str, zorder: int) -> Polygon:
    return scene.add_patch(
        Polygon(np.zeros((5, 2)), facecolor=colour, edgecolor=INK, zorder=zorder)
    )


def pictures(settings: dict, column: dict) -> list[Image.Image]:
    wave, cap = settings["pulse"], settings["cap"]
    shown = structures(Column(**column), settings["mass_ratio"], cap)
    alpha = shown["column"].slenderness
    pulse = Pulse(wave["shape"], wave["amplitude"], period=wave["period"])
    times = np.arange(0.0, settings["duration"], hundredths(settings) / 100.0)
    theta = {name: rotations(structure, pulse, times, cap) for name, structure in shown.items()}
    figure, scene, marker = stage(pulse, times, settings, column)
    patches = {
        (name, body): patch(scene, P.CAP if body == "cap" else P.STONE, 2)
        for name, structure in shown.items()
        for body in bodies(structure, 0.0, cap)
    }
    ground, words = patch(scene, P.EARTH, 1), {}
    for name, middle in PLACES.items():
        word, since = outcome_in_words(theta[name], times, alpha)
        how = {"ha": "center", "va": "bottom", "fontsize": 12, "color": COLOURS[word][1]}
        words[name] = scene.text(middle, VIEW[2], word, visible=False, **how), since
    canvas, drawings = FigureCanvasAgg(figure), []
    settle(figure)  # once, with its pixels: a layout in each picture takes half of the time
    for number, shift in enumerate(ground_displacement(pulse, times)):
        for name, structure in shown.items():
            for body, outline in bodies(structure, theta[name][number], cap).items():
                patches[name, body].set_xy(outline + [PLACES[name] + shift, 0.0])
        left, right = VIEW[0] + 0.7 + shift, VIEW[1] - 0.7 + shift
        ground.set_xy([[left, -0.4], [right, -0.4], [right, 0.0], [left, 0.0]])
        marker.set_data([times[number]], [pulse.excitation(times[number])])
        for (name, body), polygon in patches.items():
            word, since = words[name]
            if times[number] >= since:
                word.set_visible(True)
                pale, full = COLOURS[word.get_text()]
                polygon.set(facecolor=full if body == "cap" else pale, edgecolor=full)
        canvas.draw()
        drawings.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB"))
    plt.close(figure)
    return [*map(quantized, drawings)]


def quantized(picture: Image.Image) -> Image.Image:
    """Return a picture in the colours of the palette; Pillow would take a near white for white."""
    colours = palette()
    reduced = picture.quantize(palette=colours, dither=Image.Dither.NONE)
    white = colours.getpalette().index(255) // 3
    places = np.where((np.asarray(picture) == 255).all(axis=-1), white, np.asarray(reduced))
    exact = Image.fromarray(places.astype(np.uint8), "P")
    exact.putpalette(colours.getpalette())
    return exact


def palette() -> Image.Image:
    """Return the colours of every picture: those drawn with, blended with ink and with white."""
    colours = (P.STONE, P.CAP, P.EARTH, P.OVERTURNED, P.OVERTURNS, P.ROCKS, P.SURVIVES, GREY, PAPER)
    full, ends = (np.array([*map(mpl.colors.to_rgb, names)]) for names in (colours, (INK, PAPER)))
    shares = np.linspace(0.0, 1.0, BLENDS)
    blends = (1.0 - shares)[:, None] * full[:, None, None] + shares[:, None] * ends[:, None]
    image = Image.new("P", (1, 1))
    image.putpalette((255.0 * blends).round().astype(int).ravel().tolist())
    return image


def hundredths(settings: dict) -> int:
    """Return the duration of a picture, in hundredths of a second."""
    return round(100 / settings["frames_per_second"])


def compute(settings: dict, column: dict, style: str) -> dict[str, bytes]:
    """Return the animation as a GIF, which counts how often it is played again."""
    with mpl.rc_context(fname=style):
        others = pictures(settings, column)
    first = others[-1]
    durations = [HELD[0], *[10 * hundredths(settings)] * (len(others) - 1), HELD[1]]
    gif = io.BytesIO()
    first.save(
        gif,
        format="GIF",
        save_all=True,
        append_images=others,
        duration=durations,
        loop=PLAYS - 1,
        optimize=False,
    )
    return {"gif": gif.getvalue()}


if __name__ == "__main__":
    run(snakemake, compute)
