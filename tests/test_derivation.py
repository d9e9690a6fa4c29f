"""The paper's algebra: equations as they are printed, and proofs that fail for what is false."""

import math
import re

import pytest
import sympy as sp

from derivation import (
    check_printed,
    colonnades,
    consequences,
    extensions,
    fixed_mass,
    guarantee,
    reversals,
    theorems,
)
from derivation.fixed_mass import (
    I_b,
    fixed_motion,
    fixed_restitution,
    fixed_tangent,
)
from derivation.notation import (
    NEGATIVE,
    N,
    R,
    alpha,
    g,
    gamma,
    ground_acceleration,
    half_depth,
    m_c,
    vertical_acceleration,
)
from derivation.printed import EQUATIONS, follows
from steps.beyond.colonnades import colonnade
from topheavy import STANDARD_GRAVITY, Column, FixedMassColumn

KINDS = {
    "eq9_positive": "sign",
    "eq19": "sign",
    "eq20": "sign",
    "eq21": "sign",
    "eq22": "sign",
    "text_p_hat": "radical",
    "text_p_hat_trilith": "bracket",
}


@pytest.fixture(scope="module")
def checks():
    printed = check_printed()
    named = {check.id: check for check in printed}
    assert len(named) == len(printed)
    return named


def test_every_equation_of_the_paper_is_there_and_named_once(checks):
    assert {check.equation for check in checks.values()} == {None, *range(1, 26)}
    assert all(re.fullmatch(r"[a-z][a-z0-9_]*", name) for name in checks)


def test_double_signs_are_tested_on_both_sides(checks):
    for number in range(4, 10):
        parts = [check.part for check in checks.values() if check.equation == number]
        assert parts == ["θ < 0", "θ > 0"]


SIGNS, BRACKETS = str.maketrans("", "", "+−±∓ "), str.maketrans("", "", "() ")


def test_these_and_no_other_discrepancies_are_found(checks):
    wrong = [check for check in checks.values() if not check.follows]
    assert {check.id: check.kind for check in wrong} == KINDS
    for check in wrong:
        assert check.meant_follows
        gone = BRACKETS if check.kind in ("bracket", "radical") else SIGNS
        assert check.printed.translate(gone) == check.meant.translate(gone)
        assert ("√" in check.printed) == (check.kind in ("bracket", "radical"))


@pytest.mark.sampled(6)
@pytest.mark.parametrize("statement", EQUATIONS, ids=lambda s: s.name)
def test_one_wrong_sign_anywhere_is_caught(statement):
    right = statement.meant or statement.printed
    places = list(re.finditer(r" [+−] ", right))
    for place in places:
        turned = " − " if place.group() == " + " else " + "
        wrong = right[: place.start()] + turned + right[place.end() :]
        assert not follows(wrong, statement.premises, statement.sides), wrong


@pytest.mark.parametrize(
    ("name", "right", "wrong"),
    [
        ("eq24", "(1 + γ/(1 + 2γ)) R", "(1 + γ/(1 + 3γ)) R"),  # its second form alone
        ("eq13", "F_x1 + F_x2", "F_x1 − F_x2"),
        ("eq13", "ü_g + ü", "ü_g ± ü"),  # right for θ < 0 alone
        ("eq16", "g + v̈", "g ± v̈"),
    ],
)
def test_no_member_and_no_side_is_left_out(name, right, wrong):
    (statement,) = (s for s in EQUATIONS if s.name == name)
    assert right in statement.printed
    spoilt = statement.printed.replace(right, wrong)
    assert not follows(spoilt, statement.premises, statement.sides)


def test_every_theorem_holds_and_is_stated():
    proofs = theorems()
    assert [proof.theorem for proof in proofs if not proof.holds] == []
    assert len({proof.theorem for proof in proofs}) == len(proofs)
    assert all(proof.statement.endswith(".") for proof in proofs)


def swapped(side):
    """The motion with a push that does not depend on the rotation."""
    return sp.sin(reversals._phi - alpha) - side.sign * reversals._a


def pushed_by_angle(side):
    return reversals._phi * (1 + reversals._a) - alpha


