"""Motions, break-even and records: the sweep, numbers by hand, and findings that break."""

import math

import numpy as np
import pandas as pd
import pytest

from derivation import consequences
from derivation.notation import R, alpha, gamma, m_c
from steps.beyond import break_even, motions, records
from steps.shared import filtered_noise, harmonic, samples, sweep
from steps.shared.filtered_noise import Soil
from tests.cases import COLUMN, CONFIG, broken
from topheavy import Capacity, Column, Record, RockingFrame, judge

EVEN = CONFIG["break_even"] | {"reductions": {"highest": 0.2, "step": 0.1}}
SETTINGS = CONFIG["motions"] | {
    "motions": 4,
    "fewer": 3,
    "rotations": {"motions": 2, "velocities": [0.3, 0.6]},
    "noise": CONFIG["motions"]["noise"] | {"motions": 3, "soils": [1.0], "corners": [0.2]},
    "harmonic": CONFIG["motions"]["harmonic"] | {"motions": 2},
    "bootstrap": {"resamples": 100, "confidence": 0.95, "seed": 1},
}
LAST = "broadband, M 7.3"


@pytest.fixture(scope="module")
def shards(tmp_path_factory):
    folder = tmp_path_factory.mktemp("shards")
    paths = [folder / f"motions_{number}-of-2.npz" for number in (2, 1)]
    for path in paths:
        shard = path.stem.removeprefix("motions_")
        path.write_bytes(sweep.compute(SETTINGS, EVEN, CONFIG["structures"], shard)["outcomes"])
    return [str(path) for path in paths]


def test_each_model_of_noise_has_a_seed_of_its_own():
    noise = SETTINGS["noise"] | {"soils": [1.0, 2.5]}
    soft, stiff = [*sweep.models(SETTINGS | {"noise": noise}).values()][4:6]
    for motions_of, place, soil in ((soft, 0, Soil(1.0, 0.2)), (stiff, 1, Soil(2.5, 0.2))):
        expected = filtered_noise.motion(noise["seed"] + place, 2, soil)
        np.testing.assert_array_equal(motions_of[2].record().acceleration, expected.acceleration)


def test_outcomes_of_all_shards_are_those_of_single_motions(shards):
    """The step compares those at the stated velocity with the plain solver, in each run."""
    trilith = Column(**CONFIG["structures"]["trilith"])
    velocities = sweep.frames(SETTINGS, trilith).velocities
    assert velocities[0] == pytest.approx(0.35 * 9.81 * 0.275 / 4.2117, rel=1e-3)
    outcomes = sweep.outcomes(shards, f"{LAST}: trilith")
    assert outcomes.shape == (3, 6, 17)
    assert sweep.outcomes(shards, f"{LAST}: fixed mass").shape == (3, 1, 17)
    record = sweep.models(SETTINGS)[LAST][1].record()
    scaled = record.scaled(velocities[8] / record.peak_velocity)
    place = 1 + SETTINGS["mass_ratios"].index(4.0)
    assert outcomes[1, place, 8] == judge(RockingFrame(trilith, 4.0), scaled).overturned
    peaks = sweep.outcomes(shards, f"{LAST}: rotations")
    assert peaks.shape == (2, 6, 2)
    ending = judge(RockingFrame(COLUMN, 1.0), record.scaled(0.3 / record.peak_velocity))
    assert peaks[1, 2, 0] == pytest.approx(ending.peak_rotation / COLUMN.slenderness)
    still = sweep.Question([COLUMN.block()], np.array([9.0]), of_peaks=True)
    assert sweep.answers([still], record, None) == [math.inf]
    lowered, stated = (sweep.outcomes(shards, f"{LAST}{part}") for part in (": lowered", ""))
    place_of_velocity = EVEN["velocities"].index(SETTINGS["velocity"])
    assert (lowered[:, [0, 3], place_of_velocity] == stated[:, [0, 2], 0]).all()


def test_a_motion_that_leaves_the_ground_in_free_fall_is_left_out():
    still = Record(0.01, np.sin(np.arange(300) / 20.0))
    up = Record(0.01, np.where(np.arange(300) == 100, -1.1, 0.0))
    question = sweep.Question([COLUMN.block()], np.array([still.peak_velocity]))
    assert sweep.answers([question], still, up) == [sweep.FREE_FALL]


