"""Which general sentence does a ground motion contradict, and which motion contradicts one most?

    make refute MOTION=record.csv                 a file that read_record reads
    make refute MOTION='+0.9 0.3; -0.9 0.3 0.2'   half-sine lobes: sign and length (s), amplitude
                                                  (g), and the pause before it (s) if any
    make refute SENTENCE=frame_over_column MINUTES=10 SEED=1   a search from the worst known case;
                                                  DRAWS=7: for falls that 1 % changes leave
    make refute ADD=results/refute.yaml           take the case of a search into the table

The sentences are in paper/sentences.yaml, the worst cases in data/worst_found.yaml.
"""

import argparse
import datetime
import math
import re
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from scipy.optimize import differential_evolution

from replication.config import read_config, read_yaml
from replication.sections import Paper
from steps.beyond.worst_found import PLACES, column_and_lobes, motion_of, read_cases, row_of_case
from steps.guarantee import FIRST, velocity
from steps.shared.lobes import Lobe, record_of
from steps.shared.sentences import (
    compared,
    half_range,
    normalised,
    premises,
    read_sentences,
    structure_of,
)
from topheavy import Column, Record, read_record

CASES, FOUND = "data/worst_found.yaml", Path("results/refute.yaml")
SAMPLES = 40  # in the shortest lobe of a motion in words
SPREAD = 0.01  # relative: standard deviation of the motions with which a search begins
POPULATION = 40
REACH = 0.15  # relative: how far a search goes from its start
STEEPEST = 5.0, 15.0  # degrees: slenderness of the columns of a search

Case = dict[str, Any]


def lobes_in_words(text: str) -> list[Lobe]:
    """Return the lobes of a motion in words, "+0.9 0.3; -0.9 0.3 0.2"."""
    lobes = []
    for number, part in enumerate(text.split(";"), 1):
        terms = part.split()
        try:
            length, amplitude, pause = map(float, [*terms, "0"][:3] if len(terms) == 2 else terms)
        except ValueError:
            length = amplitude = pause = math.nan
        if not (length and amplitude > 0.0 and pause >= 0.0):
            raise ValueError(
                f"lobe {number} is '{part.strip()}'; expected its length in s with the sign of its "
                "push, its amplitude in g, and the pause before it in s if any: '-0.9 0.3 0.2'"
            )
        lobes.append(Lobe(math.copysign(1.0, length), abs(length), amplitude, pause))
    return lobes


def motion_from(text: str) -> Record:
    """Return the motion of a file, or of lobes in words."""
    if re.match(r"\s*[-+][\d.]", text):
        lobes = lobes_in_words(text)
        return record_of(lobes, min(lobe.length for lobe in lobes) / SAMPLES)
    return read_record(text)


def answer(text: str, config: dict[str, Any]) -> list[str]:
    """Return for each sentence whether the motion contradicts it, for the article's structures."""
    record, spec = motion_from(text), config["spectra"]["cycles"]
    names, gammas = config["motions"]["structures"], config["spectra"]["mass_ratios"]
    columns, lines = [Column(**config["structures"][name]) for name in names], []
    for name, sentence in read_sentences().items():
        falls = []
        for column in columns:
            motion = normalised(record, column)
            for pair in sentence.pairs(gammas):
                comparison = compared(column, pair, motion, spec)
                if comparison.fall.strict > 0.0:
                    falls.append((comparison.fall.strict, column, pair, motion, comparison))
        lines.append(f"{name}: {sentence.sentence}")
        if not falls:
            lines.append(
                f"  not contradicted, up to a peak of {spec['highest']:g} g tan α, for columns of "
                f"{', '.join(f'{2 * column.half_height:g}' for column in columns)} m and γ of "
                f"{', '.join(f'{gamma:g}' for gamma in gammas)}"
            )
        for share, column, pair, motion, comparison in sorted(falls, key=lambda row: -row[0])[:1]:
            lines += contradiction(share, column, pair, motion, comparison, record, config)
            lines.append(f"  and in {len(falls) - 1} other comparisons of these structures")
    return lines


def contradiction(
    share: float,
    column: Column,
    pair: tuple[float, float],
    motion: Record,
    comparison: Any,
    record: Record,
    config: dict[str, Any],
) -> list[str]:
    """Return the lines on the largest fall under a motion: scales, velocities, contacts."""
    start, end = comparison.stronger.wide_lower, comparison.weaker.lower
    unit = motion.peak_acceleration / record.peak_acceleration
    ends = start, min(end, comparison.stronger.wide_upper)
    least, friction = premises(column, pair, motion, ends, config["contacts"])
    speed, block = start * half_range(motion), structure_of(column, pair[1]).block()
    above = [f"V_{n} = {velocity(block, n):.2f}" for n in FIRST if speed > velocity(block, n)]
    kept = least > 0.0 and friction <= config["contacts"]["sufficient"]
    return [
        f"  contradicted by {100 * share:.1f} %: columns of {2 * column.half_height:g} m, "
        f"γ = {pair[1]:g} overturns from {unit * start:.4g} times the motion, γ = {pair[0]:g} from "
        f"{unit * end:.4g}",
        f"  half the range of the ground velocity is {speed:.2f} m/s there; it exceeds "
        f"{above[0] if above else 'no V_n'} m/s of γ = {pair[1]:g} (overturning before impact n)",
        f"  contacts: least vertical force {least:.2f} of that at rest, friction at most "
        f"{friction:.2f}: {'an example' if kept else 'no example, since they part or slide'}",
    ]


# The search ---------------------------------------------------------------------------------------


