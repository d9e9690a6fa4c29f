"""Which general sentence does a ground motion contradict, and which motion contradicts one most?

    make refute MOTION=record.csv                 a file that read_record reads
    make refute MOTION='+0.9 0.3; -0.9 0.3 0.2'   half-sine lobes: sign and length (s), amplitude
                                                  (g), and the pause before it (s) if any
    make refute SENTENCE=frame_over_column MINUTES=10 SEED=1   a search of ten minutes of processor
                              time; DRAWS=16: for falls that motions changed by 1 % keep
    make refute ADD=results/refute.yaml           take the case of a search into the table

The sentences are in paper/sentences.yaml, the worst cases in data/worst_found.yaml.
"""

import argparse
import datetime
import math
import os
import sys
import time
from collections.abc import Mapping
from itertools import chain, product
from pathlib import Path
from typing import Any

import numpy as np
import yaml

from replication.config import read_config, read_yaml
from replication.sections import Paper
from steps.beyond.contacts import frame_name
from steps.beyond.worst_found import PLACES, case_of, row_of_case
from steps.guarantee import FIRST, velocity
from steps.shared.falls import Comparison, strict_falls
from steps.shared.lobes import Lobe, drawn, half_range, record_of, sine
from steps.shared.sentences import Case, read_sentences
from topheavy import Column, Record, read_record

CASES, FOUND = "data/worst_found.yaml", Path("results/refute.yaml")
SAMPLES = 40  # in the shortest lobe of a motion in words
STEEPEST = 5.0, 15.0  # degrees: slenderness of the columns of a search
RANDOM = 4  # one in so many motions of a search has nothing to do with the worst so far
SPREAD = 0.03  # relative: the largest standard deviation of a step from the worst case
LOST = 4  # one in so many draws of a case may be no fall, or a smaller one

Entry = dict[str, Any]


def lobes_in_words(text: str) -> list[Lobe]:
    """Return the lobes of a motion in words, "+0.9 0.3; -0.9 0.3 0.2"."""
    lobes = []
    for number, part in enumerate(text.split(";"), 1):
        terms = part.split()
        try:
            length, amplitude, pause = map(float, [*terms, "0"] if len(terms) == 2 else terms)
        except ValueError:
            length = amplitude = pause = math.nan
        if not (length and 0.0 < amplitude < math.inf and 0.0 <= pause < math.inf):
            raise ValueError(
                f"lobe {number} is '{part.strip()}', which is no file either; expected its length "
                "in s with the sign of its push, its amplitude in g, and the pause before it in s "
                "if any: '-0.9 0.3 0.2'"
            )
        lobes.append(Lobe(math.copysign(1.0, length), abs(length), amplitude, pause))
    return lobes


def motion_from(text: str) -> Record:
    """Return the motion of a file, or of lobes in words."""
    if os.path.isfile(text):  # Path.is_file refuses a long text
        return read_record(text)
    lobes = lobes_in_words(text)
    return record_of(lobes, min(lobe.length for lobe in lobes) / SAMPLES)


def answer(text: str, config: Mapping[str, Any]) -> list[str]:
    """Return for each sentence whether the motion contradicts it, for the article's structures."""
    record, spec = motion_from(text), config["spectra"]["cycles"]
    gammas, lines = config["spectra"]["mass_ratios"], []
    columns = [Column(**config["structures"][name]) for name in config["motions"]["structures"]]
    heights = ", ".join(f"{2.0 * column.half_height:g}" for column in columns)
    for name, sentence in read_sentences().items():
        falls = []
        for column, pair in product(columns, sentence.pairs(gammas)):
            unit = column.uplift_acceleration / record.peak_acceleration
            case = Case(column, *pair, record.scaled(unit))
            comparison = case.comparison(spec)
            if comparison.fall.strict > 0.0:
                falls.append((comparison, unit, case))
        lines.append(f"{name}: {sentence.sentence}")
        if falls:
            lines += contradiction(*max(falls, key=lambda fall: fall[0].fall.strict), config)
            lines.append(f"  and in {len(falls) - 1} other comparisons of these structures")
        else:
            lines.append(
                f"  not contradicted, up to a peak of {spec['highest']:g} g tan α, for columns of "
                f"{heights} m and γ of {', '.join(f'{gamma:g}' for gamma in gammas)}"
            )
    return lines


def contradiction(
    comparison: Comparison, unit: float, case: Case, config: Mapping[str, Any]
) -> list[str]:
    """Return the lines on a fall under a motion times a unit: scales, velocities, contacts."""
    start, height = comparison.heavier.wide_lower, config["structures"]["temple"]["half_height"]
    highest = config["spectra"]["cycles"]["highest"]
    end = min(comparison.lighter.lower, highest)
    least, friction = case.premises(comparison, config["contacts"], height)
    speed, block = start * half_range(case.motion), case.blocks()[1]
    above = [f"V_{n} = {velocity(block, n):.2f} m/s" for n in FIRST if speed > velocity(block, n)]
    fault = broken(least, friction, config)
    return [
        f"  contradicted by {100 * (1.0 - start / end):.1f} %: with columns of "
        f"{2 * case.column.half_height:g} m, {frame_name(case.heavier)} overturns from "
        f"{unit * start:.4g} times the motion; {frame_name(case.lighter)} from {unit * end:.4g}"
        f"{'' if end < highest else ' or more'}",
        f"  half the range of the ground velocity is {speed:.2f} m/s there, more than "
        f"{above[0] if above else 'no V_n'} of the heavier one (overturning before impact n)",
        f"  contacts: least vertical force {least:.2f} of that at rest, friction at most "
        f"{friction:.2f}: {f'no example, since they {fault}' if fault else 'an example'}",
    ]


