"""Where a frame rocks as the paper takes it: nothing slides, and no contact has to pull."""

import math

import numpy as np
import pandas as pd

from replication.workbench import grid, run, truth, value
from steps.histories import history
from studies.mechanism.steps.demand import demand
from studies.mechanism.steps.setting import cap_of, pulse_on
from topheavy import Cap, Column, RockingFrame
from topheavy.three_bodies import simulate_three_bodies

HALVINGS = 14  # of the bracket of an amplitude, a step of the grid at first
FINER = 8  # times as many samples where a threshold is looked for
BESIDE = 1e-3  # of an amplitude: how near to a threshold the second route is asked
ROUNDING = 1e-9  # of tan α, and of the weight


def cells(frame: RockingFrame, cap: Cap, case: dict, amplitudes: np.ndarray) -> list[dict]:
    """Return what every pulse asks of the contacts, demands over tan α."""
    tan, rows = frame.uplift_acceleration, []
    for ratio in grid(case["frequency_ratios"]):
        for amplitude in amplitudes:
            pulse = pulse_on(
                frame.column, {"shape": case["shape"], "frequency_ratio": ratio}, amplitude
            )
            found = demand(frame, cap, history(frame, pulse, case["samples"]))
            rows.append(
                {
                    "mass_ratio": frame.mass_ratio,
                    "frequency_ratio": ratio,
                    "amplitude": amplitude,
                    "demand": found.whole / tan,
                    "demand_error": found.friction_error / tan,
                    "least_vertical": found.least,
                    "least_error": found.least_error,
                    "pulls": found.pulls,
                    "overturned": found.outcome == "overturned",
                    "impacts": found.impacts,
                }
            )
    return rows


def first_pull(frame: RockingFrame, cap: Cap, case: dict, table: pd.DataFrame) -> dict:
    """Return the lowest amplitude of the map at which a contact opens, and its ω/p."""
    starts = table[table.pulls].sort_values(["amplitude", "frequency_ratio"])
    if starts.empty:
        return {}
    ratio = float(starts.frequency_ratio.iloc[0])
    spec = {"shape": case["shape"], "frequency_ratio": ratio}

    def pulls(amplitude: float) -> bool:
        course = history(frame, pulse_on(frame.column, spec, amplitude), FINER * case["samples"])
        return demand(frame, cap, course).least < 0.0

    at = table[table.frequency_ratio == ratio].amplitude
    high = float(starts.amplitude.iloc[0])
    low = float(at[at < high].max())
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if pulls(middle) else (middle, high)
    agrees = all(
        (_least_by_newton_euler(frame, cap, spec, amplitude) < 0.0) == pulled
        for amplitude, pulled in ((low * (1 - BESIDE), False), (high * (1 + BESIDE), True))
    )
    return {"amplitude": 0.5 * (low + high), "error": high - low, "at": ratio, "agrees": agrees}


def _least_by_newton_euler(frame: RockingFrame, cap: Cap, spec: dict, amplitude: float) -> float:
    """Return the least vertical reaction, N for columns of 1 kg, until |θ| passes α for good."""
    pulse = pulse_on(frame.column, spec, amplitude)
    found = simulate_three_bodies(
        frame,
        pulse,
        span=cap.span,
        cap_depth=2.0 * cap.half_depth,
        duration=float(history(frame, pulse, 1).time[-1, -1]),
    )
    return float(np.nanmin(found.forces[:, :, 1]))


def lightest_without_sliding(survived: pd.DataFrame, friction: float) -> float:
    """Return the least γ > 0 above which no frame requires more than this friction (over tan α).

    Infinite where the heaviest does.
    """
    largest = survived[survived.mass_ratio > 0.0].groupby("mass_ratio").demand.max()
    lightest = math.inf
    for gamma, needed in largest[::-1].items():
        if needed > friction:
            break
        lightest = float(gamma)
    return lightest


def main(case: dict, cap: Cap) -> tuple[pd.DataFrame, dict]:
    column = Column(**case["column"])
    spec, tan = case["amplitudes"], column.uplift_acceleration
    amplitudes = np.geomspace(spec["lowest"], spec["highest"], spec["points"])
    frames = [RockingFrame(column, gamma) for gamma in case["mass_ratios"]]
    table = pd.DataFrame([row for frame in frames for row in cells(frame, cap, case, amplitudes)])
    table["pulls"] = table.pulls & (table.least_vertical < -ROUNDING)  # γ = 0: no cap beam
    survived = table[~table.overturned]
    most = survived.loc[survived.demand.idxmax()]
    share = {
        friction: {
            f"{gamma:g}": float((part.demand * tan <= friction).mean())
            for gamma, part in survived.groupby("mass_ratio")
        }
        for friction in case["frictions"]
    }
    enough_from = lightest_without_sliding(survived, max(case["frictions"]) / tan)
    slides = survived.demand * tan > max(case["frictions"])
    findings = {
        "uplift_needs_tan": truth(bool((table.demand >= 1.0 - ROUNDING).all()), cells=len(table)),
        "friction_is_enough": truth(
            not slides.any(),
            holds_when=enough_from < math.inf,
            condition=f"γ is {enough_from:g} or more",
            friction=max(case["frictions"]),
            from_mass_ratio=enough_from if enough_from < math.inf else None,
            tan=tan,
            share_that_rocks_at={str(friction): by for friction, by in share.items()},
            share_that_slides_at_all=float(slides.mean()),
            largest_demand=float(most.demand * tan),
            largest_error=float(survived.demand_error.max() * tan),
        ),
        "stays_on_its_seats": truth(
            not survived.pulls.any(),
            survived=len(survived),
            least_over_weight=float(survived[survived.mass_ratio > 0.0].least_vertical.min()),
            share_that_pulls={
                f"{gamma:g}": float(part.pulls.mean())
                for gamma, part in survived.groupby("mass_ratio")
            },
        ),
    }
    for frame in frames:
        found = first_pull(frame, cap, case, table[table.mass_ratio == frame.mass_ratio])
        if found:
            findings[f"first_pull_{frame.mass_ratio:g}"] = value(
                found["amplitude"],
                found["error"],
                "g tan α",
                at=found["at"],
                second_route_agrees=found["agrees"],
            )
    return table, findings


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.case, cap_of(job.params.cap)))
