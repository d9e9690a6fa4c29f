"""Find the γ that gives a share of the possible increase (γ → ∞)."""

import math

import pandas as pd
from scipy.optimize import brentq

from replication.workbench import Finding, run, truth, value
from steps.shared.spectra_compared import Place, Spectra
from steps.shared.spectrum import progress, search

CLOSE = 1e-6  # of the gain in R̂: how closely the γ is sought
JUDGED = (0.5, 0.9)  # the shares that rows judge
FINE = 0.01  # of the gain in amplitude: the resolution of the search


def mass_ratio(size_gain: float) -> float:
    """Return γ of a share of the gain in R̂, 2γ/(1 + 2γ): Eq. (24)."""
    return math.inf if size_gain == 1.0 else size_gain / (2.0 * (1.0 - size_gain))


def size_gain_of_frequency_gain(share: float) -> float:
    """Return the share of the gain in R̂ at which p̂ has had that share of its own: Eq. (23)."""
    ratio = 1.0 - share * (1.0 - math.sqrt(2.0 / 3.0))  # p̂/p
    return 2.0 * (ratio**-2 - 1.0)


def size_gain_needed(
    place: Place, share: float, ends: tuple[float, float], settings: dict
) -> float:
    """Return the share of the gain in R̂ that gives a share of the gain in minimum amplitude.

    `ends` are the minimum overturning amplitudes of the column and of the frame with γ → ∞.
    """
    first, last = ends
    resolution = min(settings["amplitudes"]["resolution"], FINE * (last - first))

    def beyond(size_gain: float) -> float:
        if size_gain in (0.0, 1.0):  # by definition, where the lowest band may be narrow
            return size_gain - share
        line = place.line(mass_ratio(size_gain))
        found = search(line, (first * (1.0 - CLOSE), last), resolution)
        lowest = found[0].lower[1] if found else last
        return (lowest - first) / (last - first) - share

    return float(brentq(beyond, 0.0, 1.0, xtol=CLOSE))


def solve(spectra: Spectra, shares: list[float]) -> tuple[pd.DataFrame, int]:
    """Return the γ of every share and place, and at how many places there is no gain to share.

    At these places the frame with γ → ∞, or the column, survives all amplitudes of the spectra.
    """
    places, rows, without_end = list(spectra.places()), [], 0
    for place in progress(places, len(places), "places"):
        ends = spectra.lowest(place, 0.0), spectra.lowest(place, math.inf)
        if math.inf in ends:
            without_end += 1
            continue
        for share in shares:
            needed = size_gain_needed(place, share, ends, spectra.settings)
            rows.append(
                place.described()
                | {"share": share, "gain": ends[1] / ends[0] - 1.0}
                | {"size_gain": needed, "mass_ratio": mass_ratio(needed)}
            )
    return pd.DataFrame(rows), without_end


def median(rows: pd.DataFrame, ratios: list[float]) -> tuple[float, float]:
    """Return the median γ over places, and its error: the difference to the medians of the halves.

    One half has every second frequency, the other the rest.
    """
    second = rows.frequency_ratio.isin(ratios[::2])
    middle, *halves = (of.mass_ratio.median() for of in (rows, rows[second], rows[~second]))
    return middle, max(abs(middle - half) for half in halves)


def main(settings: dict, table: pd.DataFrame) -> tuple[pd.DataFrame, dict]:
    spectra = Spectra(settings, table).coarser(settings["every"])
    found, without_end = solve(spectra, settings["shares"])
    drawn = findings(found)
    return found, drawn | {"enough": drawn["enough"].with_evidence(without_end=without_end)}


def findings(reversals_enough: pd.DataFrame) -> dict[str, Finding]:
    """Return the γ that bring shares of the possible increase, from the table of places."""
    found, medians, rows = reversals_enough, {}, []
    ratios = sorted(found.frequency_ratio.unique())
    for share, of in found.groupby("share"):
        if share in JUDGED:
            medians[f"amplitude_at_{100 * share:.0f}_percent"] = value(*median(of, ratios))
        rows.append(
            {
                "share": share,
                "in_size": mass_ratio(share),
                "in_frequency": mass_ratio(size_gain_of_frequency_gain(share)),
                "in_amplitude": of.mass_ratio.median(),
                "lowest": of.mass_ratio.min(),
                "highest": of.mass_ratio.max(),
                "shapes": of.groupby("shape").mass_ratio.median().to_dict(),
            }
        )
    gains = found[found.share == found.share.min()].gain
    return {
        **medians,
        "enough": truth(True, shares=rows, places=len(gains)),
    }


if __name__ == "__main__":
    run(snakemake, lambda job: main(job.params.settings, pd.read_csv(job.input.spectra)))
