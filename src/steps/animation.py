"""Animate a column, a column with a mass fixed to its top, and a frame that carries this mass.

All three are to scale and under the same ground motion, in real time, within the hundredth of a
second that a GIF can store. It is played three times and then stands still.
"""

import math
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.patches import Polygon
from PIL import Image

from figures.palette import CAP, EARTH, OVERTURNED, OVERTURNS, ROCKS, STONE, SURVIVES
from figures.vase import NAMES
from replication.drawing import GREY, INK, PAPER
from replication.workbench import run
from steps.vase_poses import bodies, lying
from topheavy import Column, FixedMassColumn, Pulse, RockingFrame, simulate
from topheavy.bodies.structures import STANDARD_GRAVITY, Structure

BLENDS = 12  # of two colours
SIZE, DPI = (8.4, 4.2), 100  # inches
HELD = (600, 1800)  # ms: duration of the first and the last picture
PLAYS = 3
PLACES = {"column": 0.0, "vase": 10.2, "frame": 22.6}  # m: the middle of each
IN_FIGURE = {"column": "bare", "vase": "fixed", "frame": "free"}
COLOURS = {"overturns": (OVERTURNED, OVERTURNS), "survives": (ROCKS, SURVIVES)}
"""Of a column, and of a mass and all edges, as in the figure of the same three."""
VIEW = (-4.5, 28.0, -1.6, 8.4)  # m
FALLING = 2.0  # of α: "overturns" is shown once the rotation stays above this
CALM = 0.5  # of α: "survives" is shown once the rotation stays below this
CLOSENESS = 1e-9  # m: how far a body may be in the ground


def structures(settings: dict) -> dict[str, Structure]:
    """Return bare column, column with the fixed mass, and frame."""
    column, gamma, cap = Column(**settings["column"]), settings["mass_ratio"], settings["cap"]
    return {
        "column": column,
        "vase": FixedMassColumn(column, gamma, cap["width"], cap["depth"]),
        "frame": RockingFrame(column, gamma),
    }


def rotations(structure: Structure, pulse: Pulse, times: np.ndarray, settings: dict) -> np.ndarray:
    """Return θ; what has overturned lies on the ground with its column or its mass."""
    response = simulate(structure, pulse, samples=times)
    fell = np.isnan(response.rotation)
    if fell.any() != response.overturned:
        raise ArithmeticError(f"{structure}: {response.outcome}, but its history ends otherwise")
    if not response.overturned:
        return response.rotation
    column = structure if isinstance(structure, Column) else structure.column
    corners = np.concatenate(list(bodies(structure, 0.0, settings).values()))
    flat = math.copysign(lying(column, corners), response.rotation[~fell][-1])
    turned = np.where(fell, flat, response.rotation)
    return np.clip(turned, -abs(flat), abs(flat))


def outcome_in_words(theta: np.ndarray, times: np.ndarray, alpha: float) -> tuple[str, float]:
    """Return the word for what happens to a structure, and the time from which it is shown, s."""
    if abs(theta[-1]) > alpha:
        within = np.flatnonzero(np.abs(theta) <= FALLING * alpha)
        return "overturns", float(times[within[-1]])
    moves = np.flatnonzero(np.abs(theta) > CALM * alpha)
    return "survives", float(times[moves[-1]])


def ground_displacement(pulse: Pulse, times: np.ndarray) -> np.ndarray:
    """Return the displacement of the ground, m, by twice summing the acceleration finely."""
    fine = np.linspace(0.0, times[-1], 20_001)
    step = fine[1] - fine[0]
    acceleration = STANDARD_GRAVITY * pulse.excitation(fine)
    velocity = np.concatenate([[0.0], np.cumsum(acceleration[1:] + acceleration[:-1]) * step / 2])
    moved = np.concatenate([[0.0], np.cumsum(velocity[1:] + velocity[:-1]) * step / 2])
    return np.interp(times, fine, moved)


def stage(pulse: Pulse, times: np.ndarray, settings: dict):
    """Draw the fixed parts, and return the figure, the scene, its patches and the marker."""
    figure, (scene, trace) = plt.subplots(
        nrows=2, figsize=SIZE, dpi=DPI, height_ratios=(3.2, 1), layout="constrained"
    )
    patches = {
        (name, body): scene.add_patch(
            Polygon(
                np.zeros((5, 2)), facecolor=CAP if body == "cap" else STONE, edgecolor=INK, zorder=2
            )
        )
        for name, structure in structures(settings).items()
        for body in bodies(structure, 0.0, settings)
    }
    patches["ground"] = scene.add_patch(
        Polygon(np.zeros((5, 2)), facecolor=EARTH, edgecolor=INK, zorder=1)
    )
    scene.set(xlim=VIEW[:2], ylim=VIEW[2:], aspect="equal")
    scene.axis("off")
    for name, middle in PLACES.items():
        how = {"va": "top", "ha": "center", "fontsize": 11, "color": INK}
        scene.text(middle, VIEW[3], NAMES[IN_FIGURE[name]].replace("\n", " "), **how)
    fine = np.linspace(0.0, times[-1], 1400)
    trace.plot(fine, pulse.excitation(fine), color=GREY, linewidth=1.2)
    marker = trace.plot([], [], "o", color=INK, markersize=6, clip_on=False)[0]
    given, size = settings["pulse"], settings["column"]
    words = f"one cosine, {given['amplitude']:g} g, {given['period']:g} s"
    words += f"; columns of {2 * size['half_height']:g} m × {2 * size['half_width']:g} m"
    words += f"; mass ratio γ = {settings['mass_ratio']:g}"
    trace.text(given["period"] + 0.1, 0.25, words, fontsize=11, va="center", color=INK)
    trace.set(xlim=(0, times[-1]), ylim=(-0.45, 0.45), yticks=(-0.3, 0, 0.3))
    trace.set_xlabel("Time (s)", fontsize=9)
    trace.set_ylabel("Ground (g)", fontsize=9)
    return figure, scene, patches, marker


