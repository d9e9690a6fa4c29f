"""The frame beside the solitary column of size R̂, which loses what Housner says, not Eq. (25).

Between impacts the two are one oscillator. What the difference at impacts does to peak rotation and
to overturning is counted here.
"""

import math
from collections.abc import Iterable, Sequence

import numpy as np
import pandas as pd

from replication.workbench import Finding, grid, run, truth, value
from topheavy import Column, Pulse, RockingBlock, RockingFrame, minimum_overturning, overturning_map
from topheavy.second import reference

THINNED = 2  # so many times is the grid coarser that gives the error of shares
BRACKETS = 1e-8  # of an amplitude: a bound on the brackets of the boundaries
IDENTICAL = 1e-9  # of α
ASIDE = 1e-5  # of an amplitude: so far beyond a boundary is the second route asked


def equivalent_column(frame: RockingFrame) -> RockingBlock:
    """Return the solitary column of size R̂, with its own restitution, Housner's."""
    stretch = frame.equivalent_size / frame.column.size
    column = Column(stretch * frame.column.half_width, stretch * frame.column.half_height)
    return column.block()


def maps(
    blocks: Iterable[RockingBlock], frame: RockingFrame, shape: str, settings: dict
) -> list[pd.DataFrame]:
    """Return maps of the peak rotation over α, NaN where overturned, over ω/p and a/(g tan α)."""
    ratios, amplitudes = grid(settings["frequency_ratios"]), grid(settings["amplitudes"])
    omega, tan = ratios * frame.column.frequency_parameter, frame.uplift_acceleration
    found = [overturning_map(block, shape, omega, amplitudes * tan) for block in blocks]
    return [
        pd.DataFrame(one.peak_rotation.to_numpy() / frame.slenderness, ratios, amplitudes)
        for one in found
    ]


def given_its_restitution(
    frame: RockingFrame, shape: str, peaks: pd.DataFrame, settings: dict
) -> float:
    """Return how far (over α) the column's map is from the frame's, given the frame's √r."""
    column = equivalent_column(frame).with_restitution(frame.restitution)
    (found,) = maps((column,), frame, shape, settings)
    if not (found.isna() == peaks.isna()).to_numpy().all():
        return math.inf
    return float((found - peaks).abs().max().max())


def lowest(block: RockingBlock | RockingFrame, unit: Pulse, settings: dict) -> float:
    """Return the lowest factor on a pulse of amplitude g tan α that overturns; NaN for none."""
    spec = settings["amplitudes"]
    step = (spec["highest"] - spec["lowest"]) / (spec["points"] - 1)
    found = minimum_overturning(block, unit, (spec["lowest"], spec["highest"]), resolution=step)
    return found[0] if found else math.nan


def lowest_changes(frame: RockingFrame, shape: str, settings: dict) -> pd.DataFrame:
    """Return the minimum overturning amplitudes (g tan α) of frame and equivalent column."""
    rows = []
    for ratio in grid(settings["frequency_ratios"])[:: settings["every"]]:
        omega = ratio * frame.column.frequency_parameter
        unit = Pulse(shape, frame.uplift_acceleration, omega)
        of_frame, of_column = (
            lowest(block, unit, settings) for block in (frame, equivalent_column(frame))
        )
        if of_frame > settings["amplitudes"]["lowest"] and math.isfinite(of_column):
            change = of_column / of_frame - 1.0
            rows.append(
                {"frame": frame, "unit": unit, "frequency_ratio": ratio}
                | {"lower": min(of_frame, of_column), "change": change}
            )
    return pd.DataFrame(rows)


def confirmed(row: pd.Series) -> bool:
    """Return whether SciPy also overturns only the structure with the lower minimum."""
    pulse = row.unit.scaled(row.lower * (1.0 + ASIDE))
    blocks = (row.frame, equivalent_column(row.frame))
    falls = [reference.judge(block, pulse).overturned for block in blocks]
    return falls == [row.change > 0.0, row.change < 0.0]


def share_of_area(cells: pd.DataFrame) -> float:
    """Return the share of a map on which something is so; edges of the grid count half."""
    even = np.trapezoid(np.trapezoid(cells.to_numpy(dtype=float), axis=1))
    return float(even / ((cells.shape[0] - 1) * (cells.shape[1] - 1)))


def differences(frame: pd.DataFrame, column: pd.DataFrame) -> dict:
    """Return what the difference of restitution changes over one pair of maps."""
    apart = frame.isna() != column.isna()
    both = frame.notna() & column.notna() & (frame > 0.0)
    change = (column / frame - 1.0).to_numpy()[both.to_numpy()]
    return {
        "share_apart": share_of_area(apart),
        "share_thinned": share_of_area(apart.iloc[::THINNED, ::THINNED]),
        "only_column_overturns": share_of_area(column.isna() & frame.notna()),
        "only_frame_overturns": share_of_area(frame.isna() & column.notna()),
        "peak_change_median": np.median(change),
        "peak_change_95": np.quantile(change, 0.95),
    }