def varied(start: Case, factors: Sequence[float]) -> Case:
    """Return a case with the slenderness, lengths and amplitudes of a case times factors."""
    angle, lengths, pushes, pauses = np.split(np.asarray(factors), [1, *ends_of(start)])
    lobes = np.array(start["lobes"]) * np.stack([lengths, pushes, pauses], axis=1)
    lobes[:, 1] /= np.abs(lobes[:, 1]).max()
    slenderness = float(np.clip(start["slenderness"] * angle[0], *STEEPEST))
    rounded = [[round(float(term), 6) for term in lobe] for lobe in lobes]
    return start | {"slenderness": round(slenderness, 5), "lobes": rounded}


def ends_of(start: Case) -> list[int]:
    """Return where lengths and pushes end in the factors of a search, behind the angle."""
    count = len(start["lobes"])
    return [1 + count, 1 + 2 * count]


def search(
    sentence: str, minutes: float, seed: int, draws: int, config: dict[str, Any]
) -> tuple[Case, float]:
    """Return the worst case of a search from the worst known one, and its value.

    Differential evolution of slenderness and lobes. The value is the strict fall of one pair; with
    `draws`, its lowest quartile over the motion and motions drawn around it, so that a fall which
    lives on the equality of its lobes has none. All contacts of an improvement keep the premises.
    """
    spec, height = config["spectra"]["cycles"], config["structures"]["temple"]["half_height"]
    known = [case for case in read_cases(CASES) if case["sentence"] == sentence]
    if not known:
        raise ValueError(f"{CASES} has no case of '{sentence}' to begin with")
    start = max(known, key=lambda case: ((case["draws"] > 0) == (draws > 0), case["fall"]))
    best, most, evaluations = start, -1.0, 0
    pair, random = (start["lighter"], start["heavier"]), np.random.default_rng(seed)
    noise = SPREAD * random.standard_normal((draws, len(start["lobes"]), 2))
    until = time.monotonic() + 60.0 * minutes

    def objective(factors: Sequence[float]) -> float:
        nonlocal best, most, evaluations
        evaluations += 1
        case = varied(start, factors)
        column, lobes = column_and_lobes(case, height)
        motion = motion_of(column, lobes)
        weaker, stronger, fall = compared(column, pair, motion, spec)
        falls = [fall.strict]
        for change in noise:
            pushes = [
                lobe._replace(length=lobe.length * (1 + a), amplitude=lobe.amplitude * (1 + b))
                for lobe, (a, b) in zip(lobes, change, strict=True)
            ]
            falls.append(compared(column, pair, motion_of(column, pushes), spec).fall.strict)
        value = float(np.quantile(np.nan_to_num(falls, nan=-1.0, neginf=-1.0), 0.25))
        if value > most:
            if fall.strict > 0.0:
                ends = stronger.wide_lower, min(weaker.lower, stronger.wide_upper)
                least, friction = premises(column, pair, motion, ends, config["contacts"])
                if least <= 0.0 or friction > config["contacts"]["sufficient"]:
                    return 1.0
            most = value
            best = case | {"fall": round(fall.strict, PLACES), "evaluations": evaluations}
            print(f"{evaluations} evaluations: {100 * value:.2f} %", flush=True)
        return -value

    size = 1 + 3 * len(start["lobes"])
    population = 1.0 + SPREAD * random.standard_normal((POPULATION, size))
    population[0] = 1.0
    differential_evolution(
        objective,
        [(1.0 - REACH, 1.0 + REACH)] * size,
        init=population,
        maxiter=sys.maxsize,
        tol=0.0,
        polish=False,
        rng=random,
        callback=lambda intermediate_result: time.monotonic() > until,
    )
    print(f"{evaluations} evaluations in all")
    name = f"{sentence}_{pair[0]:g}_{pair[1]:g}{'_kept' if draws else ''}"
    about = {"id": name, "draws": draws, "seed": seed, "date": datetime.date.today()}
    return best | about, most


def add(path: str, config: dict[str, Any]) -> str:
    """Take a case into the file, in place of that with the same name if it is worse."""
    case = read_yaml(path)
    row_of_case(  # it has to have the fall that it states
        case, config["structures"]["temple"]["half_height"], config["spectra"]["cycles"],
        config["contacts"],
    )  # fmt: skip
    cases = {old["id"]: old for old in read_cases(CASES)}
    fall = cases.get(case["id"], {"fall": 0.0})["fall"]
    if fall >= case["fall"]:
        return f"{CASES} has {case['id']} with {100 * fall:.2f} %: not added"
    head = Path(CASES).read_text("utf-8").partition("\n- ")[0]
    Path(CASES).write_text(f"{head}\n{in_yaml([*(cases | {case['id']: case}).values()])}", "utf-8")
    return f"{CASES} has it: run make reproduce, read what changes, and commit"


def in_yaml(content: Any) -> str:
    """Return cases as YAML, a lobe in a line."""
    return yaml.safe_dump(content, sort_keys=False, allow_unicode=True, default_flow_style=None)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--motion")
    parser.add_argument("--sentence", choices=[*read_sentences()])
    parser.add_argument("--minutes", type=float, default=1.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--draws", type=int, default=0)
    parser.add_argument("--add")
    options = parser.parse_args()
    config = read_config("config/config.yaml", Paper, read_yaml("config/config.yaml"))
    try:
        if options.motion:
            print("\n".join(answer(options.motion, config)))
        elif options.sentence:
            FOUND.parent.mkdir(exist_ok=True)
            asked = options.sentence, options.minutes, options.seed, options.draws
            case, value = search(*asked, config)
            FOUND.write_text(in_yaml(case), "utf-8")
            print(f"{FOUND}: {100 * value:.2f} %; to add it: make refute ADD={FOUND}")
        elif options.add:
            print(add(options.add, config))
        else:
            parser.error(str(__doc__))
    except (ValueError, OSError) as fault:
        sys.exit(str(fault))


if __name__ == "__main__":
    main()
