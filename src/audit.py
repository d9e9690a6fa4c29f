"""An audit in one file: the numbers of README and the abstract, computed again from equations.

    python src/audit.py [folder of the repository [names of parts]]

It needs NumPy and SciPy, and imports nothing of this project. It prints what the paper prints, what
is published, what it computes, and the difference, and ends with 1 if a number departs.

Time is p t. One call follows many lanes: a lane is a body, an amplitude and, under a pulse, a
frequency. With s = sgn θ, φ = |θ|, a = ü_g/g, and w = 1 + v̈_g/g under a vertical motion (else 1),

    φ'' = −w sin(α − φ) − s a cos(α − φ)      or, linearised,      φ'' = −w (α − φ) − s a.

At an impact, φ = 0, the body passes to its other side with √r of its speed. It leaves rest when
|a| > w tan α, or w α linearised.
"""

import csv
import math
import re
import sys
from collections.abc import Callable
from itertools import pairwise, product
from pathlib import Path
from typing import NamedTuple

import numpy as np
import scipy  # loads its parts where they are used

G, INF, PI = 9.81, math.inf, math.pi
LONGEST_STEP, SHORT_STEP = 0.3, 0.05  # steps of p t
SHORTEST_CUT = 1e-5  # shortest step of p t that is searched for two turns
FINEST = PI / 16  # longest step of the phase ωt under a pulse
REST = 1e-8  # height over α of a bounce that counts as rest, if nothing lifts the body at once
COUNTED = 1e-6  # rotation over α below which the impact that ends it is not counted

# Bodies ------------------------------------------------------------------------------------------


class Body(NamedTuple):
    """Frequency parameter p (rad/s), slenderness α (rad) and coefficient of restitution √r."""

    p: float
    alpha: float
    root: float


def column(b, h):
    """Return a column of half-width b and half-height h, m, with Housner's √r."""
    alpha = math.atan(b / h)
    return Body(math.sqrt(3 * G / (4 * math.hypot(b, h))), alpha, 1 - 1.5 * math.sin(alpha) ** 2)


def frame(b, h, gamma):
    """Return two columns under a loose beam, of γ times their mass; γ = ∞: they have no mass."""
    p, alpha, root = column(b, h)
    if gamma == INF:
        return Body(p * math.sqrt(2 / 3), alpha, math.cos(2 * alpha))
    root = (root + 3 * gamma * math.cos(2 * alpha)) / (1 + 3 * gamma)  # Eq. (25)
    return Body(p * math.sqrt((1 + 2 * gamma) / (1 + 3 * gamma)), alpha, root)  # Eq. (23)


def fixed(b, h, gamma):
    """Return a column with γ times its mass fixed to the middle of its top.

    From the mass, the height of its centre and its moment of inertia about a corner.
    """
    base, added = (0.0, 1.0) if gamma == INF else (1.0, gamma)
    height = (base * h + added * 2 * h) / (base + added)
    inertia = base * 4 / 3 * (b**2 + h**2) + added * (b**2 + (2 * h) ** 2)
    p = math.sqrt((base + added) * G * math.hypot(b, height) / inertia)
    return Body(p, math.atan(b / height), 1 - 2 * (base + added) * b**2 / inertia)


# Ground motions ----------------------------------------------------------------------------------


class Ground(NamedTuple):
    """An acceleration over x, which is the phase ωt of a pulse and the time of a record.

    `at` is the horizontal one, of amplitude 1 or in g. It is smooth and monotone between corners.
    """

    at: Callable
    corners: np.ndarray
    finest: float = INF  # longest step of x that resolves its curve
    weight: Callable = lambda x: 1.0  # w
    straight: bool = False  # between corners


def ricker_symmetric(x):
    z = (x - 4.5 * PI) ** 2 / 4
    return (1 - 2 * z) * np.exp(-z)


def ricker_antisymmetric(x):
    z = (x - 4.5 * PI) / math.sqrt(3)
    return (z**3 - 3 * z) * np.exp(-(z**2) / 2) / 1.3801


LOBES = 4.5 * PI + np.outer([-1, 1], np.sqrt(3 * (3 + math.sqrt(6) * np.array([-1, 1])))).ravel()
WAVES = {  # the wave, its length over π, its turning points
    "one-sine": (np.sin, 2, None),
    "one-cosine": (np.cos, 2, None),
    "half-sine": (np.sin, 1, None),
    "constant": (lambda x: 1.0 + 0.0 * x, 1, None),
    "ricker-symmetric": (ricker_symmetric, 9, 4.5 * PI + math.sqrt(6) * np.array([-1, 0, 1])),
    "ricker-antisymmetric": (ricker_antisymmetric, 9, LOBES),
}


def pulse(shape, cycles=1.0):
    """Return a pulse over its phase; sine and cosine may have several cycles."""
    wave, length, turns = WAVES[shape]
    end = length * PI * cycles
    turns = np.arange(PI / 2, end - 1e-9, PI / 2) if turns is None else np.sort(turns)
    return Ground(wave, np.array([0.0, *turns, end]), FINEST)


def record(samples, dt):
    """Return samples (g) in equal steps (s), joined by straight lines."""
    times = dt * np.arange(len(samples))
    return Ground(lambda x: np.interp(x, times, samples), times, straight=True)


def read_at2(path):
    """Return the samples (g) and the step (s) of a file, which the fourth line has."""
    *_, size, samples = path.read_text(encoding="utf-8").split("\n", 4)
    return np.array(samples.split(), float), float(re.search(r"DT= *([\d.]+)", size)[1])


