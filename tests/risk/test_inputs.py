"""What `fragility` refuses: the message has the argument, the value and what was expected."""

import re

import numpy as np
import pytest

from topheavy import Column, Pulse, Record, RockingFrame, fragility

PIER = Column(0.25, 1.5)
SHAKE = Record(0.02, [0.0, 0.3, -0.2, 0.1, 0.0], "shake")
STILL = Record(0.02, [0.0, 0.0, 0.0], "still")
TINY = Record(1e-9, [0.0, 1.0, 0.0], "tiny")


class Crate:
    """What has a block, and is no structure of the library."""

    def __init__(self, block):
        self._block = block

    def block(self):
        return self._block


GIVEN = {"structures": {"pier": PIER}, "motions": [SHAKE, SHAKE], "levels": [0.1, 0.2]}


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("structures", None, "structures is None; expected a mapping from names to structures"),
        (
            "structures",
            PIER,
            "structures is Column(half_width=0.25, half_height=1.5: 0.5",
        ),
        ("structures", "pier", "structures is 'pier'; expected a mapping"),
        ("structures", {}, "structures is empty; expected at least one structure"),
        ("structures", [], "structures is empty; expected at least one structure"),
        (
            "structures",
            [PIER, 3],
            "structures[1] is 3; expected a structure",
        ),
        ("structures", {"x": Column}, "structures['x'] is <class"),
        (
            "structures",
            [PIER, None],
            "structures[1] is None; expected a structure, for example Col",
        ),
        ("structures", [Crate(3)], "structures[0]: block() gives 3; expected a RockingBlock"),
        (
            "structures",
            [Crate(PIER)],
            "block() gives Column(half_width=0.25, half_height=1.5: 0.5 m",
        ),
        ("structures", {1: PIER}, "structures has the name 1; expected a text"),
        ("structures", {"x": SHAKE}, "structures['x'] is"),
        ("structures", [Column(2.0, 1.0)], "structures[0]: slenderness is 1.10715 rad"),
        ("motions", SHAKE, "expected a list of motions"),
        ("motions", None, "motions is None; expected a list of motions"),
        ("motions", [], "motions is empty; expected at least one motion"),
        ("motions", [SHAKE, "x"], "motions[1] is 'x'; expected a Record or a Pulse"),
        ("motions", [None], "motions[0] is None; expected a Record or a Pulse"),
        ("motions", [SHAKE, STILL], "motions[1]: PGV of record 'still' is 0 m/s; expected more"),
        ("motions", [TINY], "motions[0] scaled to 0.2: record 'tiny': sample 1 of 3 is"),
        ("motions", [Pulse("one-sine", 1.0, 3.0)], "which has no PGV; expected a Record, or a fun"),
        ("motions", [Pulse("harmonic", 1.0, 3.0)], "motions[0] goes on forever; expected a motion"),
        ("levels", [], "levels has shape (0,); expected a list of numbers, not empty"),
        ("levels", 0.5, "levels has shape (); expected a list"),
        ("levels", [[0.1, 0.2]], "levels has shape (1, 2); expected a list"),
        ("levels", [0.1, 0.3, 0.3], "levels[2] is 0.3 after 0.3; expected levels that increase"),
        ("levels", [0.3, 0.1], "levels[1] is 0.1 after 0.3; expected levels that increase"),
        ("levels", [0.0, 0.1], "levels[0] is 0; expected a positive number"),
        ("levels", [-0.1, 0.1], "levels[0] is -0.1; expected a positive number"),
        ("levels", None, "levels: element 0 is None; expected a number"),
        ("levels", [0.1, np.nan], "levels[1] is nan; expected a positive number"),
        ("levels", ["a"], "levels: element 0 is 'a'; expected a number"),
        ("measure", "PGD", "measure is 'PGD'; expected 'PGV', 'PGA' or a function of a motion"),
        ("measure", None, "measure is None; expected 'PGV', 'PGA' or a function of a motion"),
        ("measure", lambda motion: -1.0, "measure of motions[0] is -1; expected more than zero"),
        ("measure", lambda motion: "x", "measure of motions[0] is 'x'; expected a number"),
        ("groups", "ab", "groups is 'ab'; expected a list, the group of each motion"),
        ("groups", ["a"], "groups has 1 elements; expected 2, one for a motion"),
        ("groups", ["a", "b"], "groups is ['a', 'b'], a group for each motion; expected one at"),
        ("lowered", 0.05, "lowered is 0.05; expected a list of shares"),
        ("lowered", [0.05, 1.2], "lowered[1] is 1.2; expected a value from 0 to 1"),
        ("lowered", [0.0], "lowered[0] is 0; expected different shares of √r, each more than 0"),
        ("lowered", [0.1, 0.1], "lowered[1] is 0.1; expected different shares"),
        ("confidence", 1.0, "confidence is 1; expected more than 0 and less than 1"),
        ("confidence", 95, "confidence is 95; expected a value from 0 to 1"),
        ("resamples", 10, "resamples is 10; expected a whole number from 100 on"),
        ("resamples", 1e3, "resamples is 1000.0; expected a whole number"),
        ("seed", -1, "seed is -1; expected a whole number from 0 on"),
    ],
)
def test_bad_argument_is_named_with_its_value(name, value, message):
    with pytest.raises(ValueError, match=re.escape(message)) as caught:
        fragility(**{**GIVEN, name: value})
    error = caught.value
    assert error.__suppress_context__ or error.__context__ is None  # one message, and no other


def test_lowered_needs_a_column():
    with pytest.raises(ValueError, match=re.escape("lowered is [0.1], and structures has no Col")):
        fragility([RockingFrame(PIER, 1.0)], [SHAKE], [0.1], lowered=[0.1])
