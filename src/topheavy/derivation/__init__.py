"""The paper's derivation by computer algebra, and a test of every equation as it is printed.

Geometry, Newton–Euler for the three bodies and impulse–momentum at impact give the frame's
equation of motion, its equivalent size and its √r; Lagrange's equation gives the motion again.
"""

from topheavy.derivation.contact import contact_forces, contact_impulses
from topheavy.derivation.equilibrium import (
    column_motion,
    equation_of_motion,
    frame_motion,
    frequency_ratio,
    quadratic_terms,
    size_ratio,
    uplift_acceleration,
)
from topheavy.derivation.fixed_mass import (
    fixed_fourth_power,
    fixed_motion,
    fixed_restitution,
    fixed_tangent,
)
from topheavy.derivation.geometry import CapMotion, cap_contact, cap_motion, centre
from topheavy.derivation.impact import (
    column_restitution,
    energy_slenderness,
    largest_slenderness,
    restitution,
)
from topheavy.derivation.lagrange import kinetic_energy, lagrange_equation, potential_energy
from topheavy.derivation.notation import NEGATIVE, POSITIVE, SIDES, Side
from topheavy.derivation.theorem import (
    Theorem,
    contact_theorems,
    extension_theorems,
    reversal_theorems,
    stated,
    theorems,
)
from topheavy.derivation.verdicts import PrintedCheck, check_printed

__all__ = [
    "NEGATIVE",
    "POSITIVE",
    "SIDES",
    "CapMotion",
    "PrintedCheck",
    "Side",
    "Theorem",
    "cap_contact",
    "cap_motion",
    "centre",
    "check_printed",
    "column_motion",
    "column_restitution",
    "contact_forces",
    "contact_impulses",
    "contact_theorems",
    "energy_slenderness",
    "equation_of_motion",
    "extension_theorems",
    "fixed_fourth_power",
    "fixed_motion",
    "fixed_restitution",
    "fixed_tangent",
    "frame_motion",
    "frequency_ratio",
    "kinetic_energy",
    "lagrange_equation",
    "largest_slenderness",
    "potential_energy",
    "quadratic_terms",
    "restitution",
    "reversal_theorems",
    "size_ratio",
    "stated",
    "theorems",
    "uplift_acceleration",
]
