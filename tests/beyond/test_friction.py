"""Required friction: findings that break, and limits by hand."""

import numpy as np
import pandas as pd
import pytest

from steps.beyond import friction
from topheavy import Cap, Column, Pulse, RockingFrame

COLUMN, CAP = Column(0.5, 3.0), Cap(span=5.0, half_depth=0.5)
SETTINGS = {"samples": 8, "check_samples": 100, "sufficient": 0.7}


def sine(strength, ratio):
    """Return a pulse by its amplitude over the uplift acceleration and its ω/p."""
    omega = ratio * COLUMN.frequency_parameter
    return Pulse("one-sine", strength * COLUMN.uplift_acceleration, angular_frequency=omega)


def table(*rows):
    names = ["bay", "mass_ratio", "required", "least_vertical", "survived"]
    return pd.DataFrame([(*row, 10) for row in rows], columns=names)


@pytest.mark.parametrize(
    ("rows", "holds", "holds_when", "condition"),
    [
        ([(5.0, 0.2, 0.6, 0.1), (5.0, 1.0, 0.4, 0.1)], True, True, "γ ≥ 0.2 in the bay of 5 m"),
        ([(5.0, 0.2, 0.9, 0.1), (5.0, 1.0, 0.4, 0.1)], False, True, "γ ≥ 1 in the bay of 5 m"),
        ([(5.0, 0.2, 0.6, 0.1), (5.0, 1.0, 0.8, 0.1)], False, False, ""),
    ],
)
def test_friction_is_enough_from_the_heaviest_cap_beam_down(rows, holds, holds_when, condition):
    findings = friction.findings(table(*rows), SETTINGS)["friction_is_enough"]
    assert (findings["holds"], findings["holds_when"]) == (holds, holds_when)
    assert findings["condition"] == condition


def test_a_contact_that_would_have_to_pull_is_open():
    rows = [(0.0, 0.0, 0.2, 0.0), (5.0, 1.0, 0.4, -0.01)]
    assert not friction.findings(table(*rows), SETTINGS)["contacts_stay_closed"]["holds"]
    assert friction.findings(table(rows[0]), SETTINGS)["contacts_stay_closed"]["holds"]


def rows_under(frame, pulse):
    survived = friction.survived(frame, [pulse], SETTINGS["samples"])
    return [friction.required(frame, CAP, *case) for case in survived]


@pytest.mark.parametrize("gamma", [0.2, 4.0])
def test_required_friction_is_that_of_three_bodies_and_of_uplift_at_least(gamma):
    frame = RockingFrame(COLUMN, gamma)
    (row,) = rows_under(frame, sine(1.5, 4.0))
    assert row["required"] >= COLUMN.uplift_acceleration
    friction.compare(frame, CAP, row, SETTINGS)


def test_three_bodies_of_another_bay_disagree(monkeypatch):
    forces = friction.forces_at
    wider = lambda frame, cap, *motion: forces(frame, Cap(2.4, 0.5), *motion)  # noqa: E731
    monkeypatch.setattr(friction, "forces_at", wider)
    row = {"shape": "one-sine", "frequency_ratio": 4.0, "amplitude": 2.0}
    with pytest.raises(SystemExit, match="differs by"):
        friction.compare(RockingFrame(COLUMN, 1.0), CAP, row, SETTINGS)


def test_an_overturning_pulse_is_left_out_and_an_impact_counts():
    frame = RockingFrame(COLUMN, 1.0)
    assert not rows_under(frame, sine(20.0, 1.0))
    impact = friction.impact_impulses(frame, CAP, 1.0)
    (row,) = rows_under(frame, sine(1.1, 6.0))
    assert row["least_vertical"] <= impact.vertical.min() / impact.vertical[:2].sum()
    assert row["required"] >= float(np.max(impact.friction_demand))