def doubled(side):
    """Twice the vertical acceleration."""
    return right(side).subs(vertical_acceleration, 2 * vertical_acceleration)


right = extensions.frame_of_columns
_SMALL = gamma * sp.sin(alpha) ** 4 / 50
_CAP = gamma * sp.sin(alpha) ** 2 / 50
REVERSALS = [
    ("exact", swapped, "mass_ratio_leaves_only_the_time_scale"),
    ("exact", swapped, "larger_rotation_feels_the_larger_push"),
    ("exact", swapped, "beyond_alpha_the_push_is_additive"),
    ("exact", swapped, "push_above_the_bound_reverses_the_order"),
    ("exact", swapped, "push_in_one_direction_only_helps_that_side"),
    ("linearised", pushed_by_angle, "difference_is_driven_by_the_heavier_frame"),
    ("linearised", pushed_by_angle, "difference_grows_under_vertical_acceleration"),
    ("frequency_ratio", lambda: 1 + gamma, "mass_ratio_leaves_only_the_time_scale"),
]
outward = guarantee.outward_acceleration
GUARANTEE = [
    *(
        ("outward_acceleration", lambda s: -outward(s), proof)
        for proof in (
            "ground_acceleration_drops_out",
            "level_does_not_rise_between_impacts",
            "linearised_level_does_not_rise",
        )
    ),
    *(
        ("LEVEL", guarantee.LEVEL + guarantee._Y**2 * guarantee._C**2, proof)
        for proof in (
            "level_does_not_rise_between_impacts",
            "level_at_alpha_is_the_limit",
            "vertical_acceleration_changes_the_level",
        )
    ),
    (
        "frequency_ratio",
        lambda: 1 / reversals.frequency_ratio(),
        "guaranteed_velocity_rises_with_mass",
    ),
    ("loss", lambda: 2 * guarantee.restitution(), "guaranteed_velocity_rises_with_mass"),
]
EXTENSIONS = [
    ("frame_of_columns", lambda s: N * right(s), "columns_count_only_in_the_mass_ratio"),
    ("restitution_of_columns", lambda s: sp.cos(2 * alpha), "impacts_do_not_count_the_columns"),
    ("frame_of_columns", doubled, "vertical_acceleration_is_a_change_of_gravity_and_push"),
    ("equation_of_motion", lambda s: sp.Eq(0, R * right(s)), "size_only_slows_time"),
    ("fixed_tangent", lambda: sp.tan(alpha), "frame_across_its_plane_is_a_fixed_mass"),
    ("_HEIGHT", 2 * extensions._HEIGHT, "deep_columns_uplift_in_the_plane_first"),
    (
        "cap_contact",
        lambda side: sp.Matrix([-side.sign * R * sp.sin(alpha), 2 * R * sp.cos(alpha)]),
        "level_cap_has_no_balance_across",
    ),
    ("PULSES", extensions.PULSES[::-1], "short_pulses_gain_by_the_order_of_their_moment"),
]


def of(module, name, spoil, proof):
    """A result of a module is spoilt wherever a proof takes it."""
    right = getattr(module, name)
    return (module, name, lambda *args, **kwargs: spoil(right(*args, **kwargs)), proof)


WRONG = [
    *((reversals, *row) for row in REVERSALS),
    *((extensions, *row) for row in EXTENSIONS),
    *((guarantee, *row) for row in GUARANTEE),
    of(guarantee, "restitution", lambda root: root + _SMALL, "loss_per_impact_is_stated"),
    *(
        of(fixed_mass, "fixed_tangent", lambda t, spoil=spoil: t * (1 + spoil), proof)
        for spoil, proof in (
            (gamma, "fixed_mass_lowers_the_uplift_acceleration"),
            (_CAP, "fixed_mass_rocks_as_one_column"),
        )
    ),
    *(
        of(colonnades, name, lambda value: value * (1 + gamma), proof)
        for name, proof in (
            ("lever_of", "stone_bears_between_axis_and_corner"),
            ("stone_tangent", "stones_lower_the_uplift_acceleration"),
            ("stone_motion", "stones_leave_the_frequency_parameter"),
            ("stone_restitution", "stones_change_the_loss_at_an_impact"),
        )
    ),
    of(
        consequences,
        "restitution_within",
        lambda root: root.subs(consequences._within, 1 / consequences._within),
        "impulses_inside_the_corners_lose_less",
    ),
    of(consequences, "size_ratio", lambda ratio: 1 / ratio, "size_grows_to_a_limit"),
    of(consequences, "quadratic_terms", lambda t: (t[0], 2 * t[1]), "quadratic_terms_cancel"),
    of(consequences, "potential_energy", lambda v: 2 * v, "energy_is_conserved_between_impacts"),
    *(
        of(consequences, "restitution", lambda r: r + _SMALL, proof)
        for proof in (
            "restitution_is_below_the_columns",
            "frame_rocks_on_below_its_largest_slenderness",
        )
    ),
]


