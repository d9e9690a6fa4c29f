"""Test whether each printed equation of the paper follows from its premises."""

from dataclasses import asdict

import pandas as pd

from replication.workbench import Finding, run, truth
from topheavy.derivation import check_printed, theorems

JUDGED = (
    "m_c_is_the_mass_of_each_column",
    "cap_moment_is_not_needed",
    "quadratic_terms_cancel",
    "lagrange_agrees",
    "frame_rocks_as_a_column",
    "ground_to_the_right_rocks_to_the_left",
    "frame_uplifts_with_its_column",
    "energy_is_conserved_between_impacts",
    "restoring_moment_falls",
    "kinetic_energy_ratio_is_velocity_ratio_squared",
    "restitution_is_below_the_columns",
    "impact_never_adds_energy",
    "fixed_mass_lowers_the_uplift_acceleration",
    "base_shear_grows_after_uplift",
    "heavy_cap_beam_nearly_caps_the_base_shear",
)


def main() -> tuple[pd.DataFrame, pd.DataFrame, dict]:
    checks = pd.DataFrame([asdict(check) for check in check_printed()])
    proved = {theorem.id: theorem.holds for theorem in theorems()}
    table = pd.DataFrame(proved.items(), columns=["theorem", "holds"])
    return checks, table, findings(checks, table)


def findings(equations: pd.DataFrame, theorems: pd.DataFrame) -> dict[str, Finding]:
    """Return what holds as printed or as meant, from the tables of equations and theorems.

    Theorems that rows judge have a finding each; of the others, all have to hold.
    """
    proved = theorems.set_index("theorem").holds
    printed = equations.astype(object).where(equations.notna(), None)
    of_equations = {
        check.id: truth(
            check.follows,
            meant_holds=None if check.follows else bool(check.meant_follows and check.fault),
            kind=check.fault or None,
            mended=check.mended or None,
        )
        for check in printed.itertuples()
    }
    of_theorems = {name: truth(proved[name]) for name in JUDGED}
    fails = proved.index[~proved.astype(bool)]
    return of_equations | of_theorems | {"theorems_hold": truth(fails.empty, fails=list(fails))}


if __name__ == "__main__":
    run(snakemake, lambda job: main())