def line(ground, begin, end):
    """Return the ground between two corners as straight lines."""

    def through(curve):
        first, slope = curve(begin), (curve(end) - curve(begin)) / (end - begin)
        return lambda x: first + slope * (x - begin)

    return ground._replace(at=through(ground.at), weight=through(ground.weight))


# The motion --------------------------------------------------------------------------------------

# Rows of the lanes. The side 0 is rest; RATE is φ', PACE is p dt/dx, LEVEL the uplift acceleration
# over w, HEIGHT the largest φ since the last impact, TURNED whether φ has turned back or rests. A
# jump of the ground velocity adds KICK to φ' after each impact.
SIDE, PHI, RATE, X, ALPHA, ROOT, AMP, PACE, LEVEL, PEAK, HEIGHT, HITS = range(12)
TURNED, LANE, KICK = range(12, 15)
QUIET = Ground(lambda x: 0.0 * x, np.zeros(1))


class Drive(NamedTuple):
    """What moves all lanes: a ground motion, one of both equations, the integration of a step."""

    ground: Ground
    linear: bool
    leap: Callable
    impacts: list  # x of the impacts of each lane so far


class Motion(NamedTuple):
    """How motions end, and their courses: a row for each lane, a column for each sample."""

    overturned: np.ndarray
    peak: np.ndarray  # the largest |θ|, rad; 0 without uplift, NaN where it overturns
    hits: np.ndarray  # impacts until the ground motion ends or the body has overturned
    rotation: np.ndarray  # θ, rad; NaN once the body has overturned
    velocity: np.ndarray  # dθ/d(p t)
    impacts: list  # x of the impacts of each lane


def follow(
    bodies, amplitudes, ground, omega=1.0, linear=False, start=(0, 0), samples=(), leap=0, kick=0
):
    """Carry bodies through a ground motion until each overturns or is safe, and on to the samples.

    Bodies, amplitudes and ω broadcast. `start` is θ and dθ/d(p t); the samples are x in order.
    `leap` replaces `leapfrog`, the integration of a step; for `kick` see the rows of the lanes.

    A body has overturned when it lies flat, φ = π/2; linearised, when no ground motion of this
    amplitude brings it back. It is safe when it turns back in free motion: impacts only take
    energy, so that it never comes as far again.
    """
    p, alpha, root = (np.array([getattr(body, name) for body in bodies]) for name in Body._fields)
    p, alpha, root, amp, omega = np.broadcast_arrays(p, alpha, root, amplitudes, omega)
    lanes, count = np.zeros((15, p.size)), p.size
    lanes[[ALPHA, ROOT, AMP, PACE, LANE]] = alpha, root, amp, p / omega, np.arange(count)
    lanes[LEVEL] = alpha if linear else np.tan(alpha)
    lanes[[PHI, HEIGHT, PEAK]] = abs(start[0])
    lanes[SIDE] = np.sign(start[0] or start[1])
    # Released from rest, it has a rate inward: else a dip within its first step would not be seen.
    lanes[RATE] = lanes[SIDE] * np.where(start[1], start[1], -1e-300 * np.sign(start[0]))
    lanes[KICK] = kick
    strongest, samples = np.abs(ground.at(ground.corners)).max(), np.asarray(samples, float)
    flat = np.maximum(PI / 2, alpha + linear * np.abs(amp) * strongest)
    ends = np.zeros(count, bool), np.full(count, math.nan), np.zeros(count, int)
    motion = Motion(*ends, *np.full((2, count, samples.size), math.nan), [[] for _ in alpha])
    undecided, last = np.ones(count, bool), samples.max(initial=-1)
    for begin, end, forcing in spans(ground, samples, lanes[PACE]):
        lane, place = lanes[LANE].astype(int), np.searchsorted(samples, begin)
        if place < samples.size and samples[place] == begin:
            motion.rotation[lane, place] = lanes[SIDE] * lanes[PHI]
            motion.velocity[lane, place] = lanes[SIDE] * lanes[RATE]
        lanes[TURNED] = lanes[SIDE] == 0
        advance(lanes, begin, end, Drive(forcing, linear, leap or leapfrog, motion.impacts))
        new, is_free = undecided[lane], forcing is QUIET
        down = (lanes[PHI] >= flat[lane]) & (lanes[RATE] >= 0)
        safe = (lanes[TURNED] > 0) & ~down & new & is_free
        motion.overturned[lane[down & new]] = True
        motion.peak[lane[safe]] = lanes[PEAK, safe]
        counts = down & new if is_free else new
        motion.hits[lane[counts]] = lanes[HITS, counts]
        undecided[lane[down | safe]] = False
        if end > max(last, ground.corners[-1]) + 200 / lanes[PACE].min():
            raise ArithmeticError(f"undecided, at the edge of overturning: {bodies[0]} and others")
        lanes = lanes[:, ~down & (undecided[lane] | (end <= last))]
        if not lanes.size:
            break
    return motion


def spans(ground, samples, pace):
    """Yield the steps: their begin and end, and the ground motion, which is quiet in the end."""
    longest, over = LONGEST_STEP / pace.max(), ground.corners[-1]
    finest = min(longest, ground.finest)
    corners = np.union1d(ground.corners, samples[(samples > 0) & (samples < over)])
    for begin, end in pairwise(corners):
        count = math.ceil((end - begin) / finest * (1 - 1e-9))
        piece = line(ground, begin, end) if ground.straight else ground
        for pair in pairwise(np.linspace(begin, end, count + 1)):
            yield *pair, piece
    begin = over
    for mark in (*samples[samples > over], INF):
        while begin < mark:
            end = min(begin + longest, mark)
            yield begin, end, QUIET
            begin = end