def mean_share(table: pd.DataFrame) -> tuple[float, float]:
    """Return the mean of the shares apart over maps, and its error, by maps half as fine.

    The error is that of the mean: what the coarser maps change it by, or, where by chance that is
    little, the scatter of what they change each share by, over the root of the number of maps.
    """
    off = table.share_apart - table.share_thinned
    scatter = math.sqrt(float((off**2).mean()) / len(off))
    return float(table.share_apart.mean()), max(abs(float(off.mean())), scatter)


def second_route(
    frame: RockingFrame, shape: str, peaks: Sequence[pd.DataFrame], sample: dict
) -> bool:
    """Judge cells again by SciPy, half of them where the two verdicts differ."""
    apart = (peaks[0].isna() != peaks[1].isna()).to_numpy()
    chance = np.random.default_rng(sample["seed"])
    half = sample["points"] // 2
    picked = [
        places[chance.choice(len(places), min(half, len(places)), replace=False)]
        for places in (np.argwhere(apart), np.argwhere(~apart))
    ]
    for i, j in np.concatenate(picked):
        omega = peaks[0].index[i] * frame.column.frequency_parameter
        pulse = Pulse(shape, peaks[0].columns[j] * frame.uplift_acceleration, omega)
        for block, map_of in zip((frame, equivalent_column(frame)), peaks, strict=True):
            if reference.judge(block, pulse).overturned != bool(np.isnan(map_of.iloc[i, j])):
                return False
    return True


def main(settings: dict) -> tuple[pd.DataFrame, pd.DataFrame, pd.DataFrame, dict]:
    rows, changes, drawn, checked, same = [], [], None, True, True
    for degrees in settings["slendernesses"]:
        for gamma in settings["mass_ratios"]:
            alpha = math.radians(degrees)
            frame = RockingFrame(Column(math.sin(alpha), math.cos(alpha)), gamma)
            for shape in settings["shapes"]:
                peaks = maps((frame.block(), equivalent_column(frame)), frame, shape, settings)
                here = {"slenderness": degrees, "mass_ratio": gamma, "shape": shape}
                changes.append(lowest_changes(frame, shape, settings).assign(**here))
                change = changes[-1].change
                rows.append(
                    here
                    | {
                        "restitution": frame.restitution,
                        "restitution_of_column": frame.column.restitution,
                    }
                    | differences(*peaks)
                    | {
                        "lowest_change_mean": change.mean(),
                        "lowest_change_least": change.min(),
                        "lowest_change_largest": change.max(),
                    }
                )
                if here == settings["drawn"]:
                    checked = second_route(frame, shape, peaks, settings["sample"])
                    same = given_its_restitution(frame, shape, peaks[0], settings) < IDENTICAL
                    kind = 2 * peaks[0].isna().astype(int) + peaks[1].isna().astype(int)
                    drawn = kind.rename_axis("frequency_ratio").reset_index()
    table = pd.DataFrame(rows)
    lowered = pd.concat(changes, ignore_index=True)
    ends = [lowered.loc[lowered.change.idxmin()], lowered.loc[lowered.change.idxmax()]]
    compared = lowered.drop(columns=["frame", "unit"])
    found = findings(table, compared)
    return (
        table,
        drawn,
        compared,
        {
            "identical_response": Finding.of(
                {
                    "holds": found["identical_response"].holds,
                    "holds_when": same,
                    "condition": "between impacts; or the column is given the frame's √r in place "
                    "of its own",
                    **found["identical_response"].entries,
                    "second_route_agrees": checked,
                }
            ),
            "share_apart": found["share_apart"],
            "lowest_amplitude": found["lowest_amplitude"],
            "peak_rotation": found["peak_rotation"],
            "column_is_never_safer_first": found["column_is_never_safer_first"].with_evidence(
                second_route_agrees=all(map(confirmed, ends)),
            ),
        },
    )


def findings(
    mechanism_equivalence: pd.DataFrame, mechanism_lowest: pd.DataFrame
) -> dict[str, Finding]:
    """Return how far frame and column are apart, from the tables of maps and of minima."""
    table, change = mechanism_equivalence, mechanism_lowest.change
    worst = table.loc[table.share_apart.idxmax()]
    return {
        "identical_response": truth(
            not table.share_apart.any(),
            mean_share_apart=float(table.share_apart.mean()),
            largest_share_apart=float(worst.share_apart),
            largest_at={key: worst[key] for key in ("slenderness", "shape")},
            only_frame_overturns=float(table.only_frame_overturns.mean()),
            only_column_overturns=float(table.only_column_overturns.mean()),
        ),
        "share_apart": value(*mean_share(table)),
        "lowest_amplitude": value(
            change.mean(), BRACKETS, least=change.min(), largest=change.max()
        ),
        "peak_rotation": value(
            table.peak_change_median.median(), 1e-8, upper=table.peak_change_95.max()
        ),
        "column_is_never_safer_first": truth(
            change.max() <= 0.0,
            largest=change.max(),
            pulses=len(change),
            later=int((change > 0.0).sum()),
        ),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings))
