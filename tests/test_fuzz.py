"""The search for failing inputs: its properties hold, and it tells what fails."""

import pytest

from benchmarks import fuzz
from topheavy import Pulse, RockingBlock
from topheavy.bodies.free_rocking import Outcome


def test_every_property_holds(monkeypatch, capsys):
    monkeypatch.setattr(fuzz, "TURN", 3)
    assert fuzz.main(0.0, 4) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("seed 4: ")
    assert all(f"{held.__name__} " in printed for held in fuzz.PROPERTIES)


@pytest.mark.parametrize("ends", [Outcome(True, 0.1, 0), Outcome(False, 0.100003, 0)])
def test_solvers_that_differ_on_a_decided_outcome_disagree(ends):
    block, pulse = RockingBlock(2.0, 0.2, 0.9), Pulse("constant", 1.0, angular_frequency=6.0)
    end = Outcome(False, 0.1, 0)
    with pytest.raises(AssertionError, match="Outcome"):
        fuzz.agree(block, pulse, lambda *_, **__: end, lambda *_, **__: ends)
    near = Outcome(False, 0.1 + 1e-8, 0)
    fuzz.agree(block, pulse, lambda *_, **__: end, lambda *_, **__: near)
    turning = iter([end, *[end, ends] * 9])
    if ends.overturned:
        fuzz.agree(block, pulse, lambda *_, **__: next(turning), lambda *_, **__: ends)