def advance(lanes, begin, end, drive):
    """Carry all lanes from x = begin to the end, through uplifts, impacts and rest, in place."""
    lanes[X], todo, x = begin, np.arange(lanes.shape[1]), begin
    for _ in range(10_000):
        part = lanes[:, todo]
        resting = part[SIDE] == 0
        if resting.any():
            uplift(part, resting, end, drive.ground)
            if not part[SIDE].any():  # all rest until the end
                return
            x = part[X]
        phi, rate = drive.leap(part, x, end - x, drive)
        moving, limit = part[SIDE] != 0, np.full(todo.size, end) - x
        cut, before = turns_twice(part, phi, rate, limit)
        if cut.any():
            limit[cut] = before
            phi[cut], rate[cut] = drive.leap(part[:, cut], part[X, cut], before, drive)
        lands = moving & (phi < 0) & (rate < 0)
        turns = moving & ((part[RATE] < 0) & (rate > 0) | (part[RATE] >= 0) & (rate < 0))
        low = np.zeros(todo.size)
        if turns.any():
            low[turns] = root_of(RATE, part[:, turns], low[turns], limit[turns], drive)
            top = drive.leap(part[:, turns], part[X, turns], low[turns], drive)[0]
            part[HEIGHT, turns] = np.maximum(part[HEIGHT, turns], top)
            part[TURNED, turns] = np.maximum(part[TURNED, turns], rate[turns] < 0)
            dips = turns.copy()  # through zero and back within the step
            dips[turns] = (top < 0) & (rate[turns] > 0)
            limit[dips], low[dips], lands = low[dips], 0, lands | dips
        free = moving & ~lands
        part[PHI, free], part[RATE, free] = np.maximum(phi[free], 0), rate[free]
        part[HEIGHT, free] = np.maximum(part[HEIGHT, free], phi[free])
        part[PEAK] = np.maximum(part[PEAK], part[HEIGHT])
        part[X, ~lands] = np.where(cut, part[X] + limit, end)[~lands]
        if lands.any():
            land = part[:, lands]
            impact(land, root_of(PHI, land, low[lands], limit[lands], drive), drive)
            part[:, lands] = land
        lanes[:, todo] = part
        todo = todo[part[X] < end]
        if not todo.size:
            return
        x = lanes[X, todo]
    raise ArithmeticError("a body bounces without end")


def turns_twice(lanes, phi, rate, dx):
    """Return which lanes turn twice within a step, and the part of dx that ends between both turns.

    With φ as a cubic of time, dt φ' = mid + half u + bow u² for −1 < u < 1. There is no third turn,
    since the forcing is monotone between corners.
    """
    dt = dx * lanes[PACE]
    half, mean = dt * (rate - lanes[RATE]) / 2, dt * (rate + lanes[RATE]) / 2
    bow = 3 * (mean - phi + lanes[PHI]) / 2
    mid = mean - bow
    within = (rate * lanes[RATE] > 0) & (bow * rate > 0) & (np.abs(half) < 2 * np.abs(bow))
    twice = within & (half**2 > 4 * bow * mid) & (dt > SHORTEST_CUT)
    return twice, dx[twice] / 2 * (1 - half[twice] / (2 * bow[twice]))


def push(lanes, phi, x, drive):
    """Return φ'' at an angle and an x, on the side of each lane."""
    lean, a = lanes[ALPHA] - phi, lanes[SIDE] * lanes[AMP] * drive.ground.at(x)
    if drive.linear:
        return -drive.ground.weight(x) * lean - a
    return -drive.ground.weight(x) * np.sin(lean) - a * np.cos(lean)


def leapfrog(lanes, x, dx, drive):
    """Return φ and φ' after a step of dx on one side.

    By the leapfrog rule in 1, 2, 3 and 4 parts, extrapolated to infinitely many: its error is a
    series in even powers of a part, so that the result is of the eighth order. For short steps on
    straight lines 1, 2 and 3 parts do.
    """
    is_short = drive.ground.straight and (dx * lanes[PACE] < SHORT_STEP).all()
    first, ends, counts = push(lanes, lanes[PHI], x, drive), 0, range(1, 4 if is_short else 5)
    for parts in counts:
        h = dx * lanes[PACE] / parts
        phi, rate = lanes[PHI], lanes[RATE] + h / 2 * first
        for part in range(1, parts + 1):
            phi = phi + h * rate
            kick = push(lanes, phi, x + dx * part / parts, drive)
            rate = rate + (h if part < parts else h / 2) * kick
        share = math.prod(parts**2 / (parts**2 - other**2) for other in counts if other != parts)
        ends = ends + share * np.array([phi, rate])
    return ends


def uplift(lanes, resting, end, ground):
    """Let those begin to rock that the ground lifts before the end; the others rest until then.

    A positive acceleration rocks them to θ < 0. Between corners |a|/w crosses a level upward once.
    """
    part = lanes[:, resting]

    def above(x):
        return np.abs(part[AMP] * ground.at(x)) > part[LEVEL] * ground.weight(x)

    low, high = part[X].copy(), np.full(part.shape[1], end)
    now, lifted = above(low), above(high)
    for _ in range(60 if (lifted & ~now).any() else 0):
        middle = (low + high) / 2
        beyond = above(middle)
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    part[X] = np.where(now, part[X], high)
    part[SIDE] = np.where(now | lifted, -np.sign(part[AMP] * ground.at(part[X])), 0)
    lanes[:, resting] = part


