"""Spectra, the fixed mass, verified outcomes and forces after uplift, in small cases."""

import math
from io import StringIO

import numpy as np
import pandas as pd
import pytest

import topheavy as th
from documents.check import REFERENCE
from replication.step import findings_text
from steps import proven, spectra, uplift, vase
from steps.shared import balls, cycles, falls, intervals, spectrum
from steps.shared.histories import history
from steps.shared.lobes import record_of, sine
from steps.shared.spectrum import FRAME, line, solve
from tests.cases import COLUMN, CONFIG, SIZES, as_written, broken
from tests.cases import FRAME as BENT
from topheavy.forces.members import base_shear_slope

PULSE = th.Pulse("one-cosine", 1.0, period=1.5)
TIGHT = 3e-12


def grid(lowest, highest, points):
    return {"lowest": lowest, "highest": highest, "points": points}


SPECTRA = CONFIG["spectra"] | {
    "slendernesses": [5.0],
    "shapes": ["one-cosine"],
    "mass_ratios": [0.0, 1.0, math.inf],
    "frequency_ratios": grid(1.25, 4.25, 13),
    "finer": {"below": 1.3, "resolution": 0.02},
    "cycles": CONFIG["spectra"]["cycles"] | {"numbers": [3], "frequency_ratios": grid(4.0, 5.0, 2)},
    "two_pulses": {
        "samples": 100,
        "cases": [CONFIG["spectra"]["two_pulses"]["cases"][0] | {"mass_ratios": [0.0, 0.1]}],
    },
    "sample": {"points": 6, "seed": 1},
}
RICKER = {"shapes": ["ricker-symmetric"]}
VASE = CONFIG["vase"] | {
    "mass_ratios": [0.0, 1.0, math.inf],
    "shapes": ["one-cosine"],
    "grids": [RICKER | {"mass_ratios": [1.0], "frequency_ratios": grid(2.0, 6.0, 2)}],
    "sample": 1,
}
UPLIFT = CONFIG["uplift"] | {
    "mass_ratios": [0.0, 1.0],
    "shapes": ["one-sine"],
    "frequency_ratios": grid(4.0, 8.0, 2),
    "amplitudes": [1.1, 3.0, 9.0],
    "sample": 1,
}


def unmet(computed):
    """Return the names of the findings that do not hold on their condition either."""
    return {name for name, finding in computed.items() if finding.get("holds_when") is False}


# Spectra -----------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def shards():
    parts = [spectrum.compute(SPECTRA, f"{number}-of-2") for number in (1, 2)]
    return {name: [part[name] for part in parts] for name in ("spectra", "cycles")}


@pytest.fixture(scope="module")
def tables(shards):
    several = [StringIO(text) for text in shards["cycles"]]
    return as_written(spectra.compute(shards["spectra"], several, SPECTRA, TIGHT))


def test_line_changes_what_its_label_says():
    column, whole, size, restitution = (
        line(change, gamma, 9.0, "one-sine", 2.0).block
        for change, gamma in ((FRAME, 0.0), (FRAME, 1.0), ("size", 1.0), ("restitution", 1.0))
    )
    assert size == whole.with_restitution(column.restitution)
    assert restitution == column.with_restitution(whole.restitution)


def test_sets_of_amplitudes():
    first, second = np.array([[1.0, 3.0], [4.0, 5.0]]), np.array([[2.0, 4.5]])
    assert intervals.length(first) == 3.0
    assert intervals.overlap(first, second) == 1.5
    assert intervals.without(first, second) == [(1.0, 2.0), (4.5, 5.0)]
    assert intervals.inside(second, np.array([1.9, 2.1])).tolist() == [False, True]


def test_shares_are_those_of_known_intervals():
    rows = [
        {"mass_ratio": gamma, "frequency_ratio": ratio, "lower": low, "upper": high}
        for ratio in (2.0, 3.0, 4.0)
        for gamma, low, high in ((0.0, 2.0, 3.0), (0.0, 4.0, np.nan), (1.0, 2.5, 3.5))
    ]
    labels = {"change": FRAME, "slenderness_deg": 14.0, "shape": "one-sine"}
    sets = spectra.Spectra(pd.DataFrame(rows).assign(**labels), 6.0)
    light, heavy = spectra.frames([0.0, 1.0])
    shares = sets.shares(light, heavy, (14.0, "one-sine"), 1)
    assert shares == pytest.approx((2.5 / 5.0, 0.5 / 5.0))
    assert [ratio for ratio, *_ in sets.rises([(light, heavy)])] == [1.25] * 3