def outcomes(scene, theta: dict[str, np.ndarray], times: np.ndarray, alpha: float) -> list:
    """Write what happens to each under it, hidden; return names, words, and from when they show."""
    found = []
    for name, middle in PLACES.items():
        word, since = outcome_in_words(theta[name], times, alpha)
        how = {"ha": "center", "va": "bottom", "fontsize": 12, "color": COLOURS[word][1]}
        found.append((name, scene.text(middle, VIEW[2], word, visible=False, **how), since))
    return found


def ground_outline(shift: float) -> np.ndarray:
    """Return the outline of the moving ground, shape (4, 2), m."""
    left, right = VIEW[0] + 0.7 + shift, VIEW[1] - 0.7 + shift
    return np.array([[left, -0.4], [right, -0.4], [right, 0.0], [left, 0.0]])


def main(settings: dict) -> list[Image.Image]:
    given, shown = settings["pulse"], structures(settings)
    alpha = shown["column"].slenderness
    pulse = Pulse(given["shape"], given["amplitude"], 2.0 * math.pi / given["period"])
    times = np.arange(0.0, settings["duration"], hundredths(settings) / 100.0)
    theta = {name: rotations(one, pulse, times, settings) for name, one in shown.items()}
    if np.abs(theta["frame"]).max() > alpha:
        raise ArithmeticError("the frame overturns; expected a pulse that it survives")
    shifts = ground_displacement(pulse, times)
    figure, scene, patches, marker = stage(pulse, times, settings)
    words = outcomes(scene, theta, times, alpha)
    canvas, pictures = FigureCanvasAgg(figure), []
    for number, (time, shift) in enumerate(zip(times, shifts, strict=True)):
        for name, structure in shown.items():
            for body, outline in bodies(structure, theta[name][number], settings).items():
                if outline[:, 1].min() < -CLOSENESS:
                    raise ArithmeticError(f"{name}: the {body} is in the ground at {time:.3g} s")
                patches[name, body].set_xy(outline + [PLACES[name] + shift, 0.0])
        patches["ground"].set_xy(ground_outline(shift))
        marker.set_data([time], [pulse.excitation(time)])
        for name, word, since in words:
            if time >= since and not word.get_visible():
                word.set_visible(True)
                for body in bodies(shown[name], 0.0, settings):
                    pale, full = COLOURS[word.get_text()]
                    patches[name, body].set(
                        facecolor=full if body == "cap" else pale, edgecolor=full
                    )
        canvas.draw()
        pictures.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB"))
    plt.close(figure)
    return [picture.quantize(palette=palette(), dither=Image.Dither.NONE) for picture in pictures]


def palette() -> Image.Image:
    """Return the colours of every picture: those drawn with, blended with ink and with white."""
    drawn = np.array(
        [
            mpl.colors.to_rgb(c)
            for c in (STONE, CAP, EARTH, OVERTURNED, OVERTURNS, ROCKS, SURVIVES, GREY, PAPER)
        ]
    )
    others = np.array([mpl.colors.to_rgb(c) for c in (INK, PAPER)])
    shares = np.linspace(0.0, 1.0, BLENDS)
    blends = (1.0 - shares)[:, None] * drawn[:, None, None] + shares[:, None] * others[:, None]
    found = Image.new("P", (1, 1))
    found.putpalette((255.0 * blends).round().astype(int).ravel().tolist())
    return found


def hundredths(settings: dict) -> int:
    """Return the duration of a picture, in hundredths of a second."""
    return round(100 / settings["frames_per_second"])


def save(path: str, pictures: list[Image.Image], settings: dict) -> None:
    stands = [10 * hundredths(settings)] * len(pictures)
    stands[0], stands[-1] = HELD
    first, *others = pictures
    # A GIF counts how often it is played again, a PNG how often it is played.
    loop = PLAYS - 1 if path.endswith(".gif") else PLAYS
    how = {"save_all": True, "append_images": others, "duration": stands, "optimize": False}
    first.save(path, loop=loop, **how)
    print(f"{len(pictures)} pictures, {Path(path).stat().st_size / 1e6:.2f} MB")


def work(job: Any) -> None:
    plt.style.use(job.input.style)
    pictures = main(job.params.settings)
    for path in job.output:  # a GIF, and a PNG for the HTML report, which shows no GIF
        save(path, pictures, job.params.settings)


if __name__ == "__main__":
    run(snakemake, work)
