"""Animate a column and its frame under the same ground motion, to scale.

The cap beam has the density and the breadth of the columns, so that its depth shows its mass. The
animation runs in real time, within the hundredth of a second that a GIF can store.
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

from replication.drawing import ACCENT, GREY, INK, SKY, STONE
from replication.workbench import run
from steps.sketches import cap_outline
from topheavy import Column, Pulse, RockingFrame, simulate
from topheavy.kinematics import cap_displacement, column_outline
from topheavy.structures import STANDARD_GRAVITY

EARTH = "#d5d1c8"
BLENDS = 12  # of two colours
FLAT = math.pi / 2.0
SIZE, DPI = (6.4, 4.8), 100  # inches
HELD = (600, 1800)  # ms: duration of the first and the last picture
COLUMN_AT = 6.2  # m, right of the middle of the frame
VIEW = (-4.6, 13.6, -0.55, 10.9)  # m
CLOSENESS = 1e-9  # m: how well bodies must meet, and lie


def rotations(structure: Column | RockingFrame, pulse: Pulse, times: np.ndarray) -> np.ndarray:
    """Return θ; a structure that has overturned lies flat."""
    response = simulate(structure, pulse, samples=times)
    fell = np.isnan(response.rotation)
    if fell.any() != response.overturned:
        raise ArithmeticError(f"{structure}: {response.outcome}, but its history ends otherwise")
    last = response.rotation[~fell][-1]
    return np.where(fell, math.copysign(FLAT, last), response.rotation)


def ground_displacement(pulse: Pulse, times: np.ndarray) -> np.ndarray:
    """Return the displacement of the ground, m, by twice summing the acceleration finely."""
    fine = np.linspace(0.0, times[-1], 20_001)
    step = fine[1] - fine[0]
    acceleration = STANDARD_GRAVITY * pulse.excitation(fine)
    velocity = np.concatenate([[0.0], np.cumsum(acceleration[1:] + acceleration[:-1]) * step / 2])
    moved = np.concatenate([[0.0], np.cumsum(velocity[1:] + velocity[:-1]) * step / 2])
    return np.interp(times, fine, moved)


def bodies(frame: RockingFrame, alone: float, framed: float, case: dict) -> dict[str, np.ndarray]:
    """Return the outlines of all bodies, relative to the ground; check that they touch."""
    column, half = frame.column, case["span"] / 2.0
    moved = np.array(cap_displacement(column, framed))
    found = {
        "left column": column_outline(column, framed) + [-half, 0.0],
        "right column": column_outline(column, framed) + [half, 0.0],
        "cap": cap_outline(frame, case["span"], case["overhang"]) + moved,
        "column": column_outline(column, alone) + [COLUMN_AT, 0.0],
    }
    seat = found["left column"][:, 1].max()
    if abs(found["cap"][:, 1].min() - seat) > CLOSENESS:
        raise ArithmeticError(f"the cap does not rest on its columns at θ = {framed:.6g}")
    if min(outline[:, 1].min() for outline in found.values()) < -CLOSENESS:
        raise ArithmeticError("a body is in the ground")
    return found


def stage(pulse: Pulse, times: np.ndarray, case: dict):
    """Draw the fixed parts, and return the figure, its patches, the marker and the words."""
    figure, (scene, trace) = plt.subplots(
        nrows=2, figsize=SIZE, dpi=DPI, height_ratios=(4.7, 1), layout="constrained"
    )
    faces = {"left column": STONE, "right column": STONE, "cap": SKY, "column": STONE}
    patches = {
        name: scene.add_patch(Polygon(np.zeros((5, 2)), facecolor=face, edgecolor=INK, zorder=2))
        for name, face in faces.items()
    }
    patches["ground"] = scene.add_patch(
        Polygon(np.zeros((5, 2)), facecolor=EARTH, edgecolor=INK, zorder=1)
    )
    scene.set(xlim=VIEW[:2], ylim=VIEW[2:], aspect="equal")
    scene.axis("off")
    how = {"va": "top", "fontsize": 11, "color": INK}
    words = f"two columns under a cap, $\\gamma$ = {case['mass_ratio']:g}"
    scene.text(VIEW[0] + 0.6, VIEW[3], words, **how)
    scene.text(COLUMN_AT - 0.6, VIEW[3], "such a column alone", **how)
    acceleration = np.linspace(0.0, times[-1], 1400)
    trace.plot(acceleration, pulse.excitation(acceleration), color=GREY, linewidth=1.2)
    marker = trace.plot([], [], "o", color=ACCENT, markersize=6, clip_on=False)[0]
    trace.set(xlim=(0, times[-1]), ylim=(-0.45, 0.45), yticks=(-0.3, 0, 0.3))
    trace.set_xlabel("Time (s)", fontsize=9)
    trace.set_ylabel("Ground (g)", fontsize=9)
    return figure, patches, marker


def ground_outline(shift: float) -> np.ndarray:
    """Return the outline of the moving ground, shape (4, 2), m."""
    left, right = -4.0 + shift, 13.0 + shift
    return np.array([[left, -0.4], [right, -0.4], [right, 0.0], [left, 0.0]])


def main(case: dict) -> list[Image.Image]:
    frame = RockingFrame(Column(**case["column"]), case["mass_ratio"])
    given = case["pulse"]
    pulse = Pulse(given["shape"], given["amplitude"], 2.0 * math.pi / given["period"])
    times = np.arange(0.0, case["duration"], hundredths(case) / 100.0)
    alone, framed = (rotations(item, pulse, times) for item in (frame.column, frame))
    if abs(alone[-1]) < FLAT or np.abs(framed).max() > frame.slenderness:
        raise ArithmeticError("the column survives or the frame overturns; expected the reverse")
    shifts = ground_displacement(pulse, times)
    figure, patches, marker = stage(pulse, times, case)
    canvas, pictures = FigureCanvasAgg(figure), []
    for time, shift, left, right in zip(times, shifts, alone, framed, strict=True):
        for name, outline in bodies(frame, left, right, case).items():
            patches[name].set_xy(outline + [shift, 0.0])
        patches["ground"].set_xy(ground_outline(shift))
        marker.set_data([time], [pulse.excitation(time)])
        canvas.draw()
        pictures.append(Image.fromarray(np.asarray(canvas.buffer_rgba())).convert("RGB"))
    plt.close(figure)
    return [picture.quantize(palette=palette(), dither=Image.Dither.NONE) for picture in pictures]


def palette() -> Image.Image:
    """Return the colours of every picture: those drawn with, blended with ink and with white."""
    drawn = np.array([mpl.colors.to_rgb(c) for c in (STONE, SKY, EARTH, ACCENT, GREY, "white")])
    others = np.array([mpl.colors.to_rgb(c) for c in (INK, "white")])
    shares = np.linspace(0.0, 1.0, BLENDS)
    blends = (1.0 - shares)[:, None] * drawn[:, None, None] + shares[:, None] * others[:, None]
    found = Image.new("P", (1, 1))
    found.putpalette((255.0 * blends).round().astype(int).ravel().tolist())
    return found


def hundredths(case: dict) -> int:
    """Return the duration of a picture, in hundredths of a second."""
    return round(100 / case["frames_per_second"])


def save(path: str, pictures: list[Image.Image], case: dict) -> None:
    stands = [10 * hundredths(case)] * len(pictures)
    stands[0], stands[-1] = HELD
    first, *others = pictures
    first.save(path, save_all=True, append_images=others, duration=stands, loop=0, optimize=False)
    print(f"{len(pictures)} pictures, {Path(path).stat().st_size / 1e6:.2f} MB")


def work(job: Any) -> None:
    plt.style.use(job.input.style)
    pictures = main(job.params.case)
    for path in job.output:  # a GIF, and a PNG for the HTML report, which shows no GIF
        save(path, pictures, job.params.case)


if __name__ == "__main__":
    run(snakemake, work)