KNOWN = {"heavier_is_more_stable", "frame_is_more_stable_than_its_column", "larger_is_more_stable"}
KNOWN |= {"heavier_or_larger_is_more_stable"}


def test_findings_of_spectra(tables):
    rest = {f"spectra_{name}": tables[name] for name in ("collapse", "cycles", "falls")}
    rest["settings"] = SPECTRA
    computed = spectra.findings(tables["spectra"], tables["areas"], **rest)
    assert broken(computed) == KNOWN
    assert not unmet(computed)
    assert computed["heavier_is_more_stable"]["width"] > 0.2
    prevented, caused = (computed[name]["value"] for name in ("prevented", "caused"))
    assert computed["prevented_over_caused"]["value"] == prevented / caused
    column = tables["spectra"].query("mass_ratio == 0")
    alike = pd.concat([column.assign(mass_ratio=gamma) for gamma in SPECTRA["mass_ratios"]])
    unchanged = spectra.findings(alike, tables["areas"], **rest)
    assert not unchanged["only_the_heavier_overturns"]["holds"]
    swapped = tables["spectra"].replace({"mass_ratio": {1.0: math.inf, math.inf: 1.0}})
    computed = spectra.findings(swapped, tables["areas"], **rest)
    assert broken(computed) - KNOWN == {"minimum_rises_with_mass", "never_caused_without_impact"}
    assert computed["heavier_is_more_stable"]["holds_when"] is False
    harmful = tables["areas"].rename(columns={"prevented": "caused", "caused": "prevented"})
    computed = spectra.findings(tables["spectra"], harmful, **rest)
    assert "prevents_more_than_it_causes" in broken(computed)
    alike = tables["areas"].assign(caused=0.01)
    assert "caused_by_the_size" in broken(spectra.findings(tables["spectra"], alike, **rest))


@pytest.mark.parametrize(("share", "expected"), [(0.13, 1.192916), (0.01, 1.344949)])
def test_minimum_narrower_than_the_resolution_is_sought_below_the_first(share, expected):
    settings = CONFIG["spectra"] | {"near": SPECTRA["near"] | {"share": share}}
    lines = [line("frame", 1.0, 14.0, "one-cosine", ratio) for ratio in (8.0, 1.5)]
    table = solve([lines], settings)
    assert table[table.frequency_ratio == 1.5].lower.min() == pytest.approx(expected, abs=1e-6)


def several(mass_ratios, ratio):
    cycles_of = SPECTRA["cycles"] | {"frequency_ratios": grid(ratio, ratio + 1.0, 1), "draws": 2}
    return {"slendernesses": [9.462322], "mass_ratios": mass_ratios, "cycles": cycles_of}


@pytest.mark.parametrize(
    ("ratio", "known"),
    [
        (3.75, {2.0: 2.1478, math.inf: 2.1004, 0.0: 1.555}),
        (4.0, {0.5: 2.1930, 1.0: 2.1612, 0.0: 1.683}),
        (4.125, {0.25: 2.220, 0.5: 2.191, 0.0: 1.717}),
    ],
)
def test_minimum_falls_under_three_cycles_of_a_sine(ratio, known):
    """The values are those of a code that shares no line with ours."""
    gammas = sorted(known)
    settings = several(gammas, ratio)
    table = as_written({"table": cycles.minima(settings)})["table"]
    assert table.lowest_found.to_list() == pytest.approx([known[mass] for mass in gammas], abs=5e-4)
    fell = as_written({"fell": cycles.falls(table, settings)})["fell"]
    result = cycles.finding(table, fell, settings)
    assert broken(result) == {"cycles_rise_with_mass"}
    assert findings_text(result, cycles.finding)  # raises where a number is infinite
    light, heavy = known[gammas[1]], known[gammas[2]]
    assert result["cycles_rise_with_mass"]["fall_3"] == pytest.approx(1.0 - heavy / light, abs=3e-4)
    assert 0.0 <= result["cycles_rise_with_mass"]["stays_3"] <= 1.0
    narrow = cycles.falls(table.assign(wide_minimum=math.inf, wide_upper=math.inf), settings)
    assert not broken(cycles.finding(table, narrow, settings))


