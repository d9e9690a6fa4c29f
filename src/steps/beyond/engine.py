"""Frames in rigid-body engines: free rocking and outcomes in the plane, and across it."""

import math
from dataclasses import replace
from itertools import product

import numpy as np
import pandas as pd

from replication.step import check, run, truth
from steps.beyond import rigid_bodies, stones
from steps.beyond.inclinations import free_rocking
from steps.beyond.rigid_bodies import Bodies, checked_version, overturns
from steps.beyond.stones import Stones
from steps.shared.cases import HIGHEST, cap_of, lowest, pulse_on
from topheavy import Column, FixedMassColumn, RockingFrame, judge, simulate

RESTITUTION, FREQUENCY = 1e-3, 3e-4  # relative, of √r and p̂: agreement of pymunk with theory
FAR = 0.03  # relative: an amplitude so far from the minimum is not near it
BELOW = 0.2  # steps below a known minimum: from where the first amplitude that overturns is sought
IN_PLANE, ACROSS = 0.0, 90.0  # degrees
COLUMN, FIXED, IN_LINE, SLAB = "column", "fixed mass", "two in line", "2 × 2"
LABELS = "structure", "direction", "section", "depth_over_width", "mass_ratio", "frequency_ratio"


def compute(settings, structures):
    version = checked_version()
    return {
        "restitution": pd.DataFrame(restitution(settings, structures, version)),
        "outcomes": pd.DataFrame(outcomes(settings, structures, version)),
        "across": across(settings, structures).assign(solver=version),
    }


def frames_of(entries, settings, structures):
    """Yield structure, frame and cap beam of each mass ratio of entries, and the entry."""
    for entry in entries:
        name, column = entry["structure"], Column(**structures[entry["structure"]])
        for gamma in entry["mass_ratios"]:
            yield name, RockingFrame(column, gamma), cap_of(settings["caps"][name]), entry


def in_the_plane(frame, cap, spec):
    """Return a column or a frame for pymunk."""
    return Stones(frame.column, frame.mass_ratio, cap, spec["time_step"], friction=spec["friction"])


def planar(frame, cap, spec):
    """Return a column or a frame in its plane for MuJoCo, as deep as a column is wide."""
    column, in_row = frame.column, 2 if frame.mass_ratio else 1
    shape = {"in_row": in_row, "is_planar": True, "friction": spec["friction"]}
    return Bodies(column, column.half_width, frame.mass_ratio, cap, spec["time_step"], **shape)


def is_for_mujoco(name, frame, settings):
    chosen = settings["mujoco"]
    return (name, frame.mass_ratio) == (chosen["structure"], chosen["mass_ratio"])


def restitution(settings, structures, version):
    """Yield p̂ and √r of each impact in free rocking, in engine and theory, Eqs. (23) and (25)."""
    spec = settings["restitution"]
    for name, frame, cap, entry in frames_of(spec["frames"], settings, structures):
        rotation, column = spec["lean"] * frame.slenderness, frame.column
        *impacts, last = simulate(frame, rotation=rotation, samples=2).impact_times[
            : entry["impacts"] + 1
        ]
        bodies = in_the_plane(frame, cap, spec)
        histories = {stones.VERSION: (bodies.time_step, stones.released(bodies, rotation, last))}
        if is_for_mujoco(name, frame, settings):
            bodies = planar(frame, cap, settings["mujoco"])
            rotations = rigid_bodies.released(bodies, rotation, last)
            histories[version] = bodies.seconds, rotations
        for solver, (time_step, rotations) in histories.items():
            time, roots = free_rocking(rotations, time_step, column)
            for impact, root in enumerate(roots[: len(impacts)], 1):
                yield {
                    "solver": solver,
                    "structure": name,
                    "mass_ratio": frame.mass_ratio,
                    "impact": impact,
                    "time_step": time_step,
                    "frequency_parameter_over_theory": impacts[0] / time,
                    "engine": root,
                    "theory": frame.restitution,
                }