def root_of(row, lanes, low, high, drive):
    """Return the step from X at which φ or φ' is zero: it has changed its sign at `high`.

    By Newton's method; where that leaves the bracket, which shrinks, by halving it.
    """
    low, high, left = low.copy(), high.copy(), np.arange(high.size)
    phi, rate, bend = lanes[PHI], lanes[RATE], push(lanes, lanes[PHI], lanes[X], drive)
    sign = np.where((row == RATE) & (rate < 0), 1, -1)
    with np.errstate(divide="ignore", invalid="ignore"):
        # The first guess takes φ'' as constant.
        far = rate if row == RATE else rate + np.sqrt(np.maximum(rate**2 - 2 * bend * phi, 0))
        dx = -far / bend / lanes[PACE]
        dx = np.where((dx > low) & (dx < high), dx, high)
        for _ in range(100):
            part, step = lanes[:, left], dx[left]
            value, slope = drive.leap(part, part[X], step, drive)
            if row == RATE:
                value, slope = slope, push(part, value, part[X] + step, drive)
            beyond = value * sign[left] > 0
            high[left[beyond]], low[left[~beyond]] = step[beyond], step[~beyond]
            new = step - value / slope / part[PACE]
            inside = (new >= low[left]) & (new <= high[left])
            dx[left] = np.where(inside, new, (low[left] + high[left]) / 2)
            left = left[np.abs(dx[left] - step) > 1e-7 * step]  # the next change is its square
            if not left.size:
                break
    return dx


def impact(lanes, dx, drive):
    """Carry lanes to φ = 0 and to their other side; what would bounce too low comes to rest."""
    rate = drive.leap(lanes, lanes[X], dx, drive)[1]
    lanes[X] += dx
    counted = lanes[HEIGHT] > COUNTED * lanes[ALPHA]
    lanes[HITS] += counted
    for lane, x in lanes[[LANE, X]][:, counted].T:
        drive.impacts[int(lane)].append(x)
    lanes[SIDE] *= -1
    lanes[[PHI, HEIGHT]], lanes[RATE] = 0, lanes[ROOT] * np.maximum(-rate, 0) + lanes[KICK]
    rests = lanes[RATE] ** 2 <= -2 * push(lanes, 0.0, lanes[X], drive) * REST * lanes[ALPHA]
    lanes[SIDE, rests] = lanes[RATE, rests] = 0
    lanes[TURNED, rests] = 1


def minima(bodies, ground, omega, highest=20.0, step=0.002):
    """Return the lowest amplitude (g) that overturns each body, ∞ beyond a multiple of tan α.

    64 steps over tan α at once, from uplift on; the first that overturns is cut by 64, four times.
    """
    count, level = len(bodies), np.tan([body.alpha for body in bodies])
    omega, left = np.broadcast_to(omega, count), np.arange(count)
    low, width = np.ones(count), np.full(count, step)
    while left.size:
        tried = low[left, None] + width[left, None] * np.arange(1, 65)
        amplitudes = level[left, None] * tried
        repeated = [bodies[place] for place in left for _ in range(64)]
        fell = follow(repeated, amplitudes.ravel(), ground, np.repeat(omega[left], 64)).overturned
        fell = fell.reshape(tried.shape)
        falls, first = fell.any(axis=1), np.argmax(fell, axis=1)
        low[left] = np.where(falls, low[left] + width[left] * first, tried[:, -1])
        width[left[falls]] /= 64
        left = left[(low[left] < highest) & (width[left] > step / 64**4.5)]
    return np.where(width < step, level * (low + 64 * width), INF)


# What is published, and the comparison -----------------------------------------------------------

FOLDER = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
TEMPLE, TRILITH, PERIOD = (0.5, 3.0), (0.11, 0.40), 1.5  # half-width and half-height, m; s
MAKE = {"column": lambda b, h, gamma: column(b, h), "fixed mass": fixed, "frame": frame}
SENTENCES = {  # README has each if this file computes that it is true; # is a number
    "size": "R̂ is at most # times R",
    "trilith": "p̂ = # rad/s, as printed",
    "allen": r"wrong, mostly too small, by # % for γ = 0.5 \(median, one-sine pulses, ω = 5 p\)",
    "minima": "one-cosine pulse of 1.5 s overturn from # g alone, from # g under a very heavy beam",
    "gain": r"by # to # % \(columns of 6 m\)",
    "velocity": r"every range of ±# cm/s \(column\) or ±# cm/s \(very heavy beam\)",
    "inertia": r"multiplies the inertia by 1 \+ 3γ and the restoring moment only by 1 \+ 2γ",
    "slower": "so that the frame is slower",
    "four": "Each of four structures is more stable than the last",
    "uplift": "was shaken below uplift",
    "small": "peak rotation wrong, mostly too small",
    "raises": "raises the peak ground velocity at which half of the motions overturn",
    "models": "over ten models",
    "never": "minimum overturning acceleration never fell under single pulses of four shapes",
}
ABSTRACT = {  # sentences that `make check` looks for; this file computes that each is true
    "size": "slenderness α and up to # times the size, with a lower coefficient of restitution",
    "velocity": r"rises from # cm/s \(column\) to # cm/s \(very heavy beam, γ→∞\)",
    "models": "under each of ten models, a beam as heavy as both columns raises the",
    "raises": "median overturning velocity of such columns, by # to # %",
    "uplift": r"tested trilith agree with ours \(p̂=# rad/s\); it was shaken below uplift",
    "small": "Allen et al. mostly underestimates rotations, the more the lighter the beam",
}
NOT_RECOMPUTED = {  # sentences of README and abstract, and the rules that compute them
    "alone is # % lower, as measured on concrete, # to # of the benefit": "break_even",
    "keeps # % less velocity at impacts than theory says, as measured on concrete, # to #": "same",
    r"near faults \(# to # m/s\)": "break_even, its velocities",
    "at # % less acceleration than (?:its|the) column": "worst_found",
    "at # % less than a frame with a light beam": "worst_found",
    "ith pulses changed by # %, #(?: and #)? of # still do": "worst_found, from its draws",
    "# claims # are confirmed, # hold on a condition, # is supported, # holds by": "make check",
    "definition, # were not tested": "make check",
    "shares of motions that overturn, read for the gains": "motions",
    "two square columns in line; light beams and friction": "engine, friction",
}
INPUTS = r"6 m × 1 m|6 m by 1 m|6 ?g|1 \+ [23]γ|Fig\. 1|Eqs?\. \(\d+\)( to \(\d+\))?"
NUMBER = r"(\d+(?:\.\d+)?)"
departed = []