def test_frame_falls_below_its_column_under_three_cycles_of_a_sine():
    settings = several([0.0, 0.25, math.inf], 4.4375)
    table = cycles.minima(settings)
    fell = cycles.falls(table, settings)
    computed = cycles.finding(table, fell, settings)
    assert broken(computed) == {"cycles_frame_is_above_its_column"}
    (row,) = [row for _, row in cycles.largest(fell, [(0.0, 0.25)]).iterrows()]
    with pytest.raises(SystemExit, match=r"heavier at 2\.1"):
        cycles.check_fall(row.replace(row.heavier_from, 2.1))


@pytest.mark.parametrize(
    ("gamma", "ratio", "narrow", "wide"),
    [(2.0, 3.75, (1.9281, 1.9302), 2.4773), (0.25, 4.0625, (1.8747, 1.8784), 2.4662)],
)
def test_interval_narrower_than_the_first_search_is_found(gamma, ratio, narrow, wide):
    """Of a code on a grid four times as fine."""
    block, pulse = cycles.one_line(5, 9.462322, ratio, gamma)
    (lowest,) = falls.lowest_of([block], [pulse], 3.0, 0.02)
    assert lowest.wide_lower == pytest.approx(wide, abs=1e-3)
    lowest = falls.searched_finely(block, pulse, lowest, 3.0, 0.02)
    assert (lowest.lower, lowest.upper) == pytest.approx(narrow, abs=1e-4)


def test_three_counts_of_a_fall_differ_where_an_interval_is_narrow():
    lighter = falls.Lowest(2.22, 2.237, 3.06, 3.3, falls.GRID)
    heavier = falls.Lowest(1.9, 1.901, 2.155, 2.183, falls.GRID)
    counts = falls.fall(lighter, heavier)
    assert counts == pytest.approx((1 - 2.155 / 2.22, 1 - 1.9 / 2.22, 1 - 2.155 / 3.06))
    none = falls.Lowest(*4 * [math.inf], falls.GRID)
    assert falls.fall(lighter, none).strict == -math.inf
    assert math.isnan(falls.fall(none, none).strict)


def test_motion_of_lobes_is_the_pulse_of_as_many_cycles():
    block, pulse = cycles.one_line(3, 9.462322, 4.0, 1.0)
    lobes = sine(6, math.pi / pulse.angular_frequency, pulse.amplitude)
    record = record_of(lobes, pulse.duration / 3000)
    np.testing.assert_allclose(record.acceleration, pulse.excitation(record.time), atol=1e-12)
    assert falls.lowest_of([block], [record], 2.5, 0.02)[0].lower == pytest.approx(2.1610, abs=1e-3)


def test_minima_of_two_pulses_are_those_of_another_code():
    """By a Runge–Kutta code on grids of 0.01 and 0.002: the first amplitudes that overturn."""
    table = cycles.two_pulses(SPECTRA)
    assert table.lowest_found.to_list() == pytest.approx([4.08, 2.048], abs=0.01)


def test_collapse_compares_the_frame_with_a_column_of_its_restitution(shards):
    table = spectra.collapse_of(spectra.Spectra(pd.concat(shards["spectra"]), 16.0))
    place = (5.0, "one-cosine", 2.0)
    block = line("restitution", math.inf, *place)
    (expected,) = table[table.ratio_to_p_hat == 2.0].frame
    assert judge_at(block, 1.001 * expected) > judge_at(block, 0.999 * expected)
    gap = table.assign(frame=1.1 * table.column)
    computed = spectra.apart(gap, 3.0, 0.9)
    assert computed["collapse_slow"]["value"] == pytest.approx(0.1)
    assert computed["collapse_fast"]["covered"] == pytest.approx(0.1)


def judge_at(case, factor):
    return th.judge(case.block, case.pulse.scaled(factor)).overturned


def test_sample_notices_wrong_intervals(shards):
    table = pd.concat(shards["spectra"])
    wrong = spectra.Spectra(table.assign(lower=1.02 * table.lower), 16.0)
    bands = wrong.bands([(spectra.frames([0.0])[0], spectra.frames([math.inf])[0])])
    with pytest.raises(SystemExit, match="the solvers say"):
        spectra.check_sample(wrong, bands, {"points": 20, "seed": 1}, TIGHT)


# The fixed mass ----------------------------------------------------------------------------------


def minimum(structure, pulse=PULSE, highest=2.0, floor=0.001):
    return vase.lowest(structure, pulse, highest, floor)


def test_minimum_is_the_known_one_and_the_plain_solver_agrees():
    fixed = th.FixedMassColumn(COLUMN, 1.0)
    lowest = minimum(fixed)
    assert lowest.factor == pytest.approx(0.20358, abs=1e-4)
    assert 0.0 < vase.errors_of([(fixed, PULSE, lowest)])[0] < 1e-6
    with pytest.raises(SystemExit, match="the plain solver does not find the minimum of Column"):
        vase.errors_of([(COLUMN, PULSE, lowest)])
    assert minimum(COLUMN, highest=0.15) is None  # below uplift
    assert minimum(COLUMN, highest=0.25) is None  # nothing overturns


