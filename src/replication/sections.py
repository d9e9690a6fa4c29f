"""What config/config.yaml may say: the types of its entries, in its order; it has their units."""

from itertools import pairwise
from typing import Annotated, Any, Literal, TypeVar

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationInfo,
    create_model,
    model_validator,
)

from topheavy.ground.shapes import FiniteShape as Shape

Entry = TypeVar("Entry")


def _rising(numbers: list) -> list:
    if any(high <= low for low, high in pairwise(numbers)):
        raise ValueError("expected numbers that rise")
    return numbers


def _structure(name: str, about: ValidationInfo) -> str:
    if name not in (names := [*map(str, about.context or ())]):
        raise ValueError(f"expected a name of `structures`: {', '.join(names)}")
    return name


Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, strict=True, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, strict=True, allow_inf_nan=False)]
MassRatio = Annotated[float, Field(ge=0, strict=True)]  # γ; .inf is a frame with γ → ∞
Fraction = Annotated[float, Field(gt=0, le=1, strict=True)]
Tolerance = Annotated[float, Field(gt=0, le=0.01, strict=True)]
Duration = Annotated[float, Field(gt=0, le=1000, strict=True)]  # s
Count = Annotated[int, Field(ge=1, le=10_000, strict=True)]
Sign = Literal[1, -1]
Seed = Annotated[int, Field(ge=0, strict=True)]
Degrees = Annotated[float, Field(ge=1, le=60, strict=True)]  # at least 1: no radians
StructureName = Annotated[str, AfterValidator(_structure)]
Items = Annotated[list[Entry], Field(min_length=1)]
Rising = Annotated[Items[Entry], AfterValidator(_rising)]
Pair = Annotated[list[Positive], Field(min_length=2, max_length=2)]
Range = Annotated[list[Entry], Field(min_length=2, max_length=2), AfterValidator(_rising)]


class Section(BaseModel):
    """A part of a config: a key that is not named in its model is an error."""

    model_config = ConfigDict(extra="forbid")


class Span(Section):
    """A range."""

    lowest: Positive
    highest: Positive

    @model_validator(mode="after")
    def ordered(self) -> "Span":
        if self.highest <= self.lowest:
            raise ValueError(
                f"highest is {self.highest:g}; expected more than lowest, {self.lowest:g}"
            )
        return self


class Grid(Span):
    """A range with so many points."""

    points: Annotated[int, Field(ge=2, le=1000, strict=True)]


def section(shared: str = "", /, base: type[Section] = Section, **types: Any) -> Any:
    """Return the model of a section: the names of its `SHARED` entries, and the types of others."""
    entries = {name: SHARED[name] for name in shared.split()} | types
    fields = {name: (kind, ...) for name, kind in entries.items()}
    return create_model("Section", __base__=base, **fields)


TYPES = (
    (
        Positive,
        "amplitude below depth directivity distance factor frame_frequency_parameter "
        "frequency_ratio friction half_height half_width height highest largest largest_factor "
        "longest magnitude period rocking site_velocity slow span sufficient table_amplitude "
        "table_frequency time_step velocity width",
    ),
    (
        Items[Positive],
        "bays corners depths frames soils velocities",
    ),
    (
        Fraction,
        "change confidence contact covered floor lean near resolution risk share step wide",
    ),
    (Items[Fraction], "lowered reductions scatters windows"),
    (
        Count,
        "check_samples counts cycles draws every fewer frames_per_second motions points resamples "
        "rotations sample samples shards",
    ),
    (Grid, "amplitudes factors frequencies frequency_ratios intensities sizes"),
    (Tolerance, "absolute relative tightened tolerance"),
    (Degrees, "largest_slenderness slenderness"),
    (Rising[Degrees], "oblique slendernesses"),
    (Number, "expected printed to"),
    (MassRatio, "mass_ratio"),
    (Rising[MassRatio], "mass_ratios"),
    (Duration, "duration ramp"),
    (Pair, "half_measures masses"),
    (Seed, "seed"),
    (Shape, "shape"),
    (Items[Shape], "shapes"),
    (StructureName, "structure"),
    (str, "quantity source"),
)
SHARED = {name: kind for kind, names in TYPES for name in names.split()}
"""Entries with the same type in every section that names them by its first argument."""

Cap = section("width depth")
SHARED["cap"] = CapBeam = section("span depth")
SHARED["column"] = Column = section("half_width half_height")
SHARED["pulse"] = section("shape amplitude period")
SHARED["pulses"] = Items[section("shape frequency_ratio")]
SHARED["bootstrap"] = section("seed resamples confidence")
SHARED["checks"] = Items[dict[Literal["time_step", "friction"], Positive]]


class Consistent(Section):
    """The config of the paper, whose sections refer to each other."""

    @model_validator(mode="after")
    def consistent(self: Any) -> Any:
        engine, motions, spectra = self.engine, self.motions, self.spectra
        even = self.break_even
        frames = {
            entry.structure
            for part in (engine.restitution, engine.outcomes)
            for entry in part.frames
        }
        frames |= {engine.across.structure}
        faults = {
            "structures: expected temple, trilith": not {"temple", "trilith"} <= {*self.structures},
            f"engine.caps: expected {', '.join(sorted(frames))}": not frames <= {*engine.caps},
            f"motions.fewer: expected at most {motions.motions}": motions.fewer > motions.motions,
            f"break_even.velocities: expected {motions.velocity:g} among them, as in motions": (
                motions.velocity not in even.velocities
            ),
            f"break_even.lowered: expected {even.measured[-1]:g} among them, as in measured": (
                even.measured[-1] not in even.lowered
            ),
            "spectra.finer.resolution: expected less than that of amplitudes": (
                spectra.finer.resolution >= spectra.amplitudes.resolution
            ),
        }
        for message, is_fault in faults.items():
            if is_fault:
                raise ValueError(message)
        return self


