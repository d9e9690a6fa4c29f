"""What config/config.yaml may say: a model for each section, named as its rule."""

from typing import Literal

from replication.config import (
    Count,
    Degrees,
    Fraction,
    Grid,
    MassRatio,
    NotNegative,
    Number,
    Positive,
    PulseOf,
    Section,
    Shape,
)


class Column(Section):
    half_width: Positive  # m
    half_height: Positive  # m


class Solver(Section):
    tightened: Positive  # tolerance of the check, over α


# The paper, first part: parameters, trilith, allen, statements, verification ----------------------


class Parameters(Section):
    largest: Positive  # γ
    points: Count
    largest_slenderness: Degrees
    slendernesses: Count
    mass_ratios: list[MassRatio]  # of the curves of √r
    frames: list[Positive]  # γ
    rotations: Count
    shape: Shape
    period: Positive  # s


class PrintedTrilith(Section):
    width: Positive  # m
    height: Positive  # m
    half_measures: list[Positive]  # m
    masses: list[Positive]  # kg
    masses_meant: list[Positive]  # kg
    frequency_parameter: Positive  # rad/s
    frame_frequency_parameter: Positive  # rad/s


class Trilith(Section):
    mass_ratio: MassRatio
    printed: PrintedTrilith
    table_amplitude: Positive  # m
    table_frequency: Positive  # Hz
    duration: Positive  # s
    cycles: Count
    frequencies: Grid  # Hz
    amplitudes: Grid  # m


class PulseRatio(Section):
    shape: Shape
    frequency_ratio: Positive  # ω/p


class AllenErrors(Section):
    pulses: list[PulseRatio]  # the first is the quoted one
    mass_ratios: list[Positive]
    slendernesses: list[Degrees]
    amplitudes: Grid  # over g tan α


class AllenMaps(Section):
    shape: Shape
    slenderness: Degrees
    mass_ratio: MassRatio
    frequency_ratios: Grid  # ω/p
    amplitudes: Grid  # over g tan α


class Allen(Section):
    mass_ratio: MassRatio
    pulse: PulseOf
    factor: Positive  # on the record
    errors: AllenErrors
    maps: AllenMaps


class CapBeam(Section):
    span: Positive  # m
    depth: Positive  # m


class RelativePulse(Section):
    shape: Shape
    frequency_ratio: Positive  # ω/p of the column
    amplitude: Positive  # over g tan α


class Statements(Section):
    cap: CapBeam
    mass_ratios: list[Positive]
    pulses: list[RelativePulse]
    duration: Positive  # s
    samples: Count


class PublishedNumber(Section):
    quantity: str
    source: str
    printed: Number
    expected: Number  # by two independent codes beforehand
    tolerance: Positive


class Verification(Section):
    seed: Count
    cells: Count
    shapes: list[Shape]
    slendernesses: list[Degrees]  # lowest, highest
    mass_ratios: list[MassRatio]
    frequency_ratios: list[Positive]  # lowest, highest
    amplitudes: list[Positive]  # lowest, highest
    published: list[PublishedNumber]


# The paper, second part: spectra, vase, proven, uplift, animation ---------------------------------


class Cap(Section):
    width: Positive  # m
    depth: Positive


class Resolved(Section):
    lowest: Positive  # over g tan α
    highest: Positive
    resolution: Positive


class Finer(Section):
    below: Positive  # over g tan α
    resolution: Positive


class Sample(Section):
    points: Count
    seed: Count


class Cycles(Section):
    numbers: list[Count]
    frequency_ratios: Grid  # ω/p
    highest: Positive  # g tan α
    resolution: Positive
    wide: Positive


class Spectra(Section):
    shards: Count
    slendernesses: list[Degrees]
    shapes: list[Shape]
    mass_ratios: list[MassRatio]
    frequency_ratios: Grid  # ω/p
    amplitudes: Resolved
    finer: Finer
    slow: Positive  # ω/p̂
    cycles: Cycles
    sample: Sample


class PulseGrid(Section):
    shapes: list[Shape]
    mass_ratios: list[MassRatio]
    frequency_ratios: Grid  # ω/p


class Picture(Section):
    mass_ratio: MassRatio
    amplitudes: list[Positive]  # g
    cap: Cap


class Vase(Section):
    mass_ratios: list[MassRatio]
    shapes: list[Shape]
    period: Positive  # s
    grids: list[PulseGrid]
    longest: Positive  # ω/p
    highest: Positive  # g tan α
    floor: Fraction  # tan α
    wide: Fraction  # tan α
    sample: Count
    portal: CapBeam
    picture: Picture


class Uplift(Section):
    cap: CapBeam
    mass_ratios: list[MassRatio]
    shapes: list[Shape]
    frequency_ratios: Grid  # ω/p
    amplitudes: list[Positive]  # g tan α
    points: Count
    sample: Count


