"""Contacts along quoted motions: which are named, and that wrong forces are noticed."""

import math

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from steps.beyond import contacts
from tests.cases import COLUMN, CONFIG, FRAME, broken

SETTINGS = CONFIG["contacts"]
CAP = contacts.cap_on(FRAME, SETTINGS, COLUMN.half_height)
PULSE = th.Pulse("one-sine", 0.3, angular_frequency=3.0)


def table(**changed):
    row = {"case": "minimum", "compared": "column and frame", "structure": "frame"}
    row |= {"least_vertical_base": 0.8, "friction_base": 0.3}
    row |= {"least_vertical_beam": 0.7, "friction_beam": 0.4} | changed
    pair = row | {"case": "two pulses 1", "least_vertical_beam": -0.4, "friction_beam": math.inf}
    return pd.DataFrame([row, pair])


MAPS = pd.DataFrame(
    {
        "slenderness_deg": [5.0, 20.0],
        "pressed": [1.0, 0.5],
        "prevented": 0.2,
        "prevented_pressed": [0.2, 0.1],
    }
    | {"caused": 0.02, "caused_pressed": [0.02, 0.0]}
)


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({}, set()),
        ({"least_vertical_base": -0.1}, {"contacts_stay_pressed"}),
        ({"friction_beam": 0.8}, {"friction_is_sufficient"}),
    ],
)
def test_case_whose_contacts_part_or_slide_is_named(changed, expected):
    found = contacts.findings(table(**changed), MAPS, SETTINGS)
    assert broken(found) - {"two_pulses_stay_pressed"} == expected
    for name in expected:
        assert found[name]["cases"] == "minimum (column and frame)"
    assert "two_pulses_stay_pressed" in broken(found)
    assert found["maps_pressed"]["value"] == pytest.approx(0.75)
    assert found["maps_pressed"]["stockiest"] == 0.5
    assert found["maps_caused"]["value"] == pytest.approx(0.5)


def test_row_holds_the_extremes_of_all_contacts_until_alpha_and_at_impacts():
    row = contacts.row_of(FRAME, CAP, PULSE)
    response = th.simulate(FRAME, PULSE, samples=20_000)
    forces = th.contact_forces(FRAME, CAP, response, PULSE, until_alpha=True)
    tops = forces.vertical.sel(contact=["top_left", "top_right"])
    assert row["least_vertical_beam"] == pytest.approx(float(tops.min()) / 0.25, abs=1e-3)
    assert row["friction_beam"] == pytest.approx(
        float(forces.required_friction[2:].max()), abs=1e-4
    )
    column = contacts.row_of(COLUMN, None, PULSE)
    assert math.isnan(column["least_vertical_beam"])
    assert 0.0 < column["least_vertical_base"] < 1.0


def test_forces_of_another_motion_are_noticed(monkeypatch):
    contacts.check_row(FRAME, CAP, PULSE)
    solve = contacts.plain.simulate
    monkeypatch.setattr(
        contacts.plain,
        "simulate",
        lambda structure, pulse, **more: solve(structure, pulse.scaled(1.1), **more),
    )
    with pytest.raises(SystemExit, match="vertical forces differ"):
        contacts.check_row(FRAME, CAP, PULSE)


def test_cell_of_a_map_has_the_least_force_of_its_history():
    pulses = [
        th.Pulse("one-sine", amplitude, angular_frequency=4.0) for amplitude in (0.3, 0.6, 2.5)
    ]
    for structure, cap in ((COLUMN, None), (FRAME, CAP)):
        least, fell = contacts.of_cells(structure, cap, pulses)
        rows = [contacts.row_of(structure, cap, pulse) for pulse in pulses]
        exact = [
            np.nanmin([row[f"least_vertical_{side}"] for side in contacts.SIDES]) for row in rows
        ]
        np.testing.assert_allclose(least, exact, atol=0.05)
        assert fell.tolist() == [row["outcome"] == "overturned" for row in rows]
