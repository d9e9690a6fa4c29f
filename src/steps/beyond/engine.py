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

RESTITUTION, FREQUENCY = 1e-3, 3e-4  # relative differences of √r and p̂ between pymunk and theory
FAR = 0.03  # relative distance from the minimum beyond which an amplitude is not near it
BELOW = 0.2  # steps below a known minimum at which the search for it in the engine starts
IN_PLANE, ACROSS = 0.0, 90.0  # directions of the ground motion, degrees
COLUMN, FIXED, IN_LINE, SLAB = "column", "fixed mass", "two in line", "2 × 2"
LABELS = "structure", "direction", "section", "depth_over_width", "mass_ratio", "frequency_ratio"


def compute(settings, structures):
    version = checked_version()
    return {
        "restitution": pd.DataFrame(restitution(settings, structures, version)),
        "outcomes": pd.DataFrame(outcomes(settings, structures, version)),
        "across": across(settings, structures).assign(solver=version),
    }


def planar(frame, cap, spec):
    """Return a column or a frame in its plane for MuJoCo, as deep as a column is wide."""
    column, in_row = frame.column, 2 if frame.mass_ratio else 1
    shape = {"in_row": in_row, "is_planar": True, "friction": spec["friction"]}
    return Bodies(column, column.half_width, frame.mass_ratio, cap, spec["time_step"], **shape)


def planar_frames(settings, spec, structures, version):
    """Yield for each γ of each entry the entry, its labels, the frame, and its engines.

    An engine is a module, the frame in it, and its time step (s), by the name of the solver.
    """
    chosen = settings["mujoco"]
    for entry in spec["frames"]:
        name, column = entry["structure"], Column(**structures[entry["structure"]])
        cap = cap_of(settings["caps"][name])
        for gamma in entry["mass_ratios"]:
            rig = Stones(column, gamma, cap, spec["time_step"], friction=spec["friction"])
            engines = {stones.VERSION: (stones, rig, rig.time_step)}
            frame = RockingFrame(column, gamma)
            if (name, gamma) == (chosen["structure"], chosen["mass_ratio"]):
                bodies = planar(frame, cap, chosen)
                engines[version] = rigid_bodies, bodies, bodies.seconds
            yield entry, {"structure": name, "mass_ratio": gamma}, frame, engines


def restitution(settings, structures, version):
    """Yield p̂ and √r of each impact in free rocking, in engine and theory, Eqs. (23) and (25)."""
    spec = settings["restitution"]
    for entry, labels, frame, engines in planar_frames(settings, spec, structures, version):
        rotation, count = spec["lean"] * frame.slenderness, entry["impacts"]
        impacts = simulate(frame, rotation=rotation, samples=2).impact_times
        for solver, (engine, rig, time_step) in engines.items():
            rotations = engine.released(rig, rotation, impacts[count])
            time, roots = free_rocking(rotations, time_step, frame.column)
            for impact, root in enumerate(roots[:count], 1):
                yield (
                    {"solver": solver}
                    | labels
                    | {
                        "impact": impact,
                        "time_step": time_step,
                        "frequency_parameter_over_theory": impacts[0] / time,
                        "engine": root,
                        "theory": frame.restitution,
                    }
                )


def outcomes(settings, structures, version):
    """Yield the outcomes in engine and theory near the minimum overturning acceleration."""
    spec = settings["outcomes"]
    for _, labels, frame, engines in planar_frames(settings, spec, structures, version):
        for kind in spec["pulses"]:
            pulse = minimum(frame, kind)
            for (solver, (engine, rig, _)), factor in product(engines.items(), spec["factors"]):
                yield (
                    {"solver": solver}
                    | labels
                    | kind
                    | {
                        "factor": factor,
                        "engine": engine.overturns(rig, pulse.scaled(factor)),
                        "theory": judge(frame, pulse.scaled(factor)).overturned,
                    }
                )
            engines.pop(version, None)  # under the first pulse only


def minimum(frame, kind, column=None):
    """Return the pulse of the minimum in theory; ω is over p of the frame's or a given column."""
    pulse = pulse_on(column or frame.column, **kind)
    return replace(pulse, amplitude=lowest(frame, pulse).factor)


