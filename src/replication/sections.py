"""What config/config.yaml may say: a model for each section, named as its rule."""

from replication.config import (
    Count,
    Positive,
    Section,
)


class Column(Section):
    half_width: Positive  # m
    half_height: Positive  # m


class Solver(Section):
    tightened: Positive  # tolerance of the check, over α


# The paper, first part: parameters, trilith, allen, statements, verification ----------------------


# The paper, second part: spectra, vase, proven, uplift, animation ---------------------------------


# Beyond the paper: motions, break_even, records --------------------------------------------------


# Beyond the paper: friction, engine -------------------------------------------------------------


class Reproducibility(Section):
    relative: (
        Positive  # largest difference of a table from the published one, of its largest number
    )
    absolute: Positive
    counts: Count  # how many outcomes of a count may differ


class Paper(Section):
    studies: list[str]
    structures: dict[str, Column]
    solver: Solver
    reproducibility: Reproducibility