@pytest.mark.parametrize(
    ("module", "name", "spoilt", "proof"), WRONG, ids=[f"{row[3]}-{row[1]}" for row in WRONG]
)
def test_proof_fails_for_what_is_false(monkeypatch, module, name, spoilt, proof):
    monkeypatch.setattr(module, name, spoilt)
    assert not getattr(module, proof)()


def values(body):
    """The body's lengths and masses in the symbols of the derivation, for a column of 1 kg."""
    column, ratio = body.column, body.mass_ratio
    spin = ratio * (body.cap_width**2 + body.cap_depth**2) / 12
    return {
        R: column.size,
        alpha: column.slenderness,
        g: STANDARD_GRAVITY,
        gamma: ratio,
        m_c: 1.0,
        half_depth: body.cap_depth / 2,
        I_b: spin,
    }


@pytest.mark.parametrize("ratio", [0.1, 4.0])
@pytest.mark.parametrize("columns", [3, 5])
def test_colonnade_of_the_step_follows_the_derivation(ratio, columns):
    column, width = Column(0.01, 3.0), 5.0
    numbers = {R: column.size, alpha: column.slenderness, gamma: ratio, colonnades.span: width}
    half = 0.01
    ends = [(-half, width, True), *[(0, width, False)] * (columns - 3), (0, width + half, False)]
    after = [float(colonnades.lever_of(x, y, covers=z).subs(numbers)) for x, y, z in ends]
    block = colonnade(column, ratio, columns, width)
    mean = numbers | {colonnades.lever: sum(after) / len(after)}
    tangent = float(colonnades.stone_tangent().subs(mean))
    assert block.uplift_acceleration == pytest.approx(tangent, rel=1e-12)
    square = sum(x * (x + y) for x, y in zip(after, after[::-1], strict=True)) / len(after)
    mean[colonnades.lever_before] = square / mean[colonnades.lever] - mean[colonnades.lever]
    loss = 1.0 - float(colonnades.stone_restitution().subs(mean))
    assert 1.0 - block.restitution == pytest.approx(loss, rel=1e-4)  # of slender columns


@pytest.mark.parametrize("slenderness", [0.05, 0.165, 0.6])
@pytest.mark.parametrize("ratio", [0.1, 1.0, 7.0])
@pytest.mark.parametrize("cap", [(0.0, 0.0), (2.6, 0.6)], ids=["concentrated", "rectangle"])
def test_library_follows_the_derivation(slenderness, ratio, cap):
    body = FixedMassColumn(Column(math.sin(slenderness), math.cos(slenderness)), ratio, *cap)
    lengths = values(body)
    tangent = float(fixed_tangent().subs(lengths))
    assert body.uplift_acceleration == pytest.approx(tangent, rel=1e-12)
    # θ̈ at rest is p'² sin α', and its derivative by |θ| is −p'² cos α'
    free = fixed_motion(NEGATIVE).subs(lengths | {ground_acceleration: 0})
    ends = (NEGATIVE.upright(x).evalf() for x in (free, sp.diff(free, NEGATIVE.rotation)))
    assert body.frequency_parameter**2 == pytest.approx(math.hypot(*ends), rel=1e-12)
    assert body.restitution == pytest.approx(float(fixed_restitution().subs(lengths)), rel=1e-12)