def test_a_block_with_lower_restitution_has_the_stated_share():
    blocks = sweep.restitution_question(SETTINGS, EVEN, COLUMN).blocks
    r, r_frame = COLUMN.restitution, RockingFrame(COLUMN, 1.0).restitution
    expected = [r, 0.9 * r, 0.8 * r, r_frame, 0.95 * r_frame, 0.9 * r_frame]
    assert [block.restitution for block in blocks[:-2]] == pytest.approx(expected)
    assert r < blocks[-2].restitution < 1.0
    assert r_frame < blocks[-1].restitution < blocks[-2].restitution


@pytest.mark.parametrize("contact", [0.0, 0.4, 1.0])
def test_restitution_within_contacts_follows_the_derivation(contact):
    numbers = {R: COLUMN.size, alpha: COLUMN.slenderness, gamma: 4.0, m_c: 1.0}
    derived = consequences.restitution_within().subs(numbers | {consequences._within: contact})
    ratio = sweep.restitution_within(RockingFrame(COLUMN, 4.0), contact)
    assert ratio == pytest.approx(float(derived))


def test_numbers_of_a_row_are_those_of_its_outcomes():
    fell = np.zeros((40, 3, 2), bool)
    fell[:20, motions.COLUMN] = fell[10:18, motions.FRAME] = fell[:30, motions.FIXED] = True
    fell[38:, motions.FRAME, 0] = True
    fell[:3, motions.COLUMN, 1] = False
    row = motions.row("model", fell, SETTINGS)
    names = ("column", "fixed", "frame", "harm", "benefit", "only_frame", "changed")
    assert [row[name] for name in names] == [0.5, 0.75, 0.25, 0.25, 0.25, 2, 0.075]


def test_gain_and_ratio_are_those_of_the_outcomes():
    settings = SETTINGS | {"mass_ratios": [1.0]}
    velocities = sweep.frames(settings, COLUMN).velocities
    fell = np.zeros((40, 2, 17), bool)
    for motion in range(40):
        fell[motion, 0, 6 + motion % 5 :] = fell[motion, 1, 8 + motion % 5 :] = True
    fell[0, 1, 5] = True  # once only the frame
    (row,) = motions.gains("model", "temple", fell, settings, COLUMN)
    assert row["gain"] == pytest.approx(velocities[8] / velocities[6] - 1.0, rel=0.05)
    assert row["ratio"] == pytest.approx(1.0 / 80.0)
    (pair,) = motions.pairs("temple", [fell[:20], fell[20:]], settings)
    assert (pair["lighter"], pair["heavier"], pair["motions"]) == (0.0, 1.0, 40)
    assert pair["ratio"] == row["ratio"]


def test_gains_are_by_structure_and_may_rise_with_the_height():
    gains = pd.DataFrame(
        [
            (model, name, 1.0, g, g - 0.05, g + 0.05)
            for model, *by_name in (("one", 0.1, 0.2, 0.3), ("two", 0.1, 0.3, 0.2))
            for name, g in zip(("trilith", "temple", "tall"), by_name, strict=True)
        ],
        columns=["model", "structure", "mass_ratio", "gain", "gain_low", "gain_high"],
    )
    tables = {name: pd.DataFrame([row]) for name, row in TABLES.items()} | {"gains": gains}
    findings = motions.findings(*tables.values(), SETTINGS, CONFIG["structures"])
    assert findings["gain_rises_with_height"] == {"value": 1, "error": 0, "unit": "", "models": 2}
    ends = [findings["gain_tall"][name] for name in ("least", "most", "low", "high")]
    assert ends == pytest.approx([0.2, 0.3, 0.15, 0.35])


def test_an_overturned_structure_counts_as_above_the_median():
    peaks = np.full((3, 6, 1), 0.2)
    peaks[:2, 0] = math.inf
    settings = SETTINGS | {"rotations": {"velocities": [0.6]}}
    rows = motions.rotations("model", peaks, settings)
    assert [row["median_peak"] for row in rows] == [math.inf] + [0.2] * 5
    first = np.arange(125.0)[::-1, None, None]
    row, *_ = motions.rotations("model", np.repeat(first, 6, axis=1), settings)
    ends = [row[f"median_peak{end}"] for end in ("_low", "", "_high")]
    assert ends == [51.0, 62.0, 73.0]  # the 52nd and the 74th of 125