def table(name, **known):
    """Return the rows of a published table that have known cells, with numbers as numbers."""

    def read(text):
        return float(text) if re.fullmatch(r"-?(inf|[\d.]+(e-?\d+)?)", text) else text

    with open(FOLDER / f"tests/reference/{name}.csv", newline="", encoding="utf-8") as lines:
        rows = [{key: read(text) for key, text in row.items()} for row in csv.DictReader(lines)]
    return [row for row in rows if known.items() <= row.items()]


def readme():
    """Return the results that README states as one line, without addresses of links."""
    text = (FOLDER / "README.md").read_text(encoding="utf-8")
    text = text.partition("Are they?")[2].partition("## Use the library")[0]
    text = re.sub(r"\]\([^)]*\)|[\[*]|(?s:In a clone,.*?## What)", "", text)  # also the commands
    return " ".join(text.split())


def not_covered(text, sentences):
    """Return the numbers of a text that are in none of its sentences and no input above."""
    for known in (*sentences, *NOT_RECOMPUTED, INPUTS):
        text = re.sub(known.replace("#", NUMBER), "", text)
    return re.findall(r"\d[\d.]*", text)


def compare(what, published, computed, relative=1e-6, printed=""):
    """Print a line and note whether it departs: texts by more than half of their last digit."""

    def half(text):
        return 0.5000001 * 10.0 ** -len(text.partition(".")[2])

    allowed = half(published) if isinstance(published, str) else relative * abs(published)
    apart = abs(float(published) - computed) if float(published) != computed else 0.0
    good = apart <= allowed and (not printed or abs(float(printed) - computed) <= half(printed))
    departed.extend([] if good else [what.strip()])
    shown = published if isinstance(published, str) else f"{published:.9g}"
    end = "" if good else "  DEPARTS"
    numbers = f"{shown:>13}{computed:>13.9g}{apart:>9.0e}{allowed:>9.0e}"
    print(f"{what:72}{printed:>8}{numbers}{end}", flush=True)


def compare_all(what, published, computed, relative=1e-6):
    """Compare many numbers and print the worst one."""
    pairs = [*zip(published, computed, strict=True)]
    apart = [abs(a - b) / max(abs(a), 1e-300) if a != b else 0.0 for a, b in pairs]
    worst = map(float, pairs[np.argmax(apart)])
    compare(f"{what} (worst of {len(pairs)})", *worst, relative)


def compare_readme(name, computed=(), holds=True):
    """Compare whether README says a sentence with whether it is true, and its numbers."""
    match = re.search(SENTENCES[name].replace("#", NUMBER), readme())
    compare(f"   README: {SENTENCES[name]:.60}", float(match is not None), float(holds))
    for text, number in zip(match.groups() if match else (), computed, strict=bool(match)):
        compare(f"   README: {name}", text, number)


def compare_abstract(name, holds):
    """Note a sentence of the abstract that is not true."""
    compare(f"   abstract: {ABSTRACT[name]:.58}", 1.0, float(holds))


# The parts ---------------------------------------------------------------------------------------


def trust():
    """A minimum that has a closed form: linearised, under a half-sine pulse, without impact.

    From uplift on φ = α − A k sin ωt + C exp(t) + D exp(−t) with k = 1/(1 + ω²). It overturns if
    what grows behind the pulse is positive: φ − α + φ' > 0 at ωt = π.
    """
    alpha, omega = 0.2, 4.0
    k = 1 / (1 + omega**2)

    def growing(amp):
        lift = math.asin(alpha / amp)
        part = math.exp((PI - lift) / omega)
        return part * (alpha * (k - 1) + amp * k * omega * math.cos(lift)) + amp * k * omega

    beside = scipy.optimize.brentq(growing, 1.01 * alpha, 5.0) * np.array([1 - 1e-8, 1 + 1e-8])
    ends = follow([Body(1.0, alpha, 0.9)], beside, pulse("half-sine"), omega, linear=True)
    compare_all("this file: beside a minimum that has a closed form", [0, 1], ends.overturned)


def parameters():
    rows, p = table("mass_ratio"), column(*TEMPLE).p
    ratios = np.array([frame(*TEMPLE, row["mass_ratio"]).p / p for row in rows])
    compare_all("Eq. (23): p̂/p over γ", [row["frequency_ratio"] for row in rows], ratios)
    compare_all("Eq. (24): R̂/R over γ", [row["size_ratio"] for row in rows], ratios**-2)
    compare_readme("size", [min(ratios) ** -2])
    with_beam = 8 / 3 + 4 * 3.4, 2 + 2 * 3.4  # inertia/m_c R², moment/m_c g b, for m_b = 3.4 m_c
    factors = [8 / 3 * (1 + 3 * 1.7), 2 * (1 + 2 * 1.7)]
    compare_readme("inertia", holds=np.allclose(with_beam, factors))
    compare_readme("slower", holds=(ratios[1:] < 1).all())
    rows = table("restitution")
    places = [(math.tan(math.radians(row["slenderness_deg"])), 1.0) for row in rows]
    roots = [column(*place).root for place in places]
    lower = [frame(*at, row["mass_ratio"]).root for at, row in zip(places, rows, strict=True)]
    compare_all("Eq. (25): √r over α and γ", [row["restitution"] for row in rows], lower)
    compare_all("   √r of the column", [row["restitution_of_column"] for row in rows], roots)
    fall = [a > b for a, b, row in zip(roots, lower, rows, strict=True) if row["mass_ratio"]]
    compare_abstract("size", all(fall) and max(ratios**-2) <= 1.5 + 1e-9)