def outcomes(settings, structures, version):
    """Yield the outcomes in engine and theory near the minimum overturning acceleration."""
    spec = settings["outcomes"]
    for name, frame, cap, _ in frames_of(spec["frames"], settings, structures):
        bodies = in_the_plane(frame, cap, spec)
        for place, kind in enumerate(spec["pulses"]):
            engines = {stones.VERSION: (stones.overturns, bodies)}
            if place == 0 and is_for_mujoco(name, frame, settings):
                engines[version] = overturns, planar(frame, cap, settings["mujoco"])
            pulse = minimum(frame, kind)
            for solver, (overturn, bodies_of_it) in engines.items():
                for factor in spec["factors"]:
                    yield {
                        "solver": solver,
                        "structure": name,
                        "mass_ratio": frame.mass_ratio,
                        **kind,
                        "factor": factor,
                        "engine": overturn(bodies_of_it, pulse.scaled(factor)),
                        "theory": judge(frame, pulse.scaled(factor)).overturned,
                    }


def minimum(frame, kind, column=None):
    """Return the pulse of the minimum in theory; ω is over p of its own or of a given column."""
    pulse = pulse_on(column or frame.column, **kind)
    return replace(pulse, amplitude=lowest(frame, pulse).factor)


def across(settings, structures):
    """Return the first amplitudes that overturn in the plane and across it.

    They are over the minimum of the square column in theory, as are the uplift acceleration by hand
    and the minimum in theory, which is not known for round columns and oblique directions. There
    they are sought from just below the column's own in the same direction, if it is known.
    """
    spec, free = settings["across"], [(IN_LINE, IN_PLANE), (IN_LINE, ACROSS), (SLAB, IN_PLANE)]
    frequency, (light, *_, heavy) = spec["frequency_ratios"][0], spec["mass_ratios"]
    square = [(COLUMN, IN_PLANE, "square", 1.0, 0.0, ratio) for ratio in spec["frequency_ratios"]]
    square += [
        (*one, "square", 1.0, gamma, ratio)
        for ratio, gamma in product(spec["frequency_ratios"], spec["mass_ratios"])
        for one in ((FIXED, IN_PLANE), *free)
    ]
    deep = [
        (IN_LINE, ACROSS, "square", depth, gamma, frequency)
        for gamma, depth in product(spec["mass_ratios"], spec["depths"])
    ]
    oblique = [
        (name, direction, "square", 1.0, gamma, frequency)
        for direction in spec["oblique"]
        for name, gamma in ((COLUMN, 0.0), *((SLAB, gamma) for gamma in spec["mass_ratios"]))
    ]
    cases = [(row, {}) for row in square + deep + oblique]
    cases += [((*one, "round", 1.0, light, frequency), {}) for one in free]
    again = [row for row in square if row[4:] == (heavy, frequency)]
    cases += product(again, spec["checks"])
    rows, of_column = [], {}
    for row, changed in cases:
        rows.append(first(row, changed, of_column.get(row[1], 0.0), settings, structures))
        if row[0] == COLUMN:
            of_column[row[1]] = rows[-1]["engine"]
    return pd.DataFrame(rows)


