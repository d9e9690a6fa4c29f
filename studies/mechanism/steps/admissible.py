"""Where a frame rocks as the paper takes it: nothing slides, and no contact has to pull."""

import math

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth
from steps.shared.histories import history
from studies.mechanism.steps.demand import demand
from studies.mechanism.steps.setting import cap_of, pulse_on
from topheavy import Cap, Column, RockingFrame
from topheavy.second.three_bodies import simulate_three_bodies

HALVINGS = 14  # of the bracket of an amplitude, a step of the grid at first
FINER = 8  # times as many samples where a threshold is looked for
BESIDE = 1e-3  # of an amplitude: how near to a threshold the second route is asked
ROUNDING = 1e-9  # of tan α, and of the weight


def cells(frame: RockingFrame, cap: Cap, settings: dict, amplitudes: np.ndarray) -> list[dict]:
    """Return what every pulse asks of the contacts, demands over tan α."""
    tan, rows = frame.uplift_acceleration, []
    for ratio in grid(settings["frequency_ratios"]):
        for amplitude in amplitudes:
            pulse = pulse_on(
                frame.column, {"shape": settings["shape"], "frequency_ratio": ratio}, amplitude
            )
            found = demand(frame, cap, history(frame, pulse, settings["samples"]))
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


def first_pull(frame: RockingFrame, cap: Cap, settings: dict, table: pd.DataFrame) -> dict:
    """Return the lowest amplitude of the map at which a contact opens, and its ω/p."""
    starts = table[table.pulls].sort_values(["amplitude", "frequency_ratio"])
    if starts.empty:
        return {}
    ratio = float(starts.frequency_ratio.iloc[0])
    spec = {"shape": settings["shape"], "frequency_ratio": ratio}

    def pulls(amplitude: float) -> bool:
        course = history(
            frame, pulse_on(frame.column, spec, amplitude), FINER * settings["samples"]
        )
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
    return {"first_pull": 0.5 * (low + high), "error": high - low, "at": ratio, "agrees": agrees}


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


def _by_mass_ratio(table: pd.DataFrame, settings: dict) -> pd.DataFrame:
    """Return a row for each γ: what its pulses ask of the contacts, demands over tan α.

    `keeps_…` is the share of survived pulses for which this coefficient of friction is enough.
    """
    tan, rows = Column(**settings["column"]).uplift_acceleration, []
    for gamma, cells in table.groupby("mass_ratio"):
        survived = cells[~cells.overturned]
        row = {
            "mass_ratio": gamma,
            "tan": tan,
            "pulses": len(cells),
            "survived": len(survived),
            "least_demand": cells.demand.min(),
            "largest_demand": survived.demand.max(),
            "demand_error": survived.demand_error.max(),
            "least_vertical": survived.least_vertical.min(),
            "share_that_pulls": float(survived.pulls.mean()),
        }
        keeps = {f"keeps_{f}": (survived.demand * tan <= f).mean() for f in settings["frictions"]}
        rows.append(row | keeps)
    return pd.DataFrame(rows)


def lightest_without_sliding(rows: pd.DataFrame, friction: float) -> float:
    """Return the least γ > 0 above which no frame requires more than this friction (over tan α).

    Infinite where the heaviest does.
    """
    largest = rows[rows.mass_ratio > 0.0].set_index("mass_ratio").largest_demand
    lightest = math.inf
    for gamma, needed in largest[::-1].items():
        if needed > friction:
            break
        lightest = float(gamma)
    return lightest


def main(settings: dict, cap: Cap) -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    column = Column(**settings["column"])
    spec = settings["amplitudes"]
    amplitudes = np.geomspace(spec["lowest"], spec["highest"], spec["points"])
    frames = [RockingFrame(column, gamma) for gamma in settings["mass_ratios"]]
    table = pd.DataFrame(
        [row for frame in frames for row in cells(frame, cap, settings, amplitudes)]
    )
    table["pulls"] = table.pulls & (table.least_vertical < -ROUNDING)  # γ = 0: no cap beam
    pulls = [
        {"mass_ratio": frame.mass_ratio} | found
        for frame in frames
        if (found := first_pull(frame, cap, settings, table[table.mass_ratio == frame.mass_ratio]))
    ]
    none = pd.DataFrame(columns=["mass_ratio", "first_pull", "error", "at", "agrees"])
    rows = _by_mass_ratio(table, settings).merge(pd.DataFrame(pulls) if pulls else none, how="left")
    return table, rows, findings(rows)


def findings(mechanism_admissible_by_mass: pd.DataFrame) -> dict[str, Finding]:
    """Return where nothing slides and nothing opens, from the table of demands over γ."""
    rows = mechanism_admissible_by_mass
    tan, keeps = rows.tan[0], rows.filter(regex="^keeps_")
    frictions = {name: float(name.removeprefix("keeps_")) for name in keeps}
    most = rows.loc[rows.largest_demand.idxmax()]
    enough_from = lightest_without_sliding(rows, max(frictions.values()) / tan)
    slides = (rows.survived * (1.0 - keeps[max(frictions, key=frictions.get)])).round().sum()
    pulls = rows.dropna(subset="first_pull")
    return {
        "uplift_needs_tan": truth(
            (rows.least_demand >= 1.0 - ROUNDING).all(), cells=int(rows.pulses.sum())
        ),
        "friction_is_enough": truth(
            most.largest_demand * tan <= min(frictions.values()),
            holds_when=enough_from < math.inf,
            condition=f"γ is {enough_from:g} or more",
            friction=max(frictions.values()),
            from_mass_ratio=enough_from if enough_from < math.inf else None,
            tan=tan,
            share_that_rocks_at={
                f"{friction}": _over_mass_ratio(rows, name) for name, friction in frictions.items()
            },
            share_that_slides_at_all=float(slides / rows.survived.sum()),
            largest_demand=float(most.largest_demand * tan),
            largest_error=float(rows.demand_error.max() * tan),
        ),
        "stays_on_its_seats": truth(
            not rows.share_that_pulls.any(),
            survived=int(rows.survived.sum()),
            least_over_weight=float(rows[rows.mass_ratio > 0.0].least_vertical.min()),
            share_that_pulls=_over_mass_ratio(rows, "share_that_pulls"),
        ),
        "first_pull": truth(
            pulls.agrees.all(),
            over_uplift=_over_mass_ratio(pulls, "first_pull"),
            largest_error=float(pulls.error.max()),
        ),
    }


def _over_mass_ratio(rows: pd.DataFrame, name: str) -> dict[str, float]:
    return {
        f"{gamma:g}": float(share) for gamma, share in zip(rows.mass_ratio, rows[name], strict=True)
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, cap_of(job.params.cap)))