def across(settings, structures):
    """Return the lowest amplitude that overturns each structure, in its plane and across it.

    All accelerations are normalised by the theoretical minimum of the square column. `theory` is
    by the equation of rocking; round columns and oblique directions have none (NaN). There the
    search starts just below the amplitude that overturns the single column in the same
    direction, if that was computed.
    """
    spec, frames = settings["across"], [(IN_LINE, IN_PLANE), (IN_LINE, ACROSS), (SLAB, IN_PLANE)]
    gammas, ratios = spec["mass_ratios"], spec["frequency_ratios"]
    ratio, (light, *_, heavy) = ratios[0], gammas
    square = [(COLUMN, IN_PLANE, "square", 1.0, 0.0, ratio) for ratio in ratios]
    square += [
        (*structure, "square", 1.0, gamma, ratio)
        for ratio, gamma, structure in product(ratios, gammas, [(FIXED, IN_PLANE), *frames])
    ]
    rows = square + [
        (IN_LINE, ACROSS, "square", depth, gamma, ratio)
        for gamma, depth in product(gammas, spec["depths"])
    ]
    rows += [
        (name, direction, "square", 1.0, gamma, ratio)
        for direction, (name, gamma) in product(
            spec["oblique"], [(COLUMN, 0.0), *product([SLAB], gammas)]
        )
    ]
    rows += [(*frame, "round", 1.0, light, ratio) for frame in frames]
    cases = [*product(rows, [{}])]
    cases += product([row for row in square if row[4:] == (heavy, ratio)], spec["checks"])
    table, of_column = [], {}
    for row, solver in cases:
        table.append(overturning(row, solver, of_column.get(row[1], 0.0), settings, structures))
        if row[0] == COLUMN:
            of_column[row[1]] = table[-1]["engine"]
    return pd.DataFrame(table)


def overturning(row, changed, of_column, settings, structures):
    """Return a row of the table with the lowest amplitude that overturns in the engine."""
    spec, (name, direction, section, depth, gamma, ratio) = settings["across"], row
    column = Column(**structures[spec["structure"]])
    cap = cap_of(settings["caps"][spec["structure"]])
    side = Column(depth * column.half_width, column.half_height)
    kind = {"shape": spec["shape"], "frequency_ratio": ratio}
    pulse, theory = minimum(column, kind, column), RockingFrame(column, gamma)
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
    uplift, step = theory.uplift_acceleration / pulse.amplitude, spec["step"]
    expected = math.nan
    if section == "square" and direction in (IN_PLANE, ACROSS):
        expected = minimum(theory, kind, column).amplitude / pulse.amplitude
    begin = max(uplift, np.nan_to_num(expected, nan=of_column) - BELOW * step)
    factors = step * np.arange(math.floor(begin / step), math.ceil(HIGHEST / step))
    factor = next(f for f in factors if overturns(bodies, pulse.scaled(f), direction))
    message = f"{row}, {changed}: overturns from {factor:.2f} on; expected {expected:.3f}"
    check(factor > factors[0] and not abs(factor - expected) > 1.5 * step, message)
    return dict(zip(LABELS, row, strict=True)) | solver | {"theory": expected, "engine": factor}


def findings(engine_restitution, engine_outcomes, engine_across):
    pymunk = engine_restitution[engine_restitution.solver.str.startswith("pymunk")]
    roots = (engine_restitution.engine / engine_restitution.theory - 1.0).abs()
    frequency = (pymunk.frequency_parameter_over_theory - 1.0).abs().max()
    loss = roots[pymunk.index].max()
    message = f"pymunk: p̂ is {frequency:.1e} from Eq. (23), √r {loss:.1e} from Eq. (25)"
    check(frequency < FREQUENCY and loss < RESTITUTION, message)
    agrees = engine_outcomes.engine == engine_outcomes.theory
    near = (engine_outcomes.factor - 1.0).abs() < FAR
    square = engine_across[engine_across.depth_over_width == 1.0]
    is_oblique = ~square.direction.isin([IN_PLANE, ACROSS])
    table, slab = square[~is_oblique], square[is_oblique & (square.structure == SLAB)]
    slabs = table[table.structure == SLAB]
    oblique = square[is_oblique & (square.structure == COLUMN)].set_index("direction").engine
    margin = slab.engine / slab.direction.map(oblique)
    columns = table[table.structure == COLUMN].set_index("frequency_ratio").engine
    gain = table.engine - table.frequency_ratio.map(columns)
    deep = engine_across[(engine_across.section == "square") & (engine_across.direction == ACROSS)]
    enough = deep[deep.engine >= deep.frequency_ratio.map(columns)].groupby("mass_ratio")
    weaker = table.direction == ACROSS
    stronger = table.structure.isin([IN_LINE, SLAB]) & ~weaker
    return {
        "free_rocking": truth(
            True, frequency=frequency, restitution=loss, mujoco=roots.drop(pymunk.index).max()
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
            lowest_of_slab=slabs.engine.min(),
            highest_of_slab=slabs.engine.max(),
            lowest_of_slab_in_theory=slabs.theory.min(),
            highest_of_slab_in_theory=slabs.theory.max(),
            least_oblique=margin.min(),
            most_oblique=margin.max(),
            enough_depths=enough.depth_over_width.min().to_list(),
            apart_from_theory=(engine_across.engine - engine_across.theory).abs().max(),
        ),
    }


if __name__ == "__main__":
    run(snakemake, compute, findings)
