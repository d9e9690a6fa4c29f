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
Seed = Annotated[int, Field(ge=0, strict=True)]
Degrees = Annotated[float, Field(ge=1, le=60, strict=True)]  # at least 1: no radians
StructureName = Annotated[str, AfterValidator(_structure)]
Items = Annotated[list[Entry], Field(min_length=1)]
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


class PulseOf(Section):
    """A pulse: acceleration amplitude in g, period 2π/ω in s."""

    shape: Shape
    amplitude: Positive
    period: Positive


def section(shared: str = "", /, base: type[Section] = Section, **types: Any) -> Any:
    """Return the model of a section: the names of its `SHARED` entries, and the types of others."""
    entries = {name: SHARED[name] for name in shared.split()} | types
    return create_model(
        "Section", __base__=base, **{name: (of, ...) for name, of in entries.items()}
    )


SHARED = {
    "amplitudes": Grid,
    "depths": Items[Positive],
    "duration": Duration,
    "frequency_ratio": Positive,
    "frequency_ratios": Grid,
    "friction": Positive,
    "highest": Positive,
    "mass_ratio": MassRatio,
    "mass_ratios": Items[MassRatio],
    "period": Positive,
    "points": Count,
    "resolution": Fraction,
    "sample": Count,
    "samples": Count,
    "seed": Seed,
    "shape": Shape,
    "shapes": Items[Shape],
    "shards": Count,
    "slendernesses": Items[Degrees],
    "structure": StructureName,
    "time_step": Positive,
    "velocities": Items[Positive],
}
"""Entries with the same type in every section that names them by its first argument."""

Cap = section(width=Positive, depth=Positive)
SHARED["cap"] = CapBeam = section(span=Positive, depth=Positive)
SHARED["column"] = Column = section(half_width=Positive, half_height=Positive)
PulseRatio = section("shape frequency_ratio")
SHARED["bootstrap"] = section("seed", resamples=Count, confidence=Fraction)
SHARED["checks"] = Items[dict[Literal["time_step", "friction"], Positive]]
SHARED["frames"] = dict[StructureName, Items[MassRatio]]


