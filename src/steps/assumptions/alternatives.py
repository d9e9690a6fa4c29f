"""The alternatives of paper/assumptions.yaml, with the numbers of config/config.yaml."""

from steps.assumptions.choices import (
    Choices,
    after,
    beyond_slenderness,
    curved,
    held,
    solitary_restitution,
)
from steps.shared.peak_forces import GUIDED, PINNED, RIGID


def alternatives(settings: dict) -> dict[str, dict[str, Choices]]:
    """Return every alternative, by its assumption and its own name in the ledger."""
    root, wait = settings["restitution"], settings["wait"]
    return {
        "gravity": {name: Choices(gravity=g) for name, g in settings["gravity"].items()},
        "masses": {
            name: Choices(masses=(mass["cap"], mass["columns"]))
            for name, mass in settings["masses"].items()
        },
        "section": {
            name: Choices(section=section) for name, section in settings["section"].items()
        },
        "restitution": {
            "fixed": Choices(restitution=lambda structure: root["fixed"]),
            "solitary": Choices(restitution=solitary_restitution),
            "lower": Choices(restitution=lambda s: root["lower"] * s.restitution),
            "higher": Choices(restitution=lambda s: min(1.0, root["higher"] * s.restitution)),
        },
        "allen_impact": {
            "exact_frames": Choices(massless_restitution=lambda frame: frame.restitution),
            "housners": Choices(massless_restitution=solitary_restitution),
        },
        "equation": {"linearised": Choices(linearised=True)},
        "pulse_start": {name: Choices(ramp=share) for name, share in settings["ramp"].items()},
        "table_start": {
            "smooth": Choices(table_starts=(0.0,)),
            "abrupt": Choices(table_starts=(1.0,)),
        },
        "end": {
            "flat_at_once": Choices(overturned=after(0.0)),
            "flat_in_time": Choices(overturned=after(wait["short"])),
            "flat_at_last": Choices(overturned=after(wait["long"])),
            "beyond_at_once": Choices(overturned=after(0.0, beyond=1.0)),
        },
        "overturning": {"beyond": Choices(overturned=beyond_slenderness)},
        "record": {"held": Choices(resampled=held), "curved": Choices(resampled=curved)},
        "held_frame": {
            "cantilevers": Choices(held=(PINNED, RIGID)),
            "portal": Choices(held=(GUIDED, RIGID)),
            "flexible": Choices(held=(PINNED, settings["held"]["flexible"])),
        },
        "stable": {"pulse_by_pulse": Choices(sense="pulse"), "lowest": Choices(sense="lowest")},
    }