TABLES = {
    "motions": {"column": 0.2, "fixed": 0.5, "frame": 0.1, "only_frame": 3, "changed": 0.05}
    | {"harm_low": 0.1, "benefit_low": 0.05},
    "gains": {"model": "one", "gain_low": 0.1, "gain": 0.2, "gain_high": 0.3, "mass_ratio": 1.0},
    "pairs": {"ratio": 0.4, "ratio_high": 0.9},
    "harmonic": {"amplitude": 2.6, "lighter": 0.0, "difference": -0.1, "difference_low": -0.2},
}
ORDER = {"probability_is_lower", "column_overturns_most_often"}


@pytest.mark.parametrize(
    ("table", "column", "number", "false"),
    [
        ("motions", "only_frame", 1, set()),
        ("motions", "benefit_low", -0.01, {"order"}),
        ("motions", "harm_low", 0.0, {"order"}),
        ("gains", "gain_low", -0.1, {"gain", "gain_temple"}),
        ("motions", "only_frame", 0, {"some_only_frame"}),
        ("pairs", "ratio_high", 1.0, ORDER),
        ("harmonic", "difference", 0.1, {"column_overturns_most_often"}),
    ],
)
def test_one_row_is_enough_to_refute(table, column, number, false):
    tables = {name: pd.DataFrame([row] * 2) for name, row in TABLES.items()}
    tables["gains"]["structure"] = ["trilith", "temple"]
    tables[table].loc[1, column] = number
    settings = SETTINGS | {"structures": ["temple", "trilith"]}
    findings = motions.findings(*tables.values(), settings, CONFIG["structures"])
    assert broken(findings) - {"order_of_frames_can_turn"} == false
    assert findings["outcomes_that_change"]["value"] == 0.05
    assert findings["gain"]["least"] == findings["gain"]["most"] == 0.2


def test_heavier_frames_that_overturn_more_often_qualify_the_order():
    tables = {name: pd.DataFrame([row] * 2) for name, row in TABLES.items()}
    tables["gains"]["structure"] = ["trilith", "temple"]
    tables["harmonic"].loc[1, ["lighter", "difference", "difference_low"]] = [2.0, 0.05, 0.01]
    settings = SETTINGS | {"structures": ["temple", "trilith"]}
    findings = motions.findings(*tables.values(), settings, CONFIG["structures"])
    assert broken(findings) == {"probability_is_lower"}
    assert findings["probability_is_lower"]["holds_when"]
    worst = findings["order_of_frames_can_turn"]
    assert (worst["holds"], worst["lighter"], worst["difference"]) == (True, "2", 0.05)


def test_harmonic_motions_end_anywhere_and_are_compared_by_pairs():
    settings = CONFIG["motions"]["harmonic"] | {"motions": 40}
    record = harmonic.motion(settings, 3, COLUMN)
    cycles = record.duration * settings["frequency_ratio"] * COLUMN.frequency_parameter / math.tau
    assert 1.0 < cycles < 20.0
    assert record.peak_acceleration == pytest.approx(COLUMN.uplift_acceleration, rel=1e-3)
    gammas = [0.0, 1.0]
    fell = harmonic.outcomes(settings, gammas, COLUMN)
    level = settings["amplitudes"][0]
    assert fell[3, 1, 0] == judge(RockingFrame(COLUMN, 1.0), record.scaled(level)).overturned
    samples.check_sample(harmonic.sampled(settings, gammas, fell, COLUMN))
    row, *_ = harmonic.pairs(settings, gammas, fell, SETTINGS["bootstrap"])
    column, frame = fell[:, :, 0].mean(axis=0)
    assert row["difference"] == pytest.approx(frame - column)
    assert (row["probability_lighter"], row["probability_heavier"]) == (column, frame)