def trilith():
    alone, whole = column(*TRILITH), frame(*TRILITH, 0.434)
    base = 0.005 * (2 * PI * 3.3) ** 2  # m/s²: u₀ (2πf)²
    level = math.tan(alone.alpha)
    published = {row["quantity"]: row["value"] for row in table("trilith_numbers")}
    for name, number, printed in (  # p. 4
        ("slenderness", math.degrees(alone.alpha), "15.38"),
        ("size", math.hypot(*TRILITH), "0.415"),
        ("frequency_parameter", alone.p, "4.21"),
        ("frequency_ratio", whole.p / alone.p, "0.9"),
        ("frame_frequency_parameter", whole.p, "3.79"),
        ("base_acceleration", base, "2.15"),
        ("base_acceleration_in_g", base / G, "0.219"),
        ("uplift_acceleration", level, "0.275"),
    ):
        compare(f"trilith: {name}", published[name], number, printed=printed)
    compare_readme("trilith", [whole.p])
    amplitudes, omega = [base / G, 0.999 * level, 1.001 * level], 2 * PI * 3.3
    peaks = follow([whole], amplitudes, pulse("one-sine", cycles=40), omega).peak
    compare_all("   uplifts in 40 cycles of the shake table, tan α ∓ 0.1 %", [0, 0, 1], peaks > 0)
    compare_readme("uplift", holds=peaks[0] == 0)
    compare_abstract("uplift", peaks[0] == 0 and not any("trilith" in what for what in departed))


def point(gamma, degree, shape, ratio, amplitude):
    """Return a frame of size 1 m, a pulse shape, its frequency (rad/s) and its amplitude (g)."""
    b, h = math.sin(math.radians(degree)), math.cos(math.radians(degree))
    return frame(b, h, gamma), shape, ratio * column(b, h).p, amplitude * b / h


def allen():
    """The peak of the linearised frame without column mass over that of the exact one."""
    medians, small = {}, []
    for row in table("allen_errors", model="all", shape="one-sine", frequency_ratio=5):
        gamma, errors, sine = row["mass_ratio"], [], pulse("one-sine")
        for degree in (5.0, 7.5, 10.0):
            body, _, omega, amplitudes = point(gamma, degree, "", 5, np.linspace(1.1, 5.0, 14))
            exact = follow([body], amplitudes, sine, omega)
            body = point(INF, degree, "", 5, 1.0)[0]
            simple = follow([body], amplitudes, sine, omega, linear=True)
            errors += [*(simple.peak / exact.peak - 1)]
        medians[gamma] = np.nanmedian(np.abs(errors))
        compare(f"Allen et al., γ = {gamma:g}: median error", row["median_error"], medians[gamma])
        compare("   peaks too small", row["too_small"], float((np.array(errors) < 0).sum()))
        small.append(np.nanmedian(errors) < 0)
    compare_readme("allen", [100 * medians[0.5]])
    compare_readme("small", holds=all(small))
    compare_abstract("small", all(small) and medians[0.5] > medians[2.0] > medians[10.0])


def histories():
    """Signed rotations of the frame, exact and linearised without column mass, over time."""
    for name, amplitude, ground, omega in (
        ("pulse", 0.6, pulse("one-sine"), 2 * PI / 0.8),
        ("record", 2.0, record(*read_at2(FOLDER / "data/records/el_centro_1940_NS.AT2")), 1.0),
    ):
        rows = table("allen_histories", motion=name)
        x = omega * np.array([row["time"] for row in rows])
        for model, body in (("exact", frame(*TEMPLE, 1.0)), ("all", frame(*TEMPLE, INF))):
            motion = follow([body], amplitude, ground, omega, model == "all", samples=x)
            angles = 2 + motion.rotation[0] / body.alpha
            published = [2 + row[model] for row in rows]
            compare_all(f"2 + θ/α over time, {name}, {model}", published, angles, 1e-7)


def compare_bodies(what, rows, bodies, lowest):
    """Compare bodies and their minima, as far as rows have them, each quantity by itself."""
    pairs = {}
    for row, body, number in zip(rows, bodies, lowest, strict=True):
        numbers = {"minimum_overturning": number, "equivalent_size": 3 * G / (4 * body.p**2)}
        numbers |= {"frequency_parameter": body.p, "slenderness_deg": math.degrees(body.alpha)}
        numbers |= {"restitution": body.root, "uplift_acceleration": math.tan(body.alpha)}
        for name in numbers.keys() & row.keys():
            pairs.setdefault(name, []).append((row[name], numbers[name]))
    for name, columns in sorted(pairs.items()):
        compare_all(f"{what}: {name.replace('_', ' ')}", *np.transpose(columns), 1e-7)


