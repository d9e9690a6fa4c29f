#!/usr/bin/env bash
# One expects that two columns and a loose cap beam, posed so that their corners just touch and then released, rock in
# pymunk 7.3.1 with the p and the √r of theory (Makris and Vassiliou 2014), as they do in a pose that overlaps by 1e-6 m. From
# an exact pose at 0.5 α, where a gap is a rounding, the frame keeps 0.968, 0.983 and 0.969 of its velocity in three impacts,
# more than the largest value of Eq. (25), 0.949, and is 1.2 % late. More iterations change nothing, and 0.45 α is right. One
# wrong history thus hides among right ones, and bodies should overlap. Source: our own runs, not reported upstream.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"${PYTHON:-python3}" -m venv "$folder"
"$folder/bin/pip" install --quiet --disable-pip-version-check --only-binary :all: numpy==2.3.5 pymunk==7.3.1
"$folder/bin/python" - << 'PYTHON'
import math

import numpy as np
import pymunk

G, B, H, SPAN, CAP, DT = 9.81, 0.5, 3.0, 5.0, 2.0, 2e-4  # m/s2, m, m, m, m, s
ALPHA, RATIO = math.atan2(B, H), 1.0  # γ: the cap is as heavy as both columns
EQ_25 = (1 - 1.5 * math.sin(ALPHA) ** 2 + 3 * RATIO * math.cos(2 * ALPHA)) / (1 + 3 * RATIO)


def restitutions(release, overlap, iterations):
    """Return √r of three impacts after a release (over α), and when the first comes, s."""
    angle, space = release * ALPHA, pymunk.Space()
    space.iterations, space.gravity = iterations, (0.0, -G)
    shift = H * math.sin(angle) + B * (1 - math.cos(angle))
    height = H * math.cos(angle) + B * math.sin(angle) - overlap
    boxes = [((2 * B, 2 * H), 1.0, (x + shift, height), -angle) for x in (-SPAN / 2, SPAN / 2)]
    boxes.append(((SPAN + 2 * B, CAP), 2 * RATIO, (2 * shift, 2 * height + CAP / 2), 0.0))
    bodies, shapes = [], [pymunk.Segment(space.static_body, (-100, 0), (100, 0), 0)]
    for size, mass, place, turn in boxes:
        body = pymunk.Body(mass, pymunk.moment_for_box(mass, size))
        body.position, body.angle = place, turn
        bodies.append(body)
        shapes.append(pymunk.Poly.create_box(body, size))
    for shape in shapes:
        shape.friction = 5.0
    space.add(*bodies, *shapes)
    rotation = []
    for _ in range(round(6.0 / DT)):
        rotation.append(-bodies[0].angle)
        space.step(DT)
    rotation = np.array(rotation)
    turns = np.flatnonzero(rotation[1:] * rotation[:-1] < 0) + 1
    peaks = np.array([np.abs(flight).max() for flight in np.split(rotation, turns)])
    rise = np.cos(ALPHA - peaks[peaks > 0.02 * ALPHA]) - math.cos(ALPHA)
    return np.sqrt(rise[1:] / rise[:-1])[:3], turns[0] * DT


print(f"pymunk {pymunk.version}; Eq. (25): {EQ_25:.4f}")
seen = {}
for case in ((0.5, 0.0, 50), (0.5, 0.0, 100), (0.5, 1e-6, 50), (0.45, 0.0, 50)):
    seen[case], first = restitutions(*case)
    print("release {} α, overlap {} m, {} iterations:".format(*case), seen[case].round(4), f"first impact {first:.4f} s")
right = [np.abs(seen[case] - EQ_25).max() < 2e-3 for case in seen]
assert right == [False, False, True, True], "exact contact is now as right as an overlap"
assert min(seen[0.5, 0.0, 50]) > EQ_25 + 0.01, "the exact pose no longer exceeds Eq. (25)"
print("seen: from one of two exact poses the frame loses less than Eq. (25) allows")
PYTHON