def test_the_benefit_ends_where_its_isotonic_fit_is_zero():
    shares = np.linspace(0.0, 0.2, 5)
    assert break_even.end_of(shares, np.array([3.0, 2.0, 1.0, -1.0, -2.0])) == pytest.approx(0.125)
    assert break_even.end_of(shares, np.array([3.0, 1.0, 2.0, -1.5, -2.0])) == pytest.approx(0.1125)
    assert break_even.end_of(shares, np.array([4.0, 3.0, 2.0, 1.0, 0.5])) == math.inf
    assert break_even.end_of(shares, np.array([-1.0, -2.0, -3.0, -4.0, -5.0])) == 0.0


def test_end_is_that_of_the_outcomes(monkeypatch):
    """The column overturns under 6, 4 and 2 motions of 8, by reduction of √r; the frame under 3."""
    counts = np.array([6, 4, 2, 3, 3, 3])
    fell = np.arange(8)[:, None, None] < counts[:, None]
    fell = np.repeat(fell, len(EVEN["velocities"]), axis=2)
    monkeypatch.setattr(break_even, "outcomes", lambda shards, name: fell.astype(np.int8))
    monkeypatch.setattr(break_even, "check_sample", list)
    settings = EVEN | {"lowered": [0.1, 0.2], "measured": [0.1]}
    eight = SETTINGS | {"motions": 8}
    results = break_even.compute(settings, eight, CONFIG["structures"], [])
    assert results["ends"].end.to_numpy() == pytest.approx(0.15)
    assert results["ends"].remaining.to_numpy() == pytest.approx((4 - 3) / (6 - 3))
    benefits = results["benefits"].query("lowered == 'both'")
    assert benefits.column.tolist() == [0.75, 0.5, 0.25] * 2
    assert (benefits.frame == 0.375).all()


@pytest.mark.parametrize(
    ("end", "low", "false"),
    [
        ([0.05, 0.08], [0.02, 0.03], set()),
        ([0.05, math.inf], [0.02, 0.03], {"benefit_ends"}),
        ([0.05, 0.08], [0.02, 0.0], {"frame_is_safer"}),
    ],
)
def test_one_velocity_or_change_is_enough_to_refute(end, low, false):
    ends = pd.DataFrame({"end": end, "end_low": [0.04, 0.05], "end_high": [0.09, 0.1]})
    ends[["set", "remaining"]] = [["near-fault", 0.2], ["near-fault", 0.5]]
    lowered = ["both", "both", "column alone", break_even.WITHIN]
    benefits = pd.DataFrame(
        {"set": "near-fault", "lowered": lowered, "reduction": [0.0, 0.05, 0.05, 0.0]}
        | {"benefit": [0.1, 0.06, 0.02, 0.15], "benefit_low": [*low, -0.01, 0.1]}
        | {"benefit_high": [0.14, 0.1, 0.05, 0.2]}
    )
    findings = break_even.findings(ends, benefits, EVEN)
    assert broken(findings) == false
    remains = findings["remaining_share_near_fault"]
    assert (remains["least"], remains["most"]) == (0.2, 0.5)
    limits = findings["benefit_ends"]
    assert (limits["low"], limits["high"]) == (0.04, 0.1)
    names = ("benefit", "remaining", "remaining_of_both", "within")
    numbers = [findings[f"{name}_near_fault"] for name in names]
    assert [number["value"] for number in numbers] == [0.1, 0.02, 0.06, 0.15]
    assert (numbers[1]["low"], numbers[1]["high"]) == (-0.01, 0.05)