def vase():
    omega = 2 * PI / PERIOD
    for shape in ("one-sine", "ricker-symmetric", "one-cosine"):
        rows = [row for row in table("vase", shape=shape) if row["structure"] in MAKE]
        bodies = [MAKE[row["structure"]](*TEMPLE, row["mass_ratio"]) for row in rows]
        numbers = minima(bodies, pulse(shape), omega)
        compare_bodies(f"column, fixed mass, frame, {shape}", rows, bodies, numbers)
    lowest = {(r["structure"], r["mass_ratio"]): n for r, n in zip(rows, numbers, strict=True)}
    compare_readme("minima", [lowest["column", 0.0], lowest["frame", INF]])
    proven = table("proven", part="minimum")
    numbers = [lowest[row["structure"], row["mass_ratio"]] for row in proven]
    ends = [row["amplitude"] for row in proven]
    compare_all("   beside ends that are proven", ends, numbers, 2e-8)
    four = [column(0.25, 1.5), column(*TEMPLE), frame(*TEMPLE, 1.0), frame(*TEMPLE, 4.0)]
    numbers = minima(four, pulse("one-cosine"), omega)
    compare_bodies("Fig. 1: four structures", table("four_structures"), four, numbers)
    compare_readme("four", holds=(np.diff(numbers) > 0).all())


def spectra():
    """The map of pulses: its table against outcomes at random points; then README's areas."""
    intervals, random = {}, np.random.default_rng(1)
    for row in table("spectra"):
        place = row["mass_ratio"], row["slenderness_deg"], row["shape"], row["frequency_ratio"]
        intervals.setdefault(place, []).append((row["lower"], row["upper"] or 16.0))
    gammas, degrees, shapes, ratios = (sorted({key[n] for key in intervals}) for n in range(4))
    agree, groups = 0.0, {}  # of like ω/p, which are followed together
    keys_of_all = [*intervals]
    for number, index in enumerate(random.integers(len(intervals), size=3000)):
        ends = intervals[key := keys_of_all[index]]
        near = np.ravel(ends)[0] * random.choice([0.999, 1.001])
        amplitude = near if number % 2 else random.uniform(1, 16)
        expected = any(low < amplitude < high for low, high in ends)
        group = groups.setdefault((key[2], round(math.log2(key[3]))), [])
        group.append((*point(*key, amplitude), expected, key, amplitude))
    for (shape, _), group in groups.items():
        bodies, _, omegas, amplitudes, expected, keys, ratios_of = zip(*group, strict=True)
        fell = follow(bodies, amplitudes, pulse(shape), np.array(omegas)).overturned
        agree += (fell == expected).sum()
        for index in np.flatnonzero(fell != expected):
            near = np.abs(np.ravel(intervals[keys[index]]) / ratios_of[index] - 1).min()
            print(f"   differs: γ, α (°), shape, ω/p {keys[index]}, by {near:.1e} of an end")
    # of 3,000, ten may lie in an interval that is narrower than the table's resolution
    compare("map of pulses: outcomes at random and beside minima", 3000.0, agree, 1 / 300)

    def area(place, *pair):  # share of a map that overturns the first γ and not the second
        lengths = []
        for ratio in ratios:
            a, b = (intervals.get((gamma, *place, ratio), []) for gamma in pair)
            shared = [max(0, min(c[1], d[1]) - max(c[0], d[0])) for c, d in product(a, b)]
            lengths.append(sum(high - low for low, high in a) - sum(shared))
        return np.trapezoid(lengths, ratios) / (ratios[-1] - ratios[0]) / 15

    areas, published = [], []
    for row in table("spectra_areas", change="frame", beside="column", mass_ratio=INF):
        place = row["slenderness_deg"], row["shape"]
        areas.append((area(place, 0.0, INF), area(place, INF, 0.0)))
        published.append((row["prevented"], row["caused"]))
    what = "   shares of the maps, heaviest beam (intervals: from table)"
    compare_all(what, np.ravel(published), np.ravel(areas))
    places = [*product(degrees, shapes, ratios)]
    lowest = [[min(intervals.get((g, *place), [(INF,)]))[0] for g in gammas] for place in places]
    falls = float(sum(a > b for row in lowest for a, b in pairwise(row)))
    compare("   minima that decrease as the beam becomes heavier (from table)", 0.0, falls)
    margins = {(b / a - 1, place, n): (a, b) for place, row in zip(places, lowest, strict=True)
               for n, (a, b) in enumerate(pairwise(row)) if b < INF}  # fmt: skip
    fell, beside = [], np.array([1 - 1e-7, 1 + 1e-7])
    for (_, (degree, shape, ratio), n), pair in sorted(margins.items())[:12]:
        for gamma, end in zip(gammas[n : n + 2], pair, strict=True):
            body, _, omega, level = point(gamma, degree, shape, ratio, end)
            fell.extend(follow([body], level * beside, pulse(shape), omega).overturned)
    compare_all("   beside the 12 pairs of minima that are nearest to a fall", [0, 1] * 24, fell)
    compare_readme("never", holds=falls == 0 and fell == [0, 1] * 24)


def cycles():
    """Sines of several cycles: the largest falls of the minimum in the table, searched again."""
    rows, falls = {}, []
    for row in table("spectra_cycles"):
        place = row["cycles"], row["slenderness_deg"], row["frequency_ratio"]
        rows.setdefault(place, {})[row["mass_ratio"]] = row
    for place, line in rows.items():
        alone, *frames = sorted(line)
        for pair in (*pairwise(frames), *product([alone], frames)):
            ends = line[pair[0]]["lowest_found"], line[pair[1]]["wide_minimum"]
            if ends[1] < ends[0]:
                falls.append((1 - ends[1] / ends[0], pair, place, ends))
    largest = {(fall[2][0], fall[1][0] == 0): fall for fall in sorted(falls)}
    for (number, is_column), (_, pair, (_, degree, ratio), ends) in sorted(largest.items()):
        points = [point(gamma, degree, "", ratio, 1.0) for gamma in pair]
        bodies, _, omegas, levels = zip(*points, strict=True)
        lowest = minima(bodies, pulse("one-sine", number), omegas) / levels
        lighter = "column" if is_column else "frame"
        words = f"{number:g} cycles of a sine, largest in the table, frame below {lighter}"
        compare_all(f"{words}: minima", ends, lowest, 1e-7)


