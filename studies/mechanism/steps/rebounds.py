"""Compare the rebound of a frame in the rigid-body engine with Eq. (25)."""

import pandas as pd

from replication.workbench import Finding, truth
from studies.mechanism.steps.engine import point_restitution
from studies.mechanism.steps.rigs import STEPS_IN_CONTACT, experiment, models, rebound, rig_of
from topheavy import Cap

CLOSE = 0.005  # of √r: agreement with Eq. (25)
PLASTIC = 0.2  # restitution of a point mass, below which a contact is without rebound
HARD = 0.01  # over p: a contact that is over within this is called hard


def main(settings: dict, structures: dict, caps: dict[str, Cap]) -> tuple[pd.DataFrame, dict]:
    """Return the rebound at the first impact against the damping of the contacts, and Eq. (25).

    The time step resolves both the time constant and the period of the contact. Each row also
    contains the restitution of a point mass with the same spring and damper.
    """
    rows = []
    for model in models(settings["frames"], structures, caps):
        rotation = settings["lean"] * model.frame.slenderness
        for ratio in settings["damping_ratios"]:
            for constant in settings["time_constants"]:
                step = constant * min(1.0, ratio) / STEPS_IN_CONTACT
                contact = {"time_constant": constant, "damping_ratio": ratio}
                found = rebound(rig_of(model, step, **contact), rotation)
                rows.append(
                    {
                        "structure": model.name,
                        "mass_ratio": model.frame.mass_ratio,
                        "damping_ratio": ratio,
                        "time_constant": constant,
                        "point_restitution": point_restitution(ratio),
                        "rebound": found,
                        "theory": model.frame.restitution,
                        "difference": found / model.frame.restitution - 1.0,
                    }
                )
    table = pd.DataFrame(rows)
    table["plastic"] = (table.point_restitution < PLASTIC) & (table.time_constant <= HARD)
    return table, findings(table)


def findings(mechanism_rebounds: pd.DataFrame) -> dict[str, Finding]:
    """Return how far rebounds are from Eq. (25), from their table."""
    table = mechanism_rebounds
    frames, alone = table[table.mass_ratio > 0.0], table[table.mass_ratio == 0.0]
    plastic, bouncing = frames[frames.plastic], frames[frames.point_restitution >= PLASTIC]
    hard = table[table.time_constant <= HARD]
    evidence = {
        "plastic_apart": plastic.difference.abs().max(),
        "bouncing_least": bouncing.difference.min(),
        "bouncing_largest": bouncing.difference.max(),
        "soft_least": frames[frames.time_constant > HARD].difference.min(),
        "column_apart": alone[alone.time_constant <= HARD].difference.abs().max(),
        "contacts": len(table),
    }
    return {
        "energy_of_eq25": truth(
            frames.difference.abs().max() < CLOSE,
            holds_when=plastic.difference.abs().max() < CLOSE,
            condition="the contacts are hard and do not rebound",
            **evidence,
        ),
        "maximum_restitution": truth(
            table.difference.max() < CLOSE,
            holds_when=hard.difference.max() < CLOSE,
            condition="the contacts are hard",
            largest_of_hard=hard.difference.max(),
            largest_of_soft=table.difference.max(),
        ),
    }


if __name__ == "__main__":
    experiment(snakemake, main)