def first(row, changed, of_column, settings, structures):
    spec, (name, direction, section, depth, gamma, ratio) = settings["across"], row
    column = Column(**structures[spec["structure"]])
    cap = cap_of(settings["caps"][spec["structure"]])
    side = Column(depth * column.half_width, column.half_height)
    kind = {"shape": spec["shape"], "frequency_ratio": ratio}
    alone, theory = minimum(column, kind, column), RockingFrame(column, gamma)
    if name == FIXED or direction == ACROSS:
        theory = FixedMassColumn(side, gamma, 2.0 * side.half_width, 2.0 * cap.half_depth)
    solver = {"time_step": spec["time_step"], "friction": spec["friction"]} | changed
    bodies = Bodies(
        column,
        side.half_width,
        gamma,
        cap,
        in_row=1 if name in (COLUMN, FIXED) else 2,
        rows=2 if name == SLAB else 1,
        is_round=section == "round",
        is_fixed=name == FIXED,
        **solver,
    )
    uplift, step = theory.uplift_acceleration / alone.amplitude, spec["step"]
    expected = math.nan
    if section == "square" and direction in (IN_PLANE, ACROSS):
        expected = minimum(theory, kind, column).amplitude / alone.amplitude
    begin = max(uplift, np.nan_to_num(expected, nan=of_column) - BELOW * step)
    factors = step * np.arange(math.floor(begin / step), math.ceil(HIGHEST / step))
    lowest = next(f for f in factors if overturns(bodies, alone.scaled(f), direction))
    message = f"{row}, {changed}: from {lowest:.2f} on; expected {expected:.3f} within a step"
    check(lowest > factors[0] and not abs(lowest - expected) > 1.5 * step, message)
    numbers = {"uplift": uplift, "theory": expected, "engine": lowest}
    return dict(zip(LABELS, row, strict=True)) | solver | numbers


def findings(engine_restitution, engine_outcomes, engine_across):
    planar = engine_restitution[engine_restitution.solver == stones.VERSION]
    roots = (engine_restitution.engine / engine_restitution.theory - 1.0).abs()
    frequency = (planar.frequency_parameter_over_theory - 1.0).abs().max()
    loss = roots[planar.index].max()
    message = f"pymunk: p̂ is {frequency:.1e} from Eq. (23), √r {loss:.1e} from Eq. (25)"
    check(frequency < FREQUENCY and loss < RESTITUTION, message)
    agrees = engine_outcomes.engine == engine_outcomes.theory
    near = (engine_outcomes.factor - 1.0).abs() < FAR
    square = engine_across[engine_across.depth_over_width == 1.0]
    is_oblique = ~square.direction.isin([IN_PLANE, ACROSS])
    table, slab = square[~is_oblique], square[is_oblique & (square.structure == SLAB)]
    oblique = square[is_oblique & (square.structure == COLUMN)].set_index("direction").engine
    margin = slab.engine / slab.direction.map(oblique)
    alone = table[table.structure == COLUMN].set_index("frequency_ratio").engine
    gain = table.engine - table.frequency_ratio.map(alone)
    deep = engine_across[(engine_across.section == "square") & (engine_across.direction == ACROSS)]
    enough = deep[deep.engine >= deep.frequency_ratio.map(alone)].groupby("mass_ratio")
    weaker = table.direction == ACROSS
    stronger = table.structure.isin([IN_LINE, SLAB]) & ~weaker
    return {
        "free_rocking": truth(
            True, frequency=frequency, restitution=loss, mujoco=roots.drop(planar.index).max()
        ),
        "same_verdicts": truth(
            agrees.all(),
            holds_when=agrees[~near].all(),
            condition="their amplitude differs from the minimum by 3 % or more",
            pulses=len(agrees),
            agree=agrees.sum(),
        ),
        "across_the_plane": truth(
            gain[weaker].max() < 0.0 < min(gain[stronger].min(), margin.min() - 1.0),
            lowest=table.engine[weaker].min(),
            highest=table.engine[weaker].max(),
            lowest_of_slab=table.engine[table.structure == SLAB].min(),
            highest_of_slab=table.engine[table.structure == SLAB].max(),
            lowest_of_slab_in_theory=table.theory[table.structure == SLAB].min(),
            highest_of_slab_in_theory=table.theory[table.structure == SLAB].max(),
            least_oblique=margin.min(),
            most_oblique=margin.max(),
            enough_depths=enough.depth_over_width.min().to_list(),
            apart_from_theory=(engine_across.engine - engine_across.theory).abs().max(),
        ),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