def guaranteed(body, n=INF):
    """Return the ground velocity V_n that overturns nothing before impact n, or V*, m/s."""
    total = 1 / (1 - body.root) if n == INF else sum(body.root**k for k in range(n))
    return G / body.p * math.sin(body.alpha / 2) / math.cos(body.alpha) / total


def guarantee():
    names = ["velocity_1", "velocity_2", "velocity_3", "velocity_4", "velocity_5", "velocity"]
    for place, sizes in (("trilith", TRILITH), ("temple", TEMPLE), ("tall", (1.0, 6.0))):
        rows = table("guarantee", structure=place)
        bodies = [MAKE[row["support"]](*sizes, row["mass_ratio"]) for row in rows]
        numbers = [guaranteed(body, n) for body in bodies for n in (1, 2, 3, 4, 5, INF)]
        compare_all(f"{place}: V_1 to V_5, V*", [row[n] for row in rows for n in names], numbers)
    first = [100 * guaranteed(frame(*TEMPLE, gamma), 1) for gamma in (0, INF)]
    compare_readme("velocity", first)
    compare_abstract("velocity", first[0] < first[1])
    worst_motion("V_1 to V_3, 1e-4 above and below", (2, 9.46, 20, 36), (1, 2, 3), 1e-4, 80)


def resonance():
    worst_motion("1.01 and 0.99 of V*", (9.46, 20, 36), [INF], 1e-2, 600)


def worst_motion(words, degrees, visits, off, end):
    """Follow frames under the worst motion a little above and below V_n, up to a time p t.

    The ground velocity jumps by 2 V after each impact, which adds 2 V p cos(α)/g to dφ/d(p t). The
    body overturns on visit n beyond V_n and not below it; a visit is the motion between impacts.
    """
    cases = [*product(degrees, (0.0, 0.25, 1.0, 4.0, INF), visits, (1, -1))]
    bodies = [point(gamma, degree, "", 1, 1)[0] for degree, gamma, *_ in cases]
    p, alpha, _ = np.transpose(bodies)
    limits = [guaranteed(body, case[2]) for body, case in zip(bodies, cases, strict=True)]
    above = np.array([case[3] for case in cases])
    kick = 2 * (1 + off * above) * limits * p / G * np.cos(alpha)
    motion = follow(bodies, 0.0, QUIET, start=(0, kick), kick=kick, samples=[end])
    fell = np.isnan(motion.rotation[:, 0])
    pairs = zip(motion.impacts, cases, strict=True)
    last = [case[2] in (1 + len(times), INF) for times, case in pairs]
    compare_all(f"   the worst motion overturns, {words}", above > 0, fell & last)


def median_velocity(velocities, shares):
    """Return the velocity that overturns half: of the likeliest Φ(a + b x + c x²), x = ln v."""
    x = np.log(velocities)
    powers = np.stack([x**0, x, x**2])

    def score(terms):  # the slope of the likelihood
        probit = terms @ powers
        density = -(probit**2) / 2 - math.log(2 * PI) / 2
        over, under = (np.exp(density - scipy.special.log_ndtr(sign * probit)) for sign in (1, -1))
        return powers @ (shares * over - (1 - shares) * under)

    inside = (shares > 0.02) & (shares < 0.98)
    start = np.polynomial.Polynomial.fit(x[inside], scipy.special.ndtri(shares[inside]), 2)
    terms = scipy.optimize.root(score, start.convert().coef, tol=1e-13).x
    return math.exp(scipy.optimize.brentq(lambda v: terms @ [1, v, v**2], x[0], x[-1]))


def gains():
    """The gain of frames in the velocity that overturns half, from published shares."""
    curves = {}
    for row in table("motions_fragility"):
        place = row["model"], row["column"], row["mass_ratio"]
        if row["structure"] != "fixed mass":
            curves.setdefault(place, []).append((row["velocity"], row["probability"]))
    half = {place: median_velocity(*np.array(curve).T) for place, curve in curves.items()}
    pairs, equal = [], {"trilith": [], "temple": [], "tall": []}
    for row in table("motions_gains"):
        place = row["model"], row["structure"]
        ratio = half[*place, row["mass_ratio"]] / half[*place, 0.0]
        pairs.append((1 + row["gain"], ratio))
        if row["mass_ratio"] == 1:
            equal[row["structure"]].append(100 * (ratio - 1))
    compare_all("gain in the median velocity (shares: from table)", *np.transpose(pairs))
    compare_readme("gain", [end(equal["temple"]) for end in (min, max)])
    compare_readme("raises", holds=min(map(min, equal.values())) > 0)
    compare_readme("models", holds=len(equal["temple"]) == 10)
    compare_abstract("raises", min(equal["temple"]) > 0)
    compare_abstract("models", len(equal["temple"]) == 10 and min(equal["temple"]) > 0)


PARTS = trust, parameters, trilith, allen, histories, vase, spectra, cycles
PARTS += guarantee, resonance, gains


def main():
    print(f"{'':72}{'printed':>8}{'published':>13}{'recomputed':>13}{'apart':>9}{'allowed':>9}")
    for part in [part for part in PARTS if part.__name__ in sys.argv[2:]] or PARTS:
        part()
    numbers = not_covered(readme(), SENTENCES.values())
    departed.extend(f"README: {number} is not known here" for number in numbers)
    print("Not recomputed:", *(f"{a} ({b})" for a, b in NOT_RECOMPUTED.items()), sep="\n   ")
    print(f"{len(departed)} depart", *departed, sep="\n   ")
    sys.exit(bool(departed))


if __name__ == "__main__":
    main()