def test_narrow_interval_above_uplift_is_not_missed():
    """Its width is less than the floor of the search."""
    slow = th.Pulse("one-cosine", 1.0, angular_frequency=0.55 * COLUMN.frequency_parameter)
    lowest = minimum(COLUMN, slow)
    finer = minimum(COLUMN, slow, floor=0.0001)
    assert lowest.factor == pytest.approx(finer.factor, abs=1e-8)
    (again,) = vase.lowest_by_two_floors([(COLUMN, slow)], 2.0, CONFIG["vase"])
    assert again.factor == pytest.approx(lowest.factor, abs=1e-8)
    assert lowest.width < 0.001 * COLUMN.uplift_acceleration
    assert vase.errors_of([(COLUMN, slow, lowest)])[0] < 1e-6


def test_wide_interval_is_the_lowest_in_which_all_steps_overturn(monkeypatch):
    step = 0.001
    ends = 0.2 + step * np.array([0.0, 1.5, 10.0, 13.5, 700.0, 720.5])  # across a call's end
    stub = lambda structure, motion, factors: np.searchsorted(ends, factors + 1e-9) % 2 == 1  # noqa: E731
    monkeypatch.setattr(vase, "overturned_by", stub)
    begins = [vase.lowest_wide(COLUMN, PULSE, 0.2, 2.0, step, n * step) for n in (1, 3, 20, 21)]
    assert begins == pytest.approx([0.2, 0.21, 0.9, math.inf])


@pytest.fixture(scope="module")
def minima():
    return as_written(vase.compute(VASE, SIZES))


def test_findings_of_the_fixed_mass(minima):
    computed = vase.findings(minima["vase"], minima["motions"], VASE)
    assert broken(computed) == {"support_decides"}
    assert not unmet(computed)
    assert computed["least_raise"]["value"] == pytest.approx(0.2340, abs=1e-4)
    assert computed["minimum_of_the_column"]["value"] == pytest.approx(0.272823, abs=1e-6)
    assert computed["minimum_of_the_portal"]["value"] == pytest.approx(0.918399, abs=1e-6)
    weak = minima["vase"].copy()
    weak.loc[weak.structure == "portal", "minimum_overturning"] = 0.0
    assert "portal_is_harder_to_overturn" in broken(vase.findings(weak, minima["motions"], VASE))
    for column, holds_when in (("wide_minimum", True), ("minimum", False)):
        changed = minima["motions"].copy()
        changed.loc[(changed.structure == "frame") & (changed.frequency_ratio == 2.0), column] = 0.1
        computed = vase.findings(minima["vase"], changed, VASE)["frame_always_raises"]
        assert (computed["holds"], computed["holds_when"]) == (False, holds_when)


# Verified outcomes -------------------------------------------------------------------------------

VERIFIED = pd.DataFrame(
    [
        ("minimum", "column", 0.0, 0.2, "survives"),
        ("minimum", "column", 0.0, 0.2 * (1 + 2e-8), "overturns"),
        ("exception", "frame", 0.0, 0.9, "survives"),
        ("exception", "frame", math.inf, 0.9, "overturns"),
    ],
    columns=["part", "structure", "mass_ratio", "amplitude", "outcome"],
)


QUOTED = pd.DataFrame(
    [("column", 0.0, "one-cosine", 0.2 * (1 + 1e-8)), ("column", 0.0, "one-sine", 0.3)],
    columns=["structure", "mass_ratio", "shape", "minimum_overturning"],
)


@pytest.mark.parametrize(
    ("row", "column", "number", "breaks"),
    [
        (0, "outcome", "overturns", "boundaries"),
        (0, "amplitude", 0.21, "boundaries"),
        (3, "outcome", "survives", "exception"),
    ],
)
def test_each_outcome_counts(row, column, number, breaks):
    assert broken(proven.findings(VERIFIED, QUOTED)) == set()
    changed = VERIFIED.copy()
    changed.loc[row, column] = number
    assert breaks in broken(proven.findings(changed, QUOTED))
    assert broken(proven.findings(VERIFIED, QUOTED.assign(minimum_overturning=0.21))) == {
        "boundaries"
    }


