"""What config/config.yaml may say: the types of its entries, in its order; it has their units."""

from typing import Any, Literal

from pydantic import model_validator

from replication.config import (
    Count,
    Degrees,
    Duration,
    Fraction,
    Grid,
    Items,
    MassRatio,
    NotNegative,
    Number,
    Pair,
    Positive,
    PulseOf,
    Range,
    Section,
    Seed,
    Shape,
    Span,
    StructureName,
    Tolerance,
    section,
)

Cap = section(width=Positive, depth=Positive)
CapBeam = section(span=Positive, depth=Positive)
Column = section(half_width=Positive, half_height=Positive)
PulseRatio = section(shape=Shape, frequency_ratio=Positive)
Contact = section(time_constant=Positive, damping_ratio=Positive)
Bootstrap = section(resamples=Count, confidence=Fraction, seed=Seed)
Checks = Items[dict[Literal["time_step", "friction"], Positive]]
Frames = dict[StructureName, Items[MassRatio]]


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
    Consistent,
    structures=dict[str, Column],
    solver=section(tightened=Tolerance),
    reproducibility=section(relative=Tolerance, absolute=Tolerance, counts=Count),
    parameters=section(
        largest=Positive,
        points=Count,
        largest_slenderness=Degrees,
        slendernesses=Count,
        mass_ratios=Items[MassRatio],
        frames=Items[Positive],
        rotations=Count,
        shape=Shape,
        period=Positive,
    ),
    trilith=section(
        mass_ratio=MassRatio,
        printed=section(
            width=Positive,
            height=Positive,
            half_measures=Pair,
            masses=Pair,
            frame_frequency_parameter=Positive,
        ),
        table_amplitude=Positive,
        table_frequency=Positive,
        duration=Duration,
        cycles=Count,
        frequencies=Grid,
        amplitudes=Grid,
    ),
    allen=section(
        mass_ratio=MassRatio,
        pulse=PulseOf,
        factor=Positive,
        errors=section(
            pulses=Items[PulseRatio],
            mass_ratios=Items[Positive],
            slendernesses=Items[Degrees],
            amplitudes=Grid,
        ),
        maps=section(
            shape=Shape,
            slenderness=Degrees,
            mass_ratio=MassRatio,
            frequency_ratios=Grid,
            amplitudes=Grid,
        ),
    ),
    statements=section(
        cap=CapBeam,
        mass_ratios=Items[Positive],
        pulses=Items[section(shape=Shape, frequency_ratio=Positive, amplitude=Positive)],
        duration=Duration,
        samples=Count,
    ),
    verification=section(
        seed=Seed,
        cells=Count,
        near=Fraction,
        shapes=Items[Shape],
        slendernesses=Range[Degrees],
        mass_ratios=Items[MassRatio],
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
        shards=Count,
        slendernesses=Items[Degrees],
        shapes=Items[Shape],
        mass_ratios=Items[MassRatio],
        frequency_ratios=Grid,
        amplitudes=section(Span, resolution=Fraction),
        finer=section(below=Positive, resolution=Fraction),
        collapse=section(slow=Positive, covered=Fraction),
        cycles=section(
            numbers=Items[Count],
            frequency_ratios=Grid,
            highest=Positive,
            resolution=Fraction,
            wide=Fraction,
        ),
        sample=section(points=Count, seed=Seed),
    ),
    vase=section(
        mass_ratios=Items[MassRatio],
        shapes=Items[Shape],
        period=Positive,
        grids=Items[
            section(shapes=Items[Shape], mass_ratios=Items[MassRatio], frequency_ratios=Grid)
        ],
        longest=Positive,
        highest=Positive,
        floor=Fraction,
        wide=Fraction,
        sample=Count,
        portal=CapBeam,
        picture=section(mass_ratio=MassRatio, amplitudes=Items[Positive], cap=Cap),
    ),
    uplift=section(
        cap=CapBeam,
        mass_ratios=Items[MassRatio],
        shapes=Items[Shape],
        frequency_ratios=Grid,
        amplitudes=Items[Positive],
        points=Count,
        sample=Count,
    ),
    animation=section(
        mass_ratio=MassRatio, cap=Cap, pulse=PulseOf, duration=Duration, frames_per_second=Count
    ),
    motions=section(
        shards=Count,
        structures=Items[StructureName],
        mass_ratios=Items[MassRatio],
        structure=StructureName,
        mass_ratio=MassRatio,
        seed=Seed,
        motions=Count,
        fewer=Count,
        scenarios=Items[
            section(
                magnitude=Positive, distance=Positive, site_velocity=Positive, directivity=Positive
            )
        ],
        velocity=Positive,
        changes=Items[Fraction],
        rotations=section(motions=Count, velocities=Items[Positive]),
        intensities=Grid,
        largest_factor=Positive,
        noise=section(soils=Items[Positive], corners=Items[Positive], motions=Count, seed=Seed),
        vertical=section(share=Positive),
        bootstrap=Bootstrap,
        checked=Count,
    ),
    break_even=section(
        velocities=Items[Positive],
        reductions=section(highest=Fraction, step=Fraction),
        lowered=Items[Fraction],
        measured=Range[Fraction],
        contact=Fraction,
        bootstrap=Bootstrap,
        checked=Count,
    ),
    records=section(
        mass_ratios=Items[MassRatio],
        slendernesses=Items[Degrees],
        sizes=Grid,
        factors=Grid,
        checked=Count,
        capacity=section(
            structure=StructureName,
            mass_ratios=Items[MassRatio],
            highest=Positive,
            step=Fraction,
            windows=Items[Fraction],
            share=Fraction,
        ),
    ),
    friction=section(
        structure=StructureName,
        mass_ratios=Items[Positive],
        bays=Items[Positive],
        depth=Positive,
        sufficient=Positive,
        shapes=Items[Shape],
        frequency_ratios=Grid,
        amplitudes=Grid,
        samples=Count,
        check_samples=Count,
    ),
    designers=section(
        structure=StructureName, mass_ratios=Items[MassRatio], velocities=Items[Positive]
    ),
    engine=section(
        caps=dict[StructureName, CapBeam],
        restitution=section(
            frames=Frames,
            lean=Fraction,
            damping_ratios=Items[Positive],
            time_constants=Items[Positive],
        ),
        outcomes=section(
            frames=Frames,
            pulses=Items[PulseRatio],
            factors=Items[Positive],
            contacts=section(**dict.fromkeys(("no rebound", "rebound"), Contact)),
            friction=Positive,
            time_step=Positive,
            lean=Fraction,
        ),
        across=section(
            structure=StructureName,
            mass_ratios=Items[Positive],
            shape=Shape,
            frequency_ratios=Items[Positive],
            depths=Items[Positive],
            oblique=Items[Degrees],
            step=Positive,
            time_step=Positive,
            friction=Positive,
            checks=Checks,
        ),
    ),
    gaps=section(
        cap=CapBeam,
        depths=Items[Positive],
        gaps=Items[NotNegative],
        draws=Count,
        seed=Seed,
        ramp=Duration,
        duration=Duration,
        rocking=Positive,
        time_step=Positive,
        friction=Positive,
        checks=Checks,
    ),
    test_plan=section(
        column=Column,
        mass_ratio=Positive,
        shape=Shape,
        frequency_ratio=Positive,
        reductions=Items[Fraction],
        scatters=Items[Fraction],
        risk=Fraction,
    ),
)