class Consistent(Section):
    """The config of the paper, whose sections refer to each other."""

    @model_validator(mode="after")
    def consistent(self: Any) -> Any:
        engine, motions, spectra = self.engine, self.motions, self.spectra
        frames = {*engine.restitution.frames, *engine.outcomes.frames, engine.across.structure}
        faults = {
            "structures: expected temple, trilith": not {"temple", "trilith"} <= {*self.structures},
            f"engine.caps: expected {', '.join(sorted(frames))}": not frames <= {*engine.caps},
            f"motions.fewer: expected at most {motions.motions}": motions.fewer > motions.motions,
            f"break_even.velocities: expected {motions.velocity:g} among them, as in motions": (
                motions.velocity not in self.break_even.velocities
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
    solver=section(tightened=Tolerance),
    reproducibility=section(relative=Tolerance, absolute=Tolerance, counts=Count),
    parameters=section(
        "mass_ratios points shape period",
        largest=Positive,
        largest_slenderness=Degrees,
        slendernesses=Count,
        frames=Items[Positive],
        rotations=Count,
    ),
    trilith=section(
        "mass_ratio duration amplitudes",
        printed=section(
            width=Positive,
            height=Positive,
            half_measures=Pair,
            masses=Pair,
            frame_frequency_parameter=Positive,
        ),
        table_amplitude=Positive,
        table_frequency=Positive,
        cycles=Count,
        frequencies=Grid,
    ),
    allen=section(
        "mass_ratio",
        pulse=PulseOf,
        factor=Positive,
        errors=section(
            "slendernesses amplitudes", pulses=Items[PulseRatio], mass_ratios=Items[Positive]
        ),
        maps=section("shape mass_ratio frequency_ratios amplitudes", slenderness=Degrees),
    ),
    statements=section(
        "cap duration samples",
        mass_ratios=Items[Positive],
        pulses=Items[section("shape frequency_ratio", amplitude=Positive)],
    ),
    verification=section(
        "seed sample shapes mass_ratios",
        near=Fraction,
        slendernesses=Range[Degrees],
        frequency_ratios=Range[Positive],
        amplitudes=Range[Positive],
        published=Items[
            section(
                quantity=str,
                source=str,
                printed=Number,
                to=Number,
                expected=Number,
                tolerance=Tolerance,
            )
        ],
    ),
    spectra=section(
        "shards slendernesses shapes mass_ratios frequency_ratios",
        amplitudes=section("resolution", Span),
        again=section("resolution", every=Count),
        finer=section("resolution", below=Positive),
        near=section("resolution", share=Fraction),
        collapse=section(slow=Positive, covered=Fraction),
        cycles=section("frequency_ratios highest resolution", numbers=Items[Count], wide=Fraction),
        sample=section("points seed"),
    ),
    vase=section(
        "mass_ratios shapes period highest sample",
        grids=Items[section("shapes mass_ratios frequency_ratios")],
        longest=Positive,
        floor=Fraction,
        search=section(floor=Fraction, below=Positive, near=Fraction),
        wide=Fraction,
        portal=CapBeam,
        picture=section("mass_ratio", amplitudes=Items[Positive], cap=Cap),
    ),
    uplift=section(
        "cap mass_ratios shapes frequency_ratios points sample", amplitudes=Items[Positive]
    ),
    animation=section("mass_ratio duration", cap=Cap, pulse=PulseOf, frames_per_second=Count),
    motions=section(
        "shards mass_ratios structure mass_ratio seed bootstrap sample",
        structures=Items[StructureName],
        motions=Count,
        fewer=Count,
        scenarios=Items[
            section(
                magnitude=Positive, distance=Positive, site_velocity=Positive, directivity=Positive
            )
        ],
        velocity=Positive,
        change=Fraction,
        rotations=section("velocities", motions=Count),
        intensities=Grid,
        largest_factor=Positive,
        noise=section("seed", soils=Items[Positive], corners=Items[Positive], motions=Count),
        vertical=section(share=Positive),
    ),
    break_even=section(
        "velocities bootstrap sample",
        reductions=section(highest=Fraction, step=Fraction),
        lowered=Items[Fraction],
        measured=Range[Fraction],
        contact=Fraction,
    ),
    records=section(
        "mass_ratios slendernesses sample",
        sizes=Grid,
        factors=Grid,
        capacity=section(
            "structure mass_ratios highest", step=Fraction, windows=Items[Fraction], share=Fraction
        ),
    ),
    friction=section(
        "structure shapes frequency_ratios amplitudes samples",
        mass_ratios=Items[Positive],
        bays=Items[Positive],
        depth=Positive,
        sufficient=Positive,
        check_samples=Count,
    ),
    designers=section("structure mass_ratios velocities"),
    engine=section(
        caps=dict[StructureName, CapBeam],
        restitution=section(
            "frames",
            lean=Fraction,
            damping_ratios=Items[Positive],
            time_constants=Items[Positive],
        ),
        outcomes=section(
            "frames friction time_step",
            pulses=Items[PulseRatio],
            factors=Items[Positive],
            contacts=section(
                **dict.fromkeys(
                    ("no rebound", "rebound"),
                    section(time_constant=Positive, damping_ratio=Positive),
                )
            ),
            lean=Fraction,
        ),
        across=section(
            "structure shape depths time_step friction checks",
            mass_ratios=Items[Positive],
            frequency_ratios=Items[Positive],
            oblique=Items[Degrees],
            step=Positive,
        ),
    ),
    gaps=section(
        "cap depths seed duration time_step friction checks",
        gaps=Items[NotNegative],
        draws=Count,
        ramp=Duration,
        rocking=Positive,
    ),
    test_plan=section(
        "column shape frequency_ratio",
        mass_ratio=Positive,
        reductions=Items[Fraction],
        scatters=Items[Fraction],
        risk=Fraction,
    ),
)