def broken(least: float, friction: float, config: Mapping[str, Any]) -> str:
    """Return what contacts do against the premises: part, slide, or nothing."""
    if not least > 0.0:
        return "part"
    return "slide" if friction > config["contacts"]["sufficient"] else ""


# The search ---------------------------------------------------------------------------------------


def train(random: np.random.Generator) -> Entry:
    """Return slenderness and lobes of two or three equal pulses with pauses, drawn at random."""
    halves, length, lobes = int(random.integers(1, 4)), math.pi / random.uniform(2.0, 5.0), []
    for number in range(random.integers(2, 4)):
        first, *others = sine(halves, length, random.uniform(0.6, 1.0), random.choice([-1.0, 1.0]))
        lobes += [first._replace(pause=random.uniform(0.0, 6.0) if number else 0.0), *others]
    return entry_of(random.uniform(*STEEPEST), lobes)


def varied(entry: Entry, random: np.random.Generator) -> Entry:
    """Return a case beside another one."""
    spread = SPREAD * random.random()
    angle = entry["slenderness"] * (1.0 + spread * random.standard_normal())
    lobes = drawn([Lobe(*row) for row in entry["lobes"]], spread, random)
    return entry | entry_of(np.clip(angle, *STEEPEST), lobes)


def entry_of(degrees: float, lobes: list[Lobe]) -> Entry:
    """Return slenderness and lobes as the file has them, with a largest amplitude of 1."""
    unit = max(lobe.amplitude for lobe in lobes)
    rows = np.array(lobes) / [1.0, 1.0, unit, 1.0]
    return {"slenderness": round(float(degrees), 5), "lobes": rows.round(6).tolist()}


def kept_fall(
    case: Case, most: float, draws: int, seed: int, spec: Mapping[str, Any]
) -> tuple[float, Comparison]:
    """Return the strict fall that a case and its draws keep, but for one in `LOST`.

    It is −1 as soon as it can no longer be more than `most`: few cases cost all draws.
    """
    ends = spec["highest"], spec["wide"]
    comparison = case.comparison(spec)
    others = strict_falls(case.lobes, *case.blocks(), *ends, draws, spec["change"], seed)
    falls: list[float] = []
    for fall in chain([comparison.fall.strict], others):
        falls.append(fall if fall > most else -1.0)
        if falls.count(-1.0) > draws // LOST:
            break
    return sorted(falls)[draws // LOST], comparison


def search(
    name: str, minutes: float, seed: int, draws: int, config: Mapping[str, Any]
) -> tuple[Entry, float]:
    """Return the worst case that a search finds for a sentence, and its value.

    An evolution of one parent: random trains of pulses, then steps from the worst case so far,
    which may be a known one. The value is that of `kept_fall`, so that a fall which lives on the
    equality of its lobes has none. All contacts of an improvement keep the premises.
    """
    spec, height = config["spectra"]["cycles"], config["structures"]["temple"]["half_height"]
    pairs = read_sentences()[name].pairs(config["spectra"]["mass_ratios"])
    random, evaluations = np.random.default_rng(seed), 0
    most, best = 0.0, Entry()
    known = [entry for entry in read_yaml(CASES) if entry["sentence"] == name]
    end = time.process_time() + 60.0 * minutes
    while time.process_time() < end:
        evaluations += 1
        if known:
            entry = known.pop()
        elif not best or evaluations % RANDOM == 0:
            lighter, heavier = pairs[random.integers(len(pairs))]
            entry = {"lighter": lighter, "heavier": heavier} | train(random)
        else:
            entry = varied(best, random)
        case = case_of(entry, height)
        value, comparison = kept_fall(case, most, draws, seed, spec)
        if value > most and comparison.lighter.lower < math.inf:
            least, friction = case.premises(comparison, config["contacts"], height)
            if not broken(least, friction, config):
                most, fall = value, round(comparison.fall.strict, PLACES)
                best = {"id": f"{name}_kept" if draws else name, "sentence": name}
                best |= {key: entry[key] for key in ("slenderness", "lighter", "heavier")}
                best |= {"fall": fall, "draws": draws, "evaluations": evaluations, "seed": seed}
                best |= {"date": datetime.date.today(), "lobes": entry["lobes"]}
                print(f"{evaluations} evaluations: {100 * value:.2f} %", flush=True)
    print(f"{evaluations} evaluations in all")
    if not best:
        raise ValueError(f"no case contradicts '{name}'; expected one in more MINUTES")
    return best, most


def add(path: str, config: Mapping[str, Any]) -> str:
    """Take a case into the file, in place of that with the same name if it is worse.

    A case of draws has to remain in as many of the table's draws as it says.
    """
    height = config["structures"]["temple"]["half_height"]

    def rank(entry: Entry) -> tuple[bool, float]:
        row = row_of_case(
            entry, case_of(entry, height), config["spectra"]["cycles"], config["contacts"], height
        )
        return not entry["draws"] or row["stays"] >= 1.0 - 1.0 / LOST, row["strict"]

    new, entries = read_yaml(path), {entry["id"]: entry for entry in read_yaml(CASES)}
    if new["id"] in entries and rank(entries[new["id"]]) >= rank(new):
        return f"{CASES} has {new['id']} with {100 * entries[new['id']]['fall']:.2f} %: not added"
    head = Path(CASES).read_text("utf-8").partition("\n- ")[0]
    entries |= {new["id"]: new}
    Path(CASES).write_text(f"{head}\n{in_yaml([*entries.values()])}", "utf-8")
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
            terms = options.sentence, options.minutes, options.seed, options.draws
            case, value = search(*terms, config)
            FOUND.parent.mkdir(exist_ok=True)
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