Paper = section(
    base=Consistent,
    structures=dict[str, Column],
    solver=section("tightened"),
    reproducibility=section("relative absolute counts"),
    parameters=section(
        "mass_ratios points shape period largest largest_slenderness frames rotations",
        slendernesses=Count,
    ),
    trilith=section(
        "mass_ratio duration amplitudes table_amplitude table_frequency cycles frequencies",
        printed=section("width height half_measures masses frame_frequency_parameter"),
    ),
    allen=section(
        "mass_ratio pulse factor",
        errors=section("slendernesses amplitudes pulses", mass_ratios=Rising[Positive]),
        maps=section("shape mass_ratio frequency_ratios amplitudes slenderness"),
    ),
    statements=section(
        "cap duration samples",
        mass_ratios=Rising[Positive],
        pulses=Items[section("shape frequency_ratio amplitude")],
    ),
    verification=section(
        "seed sample shapes mass_ratios near",
        slendernesses=Range[Degrees],
        frequency_ratios=Range[Positive],
        amplitudes=Range[Positive],
        published=Items[section("quantity source printed to expected tolerance")],
        order=section(
            "slendernesses", pairs=Items[Range[MassRatio]], factors=Items[Positive], histories=Count
        ),
    ),
    spectra=section(
        "shards slendernesses shapes mass_ratios frequency_ratios",
        amplitudes=section("resolution", Span),
        again=section("resolution every"),
        finer=section("resolution below"),
        near=section("resolution share"),
        collapse=section("slow covered"),
        cycles=section("frequency_ratios highest wide draws change seed", numbers=Items[Count]),
        two_pulses=section(
            "samples",
            cases=Items[
                section("slenderness frequency_ratio mass_ratios", pause=Positive, sign=Sign)
            ],
        ),
        sample=section("points seed"),
    ),
    vase=section(
        "mass_ratios shapes period highest sample longest floor wide",
        grids=Items[section("shapes mass_ratios frequency_ratios")],
        search=section("floor below near"),
        portal=CapBeam,
        picture=section("mass_ratio", amplitudes=Items[Positive], cap=Cap),
    ),
    guarantee=section(
        "structure mass_ratios",
        structures=Items[StructureName],
        visits=Rising[Count],
        reduction=Fraction,
        attack=section("slendernesses mass_ratios tolerance", limits=Rising[Degrees]),
        ramps=section("slendernesses mass_ratios time_step", shares=Items[Positive]),
        order=section("mass_ratios shape amplitude period duration samples highest"),
    ),
    uplift=section(
        "cap mass_ratios shapes frequency_ratios points sample", amplitudes=Items[Positive]
    ),
    animation=section("mass_ratio duration pulse frames_per_second", cap=Cap),
    motions=section(
        "shards mass_ratios structure mass_ratio seed bootstrap sample motions fewer velocity "
        "change intensities largest_factor",
        structures=Items[StructureName],
        scenarios=Items[section("magnitude distance site_velocity directivity")],
        rotations=section("velocities motions"),
        noise=section("seed soils corners motions"),
        vertical=section(share=Positive),
        harmonic=section(
            "frequency_ratio points motions seed", amplitudes=Items[Positive], cycles=Pair
        ),
    ),
    break_even=section(
        "velocities bootstrap sample lowered contact",
        reductions=section("step", highest=Fraction),
        measured=Range[Fraction],
    ),
    records=section(
        "mass_ratios slendernesses sample sizes factors",
        by_structure=section(names=Items[StructureName], factors=Count),
        capacity=section("structure mass_ratios windows share"),
    ),
    friction=section(
        "structure shapes frequency_ratios amplitudes samples bays depth sufficient check_samples",
        mass_ratios=Rising[Positive],
    ),
    contacts=section("cap sufficient seed", cells=Count),
    designers=section("structure mass_ratios velocities"),
    engine=section(
        caps=dict[StructureName, CapBeam],
        restitution=section(
            "lean time_step friction",
            frames=Items[section("structure mass_ratios", impacts=Count)],
        ),
        outcomes=section(
            "pulses time_step friction",
            frames=Items[section("structure mass_ratios")],
            factors=Items[Positive],
        ),
        mujoco=section("structure mass_ratio time_step friction"),
        across=section(
            "structure shape depths time_step friction checks oblique",
            mass_ratios=Rising[Positive],
            frequency_ratios=Items[Positive],
            step=Positive,
        ),
    ),
    colonnades=section(
        "structure cap pulses slow near resolution time_step friction checks",
        columns=Annotated[int, Field(ge=3, le=20, strict=True)],
        gap=Positive,
        mass_ratios=Rising[Positive],
    ),
    gaps=section(
        "cap depths seed duration time_step friction checks draws ramp rocking",
        gaps=Items[NotNegative],
    ),
    test_plan=section("column shape frequency_ratio reductions scatters risk", mass_ratio=Positive),
)