def test_counts_are_of_outcomes_that_are_known(monkeypatch):
    outcomes = {0.0: [1, 1, -1, 0], 1.0: [1, -1, 1, 1]}
    monkeypatch.setattr(records, "read_record", lambda path: Record(0.01, [0.1, 0.2, 0.1], path))
    known_of = lambda frame, *_: np.array(outcomes[frame.mass_ratio])  # noqa: E731
    monkeypatch.setattr(records, "overturned", known_of)
    monkeypatch.setattr(records, "check_sample", list)
    monkeypatch.setattr(records, "capacities", lambda *_: [])
    grids = {"lowest": 1.0, "highest": 2.0}
    settings = {"mass_ratios": [0.0, 1.0], "slendernesses": [10.0], "sample": 1}
    settings |= {"sizes": grids | {"points": 1}, "factors": grids | {"points": 4}}
    settings |= {"by_structure": {"names": ["trilith"], "factors": 4}}
    settings |= {"capacity": {"structure": "temple"}}
    results = records.compute(settings, {"tightened": 1e-12}, CONFIG["structures"], ["one"])
    (row,) = results["table"]
    names = ("only_lighter", "only_heavier")
    assert [row[name] for name in names] == [1, 1]
    assert results["structures"] == [{"structure": "trilith"} | row]
    known = {
        0.05: {"one": (0.4, 0.5), "two": (0.5, 0.4), "three": (0.4, 0.44)},
        0.1: {"one": (0.4, 0.6), "two": (0.5, 0.5), "three": (0.4, math.nan)},
    }
    capacity = pd.DataFrame(
        (record, gamma, window, by_mass[place])
        for window, by_record in known.items()
        for record, by_mass in by_record.items()
        for place, gamma in enumerate((0.0, 1.0))
    ).set_axis(["record", "mass_ratio", "window", "capacity"], axis=1)
    settings["capacity"]["windows"] = [0.05, 0.1]
    structures = pd.DataFrame(results["structures"])
    findings = records.findings(pd.DataFrame([row]), structures, capacity, settings)
    holds = {name: finding["holds"] for name, finding in findings.items()}
    assert not any(holds.values())
    assert findings["pair_0_1"] | {"only_lighter": 1, "only_heavier": 1} == findings["pair_0_1"]
    undecided = findings["capacities_are_decided"]
    assert (undecided["undecided"], undecided["undecided_at_the_stated_window"]) == (1, 0)
    gain = findings["gain_1"]
    ends = [gain[n] for n in ("least", "most", "median", "lowest_median", "highest_median")]
    assert ends == pytest.approx([-0.2, 0.5, 0.1, 0.1, 0.25])


def test_capacity_that_one_outcome_moves_is_not_decided(monkeypatch):
    places = np.arange(401)
    first = Capacity(1.001**places, places > 300)
    monkeypatch.setattr(records, "capacity", lambda *_: first)
    again = lambda *motion, tolerance: abs(motion[2] / 1.001**330 - 1) > 1e-6  # noqa: E731
    monkeypatch.setattr(records, "overturned_by", again)
    spec = {"windows": [0.05, 0.02], "share": 1.0, "mass_ratios": [0.0]}
    wide, narrow = records.capacities(spec, COLUMN, [Record(0.01, [0.1, 0.2])], 1e-12)
    assert math.isnan(wide["capacity"])
    assert narrow["capacity"] == pytest.approx(0.2 * 1.001**301)


def test_outcome_that_a_tighter_tolerance_changes_is_not_known(monkeypatch):
    def tolerant(frame, record, factors, tolerance=None):
        return factors > (1.0 if tolerance is None else 2.0)

    monkeypatch.setattr(records, "overturned_by", tolerant)
    known = records.overturned(COLUMN, Record(0.01, [0.1, 0.2]), np.array([0.5, 1.5, 2.5]), 1e-13)
    assert known.tolist() == [-1, 0, 1]


def test_outcomes_that_a_nudge_changes_are_not_known():
    record = Record(0.01, np.sin(np.arange(200) / 20.0))
    edge = samples.beside_a_boundary(lambda f: judge(COLUMN, record.scaled(f)).overturned, 0.3)
    low, high = edge * 0.999, edge * 1.002
    for _ in range(60):
        middle = 0.5 * (low + high)
        fell = judge(COLUMN, record.scaled(middle)).overturned
        low, high = (low, middle) if fell else (middle, high)
    outcomes = records.overturned(COLUMN, record, np.array([0.1, low, 2.0]), 3e-12)
    assert outcomes.tolist() == [-1, 0, 1]


def test_a_solver_that_differs_stops_the_step(monkeypatch):
    cells = [(COLUMN.block(), Record(0.01, np.sin(np.arange(200) / 20.0)), None, 0.1, False)]
    samples.check_sample(cells)
    with pytest.raises(SystemExit, match="the plain solver has 1 of 1 outcomes otherwise"):
        samples.check_sample([(*cells[0][:-1], True)])