class Animation(Section):
    mass_ratio: MassRatio
    cap: Cap
    pulse: PulseOf
    duration: Positive  # s
    frames_per_second: Count


# Beyond the paper: motions, break_even, records --------------------------------------------------


class Scenario(Section):
    magnitude: Positive
    distance: Positive  # km, from the site to the rupture
    site_velocity: Positive  # m/s, V_S30
    directivity: Positive  # km of rupture


class Noise(Section):
    soils: list[Positive]  # Hz
    corners: list[Positive]  # Hz
    motions: Count
    seed: Count


class Vertical(Section):
    share: Positive  # of the horizontal PGA


class Bootstrap(Section):
    resamples: Count
    confidence: Fraction
    seed: Count


class Rotations(Section):
    motions: Count
    velocities: list[Positive]  # m/s


class Motions(Section):
    shards: Count
    structures: list[str]
    mass_ratios: list[MassRatio]
    structure: str
    mass_ratio: MassRatio
    seed: Count
    motions: Count
    fewer: Count
    scenarios: list[Scenario]
    velocity: Positive  # m/s
    changes: list[Positive]  # relative, of the velocity
    rotations: Rotations
    intensities: Grid  # p PGV/(g tan α)
    largest_factor: Positive
    noise: Noise
    vertical: Vertical
    bootstrap: Bootstrap
    checked: Count


class Reductions(Section):
    highest: Fraction
    step: Fraction


class BreakEven(Section):
    velocities: list[Positive]  # m/s
    reductions: Reductions  # of √r
    lowered: list[Fraction]  # of √r
    measured: tuple[Fraction, Fraction]  # of √r
    bootstrap: Bootstrap
    checked: Count


class Capacity(Section):
    structure: str
    mass_ratios: list[MassRatio]
    highest: Positive  # g tan α
    step: Fraction
    windows: list[Positive]
    share: Fraction


class Records(Section):
    mass_ratios: list[MassRatio]
    slendernesses: list[Degrees]
    sizes: Grid  # m
    factors: Grid
    checked: Count
    capacity: Capacity


# Beyond the paper: friction, engine -------------------------------------------------------------


class Friction(Section):
    structure: str
    mass_ratios: list[Positive]
    bays: list[Positive]  # m
    depth: Positive  # m
    sufficient: Positive
    shapes: list[Shape]
    frequency_ratios: Grid
    amplitudes: Grid  # g tan α
    samples: Count
    check_samples: Count


class Designers(Section):
    structure: str
    mass_ratios: list[MassRatio]
    velocities: list[Positive]  # m/s


class CapOf(Section):
    span: Positive  # m
    depth: Positive  # m


class EngineContact(Section):
    time_constant: Positive  # 1/p
    damping_ratio: Positive


class EngineRestitution(Section):
    frames: dict[str, list[MassRatio]]
    lean: Fraction  # α
    damping_ratios: list[Positive]
    time_constants: list[Positive]  # 1/p


class EngineOutcomes(Section):
    frames: dict[str, list[MassRatio]]
    pulses: list[PulseRatio]
    factors: list[Positive]
    contacts: dict[str, EngineContact]
    friction: Positive
    time_step: Positive  # 1/p
    lean: Fraction  # α


class EngineAcross(Section):
    structure: str
    mass_ratios: list[Positive]
    shape: Shape
    frequency_ratios: list[Positive]
    depths: list[Positive]
    oblique: list[Degrees]
    step: Positive
    time_step: Positive  # 1/p
    friction: Positive
    checks: list[dict[Literal["time_step", "friction"], Positive]]


class Engine(Section):
    caps: dict[str, CapOf]
    restitution: EngineRestitution
    outcomes: EngineOutcomes
    across: EngineAcross


class Gaps(Section):
    cap: CapOf
    depths: list[Positive]  # m
    gaps: list[NotNegative]  # mm
    draws: Count
    seed: Count
    ramp: Positive  # s
    duration: Positive  # s
    rocking: Positive  # degrees
    time_step: Positive  # 1/p
    friction: Positive
    checks: list[dict[Literal["time_step", "friction"], Positive]]


class TestPlan(Section):
    column: Column
    mass_ratio: Positive
    shape: Shape
    frequency_ratio: Positive
    reductions: list[Fraction]  # of √r
    scatters: list[Positive]
    risk: Fraction


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
    parameters: Parameters
    trilith: Trilith
    allen: Allen
    statements: Statements
    verification: Verification
    spectra: Spectra
    vase: Vase
    uplift: Uplift
    animation: Animation
    reproducibility: Reproducibility
    motions: Motions
    break_even: BreakEven
    records: Records
    friction: Friction
    designers: Designers
    engine: Engine
    gaps: Gaps
    test_plan: TestPlan