GAMMAS = pytest.mark.parametrize("gamma", [0.0, 1.0, math.inf])


@GAMMAS
def test_quoted_minimum_is_between_proven_outcomes(gamma):
    table = pd.read_csv(REFERENCE / "vase.csv").query("shape == 'one-cosine'")
    quoted = table[(table.mass_ratio == gamma) & table.structure.isin(["column", "frame"])]
    low, period = quoted.minimum_overturning.item(), CONFIG["vase"]["period"]
    pairs = proven.sides(SIZES, gamma, low, period)
    assert pairs == [
        (pytest.approx(low * (1 - 1e-8), rel=1e-14), "survives"),
        (pytest.approx(low * (1 + 1e-8), rel=1e-14), "overturns"),
    ]


@GAMMAS
def test_proofs_have_the_outcomes_of_the_solver(gamma):
    for amplitude in (0.1, 0.25, 0.5, 1.0):  # g; the column uplifts at 1/6 g
        for period in (0.5, 1.5, 3.0):
            pulse = th.Pulse("one-cosine", amplitude, period=period)
            fell = th.judge(th.RockingFrame(COLUMN, gamma), pulse).overturned
            end = proven.proven(SIZES, gamma, amplitude, period)
            assert end == ("overturns" if fell else "survives")


def test_terms_and_remainder_contain_the_motion():
    block = balls.block_of(SIZES, 1.0, 0.4, 1.5)
    state = balls.State(balls.arb(0), -1, balls.arb(0), balls.arb(0), 2)
    step = balls.exact(0.25)
    whole = balls.value(balls.terms(block, state, step), step)
    frame, pulse = th.RockingFrame(COLUMN, 1.0), th.Pulse("one-cosine", 0.4, period=1.5)
    times = [0.0, 0.25 / frame.frequency_parameter]
    motion = th.simulate(frame, pulse, samples=times)
    assert abs(motion.rotation[1]) == pytest.approx(float(whole.mid()), rel=1e-9)
    polynomial = balls.terms(block, state, step / 2)
    half = [balls.value(terms, step / 2) for terms in (polynomial, balls.slope(polynomial))]
    second = balls.State(step / 2, -1, *half, 0)
    halves = balls.value(balls.terms(block, second, step / 2), step / 2)
    assert halves.overlaps(whole)
    assert float(whole.rad()) < 1e-20


# Forces after uplift -----------------------------------------------------------------------------

CAP = th.Cap(5.0, 0.5)


def pulse(amplitude, shape="one-sine", ratio=4.0):
    return th.Pulse(
        shape,
        amplitude * COLUMN.uplift_acceleration,
        angular_frequency=ratio * COLUMN.frequency_parameter,
    )


def test_peaks_in_the_limits():
    """No uplift, a sudden pulse, and one that overturns."""
    still, sudden, fallen = (
        uplift.peaks(BENT, CAP, pulse(*case), 8)
        for case in ((0.9,), (3.0, "one-cosine", 8.0), (20.0,))
    )
    level = COLUMN.uplift_acceleration
    assert (still[0], fallen[0]) == ("no uplift", "overturned")
    assert still[1][0] == pytest.approx(0.9 * level, rel=1e-3)
    assert sudden[1][0] == pytest.approx(level * (1.0 + 2.0 * base_shear_slope(BENT)), rel=1e-6)
    assert np.isnan(fallen[1]).all()


def test_arcs_hold_both_sides_of_each_impact():
    response = th.simulate(BENT, pulse(2.0))
    course = history(BENT, pulse(2.0), response, 8)
    assert course.impacts > 2
    assert np.abs(course.rotation).max() == pytest.approx(response.peak_rotation, rel=1e-2)
    upright = np.abs(course.rotation[:-1, -1]) < 1e-8
    ratios = course.velocity[1:, 0][upright] / course.velocity[:-1, -1][upright]
    assert ratios == pytest.approx(BENT.restitution, rel=1e-6)


def test_findings_of_uplift():
    table = as_written({"table": uplift.compute(UPLIFT, SIZES)})["table"]
    refuted = {"uplift_limits_forces", "uplift_is_beneficial"}
    computed = uplift.findings(table)
    assert broken(computed) == refuted
    assert not unmet(computed)
    assert not broken(uplift.findings(table[table.outcome != "overturned"]))
    for name, breaks in (("bending_moment", {"uplift_limits_forces"}), ("base_shear", refuted)):
        larger = table.assign(**{f"{name}_over_clamped": 1.1})
        assert unmet(uplift.findings(larger)) == breaks
