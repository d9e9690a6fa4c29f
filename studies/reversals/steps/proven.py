"""Prove reversals: one of each pair of γ, and both sides of both ends of the widest band.

A reversal is proven where the lighter frame is proven to survive a pulse and the heavier one to be
overturned by it, by the search and by the checker. Frames have the sides of their columns, which
are decimals, and γ: α, p̂ and √r of Eq. (25) are enclosed.
"""

from collections.abc import Iterator
from itertools import combinations
from typing import Any

import pandas as pd

from replication.workbench import Finding, run, truth
from steps.shared.proofs import WIDTHS, as_lines, proven
from steps.shared.spectra_compared import Place, Spectra
from steps.shared.spectrum import column_of
from topheavy import RockingFrame

REVERSED = ("survives", "overturns")


def judged(
    place: Place, pair: tuple[float, float], amplitude: float
) -> tuple[dict, list[tuple[str, dict]]]:
    """Return what is proven of the lighter and of the heavier frame, and the certificates."""
    found = []
    for gamma in pair:
        frame, (*_, pulse) = RockingFrame(column_of(place.slenderness), gamma), place.line(gamma)
        found.append(proven(frame, pulse.scaled(amplitude)))
    light, heavy = pair
    row = place._asdict() | {"light": light, "heavy": heavy, "amplitude": amplitude}
    row |= {"lighter": found[0][0], "heavier": found[1][0]}
    claims = [f"reversal of γ = {light:g} and {heavy:g}: the frame of γ = {g:g}" for g in pair]
    of_both = zip(claims, found, strict=True)
    return row, [(claim, certificate) for claim, (_, certificate) in of_both if certificate]


def of_pairs(spectra: Spectra, gammas: list[float]) -> Iterator[tuple[dict, list]]:
    """Yield the middle of the widest band of each pair."""
    for pair in combinations(gammas, 2):
        _, place, *_, middle = spectra.counterexample([pair])
        row, certificates = judged(place, pair, middle)
        yield row | {"of": "pair"}, certificates


def of_widest(spectra: Spectra, gammas: list[float]) -> list[tuple[dict, list]]:
    """Return both sides of both ends of the widest band, as close as they are proven."""
    width, place, *pair, middle = spectra.counterexample(combinations(gammas, 2))
    found = []
    for away in WIDTHS:
        found = [
            judged(place, tuple(pair), middle * (1.0 + end * 0.5 * width) * (1.0 - end * side))
            for end in (-1, 1)
            for side in (-away, away)
        ]
        for number, (row, _) in enumerate(found):
            row |= {"of": "inside" if number % 2 else "outside", "relative_width": away}
        if holds(pd.DataFrame(row for row, _ in found)):
            break
    return found


def holds(rows: pd.DataFrame) -> bool:
    """Return whether every row inside is a reversal, and every one outside is proven to be none."""
    outcomes = list(zip(rows.lighter, rows.heavier, strict=True))
    reverses = [found == REVERSED for found in outcomes]
    decided = all("undecided" not in found for found in outcomes)
    return decided and reverses == (rows.of != "outside").tolist()


def findings(reversals_proven: pd.DataFrame) -> dict[str, Finding]:
    """Return whether the reversals of the table are proven."""
    is_pair = reversals_proven.of == "pair"
    pairs, ends = reversals_proven[is_pair], reversals_proven[~is_pair]
    return {
        "at_every_pair": truth(len(pairs) > 0 and holds(pairs), pairs=len(pairs)),
        "widest": truth(
            sorted(ends.of) == ["inside"] * 2 + ["outside"] * 2 and holds(ends),
            lowest=float(ends.amplitude.min()),
            highest=float(ends.amplitude.max()),
            relative_width=float(ends.relative_width.max()),
        ),
    }


def main(settings: dict, table: pd.DataFrame) -> tuple[pd.DataFrame, str, dict[str, Finding]]:
    spectra, gammas = Spectra(settings, table), settings["mass_ratios"]
    found = [*of_pairs(spectra, gammas), *of_widest(spectra, gammas)]
    rows = pd.DataFrame(row for row, _ in found)
    return rows, as_lines(each for _, both in found for each in both), findings(rows)


def work(job: Any) -> tuple:
    return main(job.params.settings, pd.read_csv(job.input.spectra))


if __name__ == "__main__":
    run(snakemake, work)
