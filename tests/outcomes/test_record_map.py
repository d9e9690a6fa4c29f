"""The map of a record: each cell is a history of a similar structure, and units are stated."""

import math

import numpy as np
import pytest

import topheavy as th
from topheavy.second import reference

BLOCK = th.RockingBlock(2.0, 0.25, 0.9)
COLUMN = th.Column(0.5, 2.0)
SHAKING = th.Record(0.05, 0.3 * np.sin(np.linspace(0, 18, 90)) * np.hanning(90), "mine")
PEAKS = np.array([0.0, 0.2, 0.26, 0.4, 0.6, 0.9, 1.4, 2.5])

#: A structure whose lengths are all multiplied, by the factor.
SIMILAR = {
    "column": lambda k: th.Column(0.5 * k, 2.0 * k),
    "frame": lambda k: th.RockingFrame(th.Column(0.5 * k, 2.0 * k), 1.5),
    "heaviest frame": lambda k: th.RockingFrame(th.Column(0.5 * k, 2.0 * k), math.inf),
    "vase": lambda k: th.FixedMassColumn(th.Column(0.5 * k, 2.0 * k), 1.0, 1.2 * k, 0.4 * k),
    "portal": lambda k: th.MonolithicPortal(th.Column(0.5 * k, 2.0 * k), 1.0, 3.0 * k, 0.4 * k),
}


@pytest.mark.parametrize("similar", SIMILAR.values(), ids=SIMILAR)
def test_each_cell_is_the_history_of_a_similar_structure(similar):
    factors = np.array([0.3, 1.0, 2.0, 7.0])
    found = th.overturning_map_of_record(similar(1.0), SHAKING, factors * COLUMN.size, PEAKS)
    assert found.sizes == {"size": 4, "peak_acceleration": PEAKS.size}
    for i, k in enumerate(factors):
        structure = similar(k)
        p = structure.block().frequency_parameter
        assert float(found.frequency_parameter[i]) == pytest.approx(p, rel=1e-14)
        for j, peak in enumerate(PEAKS):
            cell = found.isel(size=i, peak_acceleration=j)
            end = th.judge(structure, SHAKING.scaled(peak / SHAKING.peak_acceleration))
            assert (bool(cell.overturned), int(cell.impacts)) == (end.overturned, end.impacts)
            close = 1e-8 * structure.block().slenderness
            np.testing.assert_allclose(float(cell.peak_rotation), end.peak, rtol=0, atol=close)
    assert found.overturned.any()
    assert (found.overturned == np.isnan(found.peak_rotation)).all()
    assert not found.peak_rotation[:, 0].any()


@pytest.mark.parametrize("block", [BLOCK, BLOCK.linear()], ids=["exact", "linear"])
def test_cells_of_a_block_are_those_of_judge_and_of_scipy(block):
    sizes = [0.4, 1.0, 3.0, 9.0]
    found = th.overturning_map_of_record(block, SHAKING, sizes, PEAKS[2:])
    for i, p in enumerate(found.frequency_parameter.values):
        assert p == pytest.approx(math.sqrt(3 * th.STANDARD_GRAVITY / (4 * sizes[i])), rel=1e-14)
        other = th.RockingBlock(float(p), block.slenderness, block.restitution, block.linearised)
        for j, peak in enumerate(PEAKS[2:]):
            motion = SHAKING.scaled(peak / SHAKING.peak_acceleration)
            here = (bool(found.overturned[i, j]), int(found.impacts[i, j]))
            for judged in (th.judge, reference.judge):
                end = judged(other, motion)
                assert (end.overturned, end.impacts) == here
    assert found.attrs["linearised"] == block.linearised
    assert 3 < found.overturned.sum() < found.overturned.size - 3


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"structure": "column"}, "structure is 'column'; expected a Column"),
        ({"record": th.Pulse("one-sine", 0.3, 6.0)}, "record is Pulse.*; expected a Record"),
        ({"record": None}, "record is None; expected a Record"),
        ({"record": th.Record(0.1, [0.0, 0.0], "still")}, "record 'still' has a peak .* of 0 g"),
        ({"sizes": [1.0, 0.0]}, "sizes goes down to 0; it cannot be zero or negative"),
        ({"sizes": []}, r"sizes has shape \(0,\); expected a list of numbers, not empty"),
        ({"sizes": [1.0, math.inf]}, "sizes holds inf; expected finite"),
        ({"peak_accelerations": [0.3, -0.1]}, "peak_accelerations goes down to -0.1; .* negative"),
        ({"peak_accelerations": [1e7]}, "the largest of peak_accelerations is 1e.07 g; expected"),
        ({"peak_accelerations": [["0.3"]]}, "peak_accelerations: element 0 is '0.3'"),
    ],
)
def test_bad_map_of_a_record_is_refused_by_name_and_value(changes, says):
    given = {
        "structure": COLUMN,
        "record": SHAKING,
        "sizes": [1.0],
        "peak_accelerations": [0.3],
    } | changes
    with pytest.raises(ValueError, match=says):
        th.overturning_map_of_record(**given)
