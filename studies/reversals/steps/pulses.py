"""Where a heavier cap overturns a frame that a lighter one saves, and whether p̂ or √r is to blame.

It helps where only the lighter frame overturns, and harms where only the heavier does: a reversal.
"""

import math
from itertools import combinations
from typing import Any

import numpy as np
import pandas as pd

from replication.workbench import Finding, run, truth, value
from steps.shared.spectra_compared import ORDER, Place, Spectra, finite, without
from steps.shared.spectrum import solve
from studies.reversals.steps.pulses_shard import CHANGES, lines
from topheavy import simulate
from topheavy.second.linear import simulate_linear_exact

COLUMN, MASSLESS = 0.0, math.inf  # γ of the two ends
SHARES = {"only_lighter_overturns": "helps", "only_heavier_overturns": "harms"}
SAMPLES = 2001  # of a history that is drawn
SHOWN = 5.0  # lengths of the pulse
MANY = 10.0  # times the area of the other cause: chosen after we had seen both


def areas(spectra: Spectra, pairs: list[tuple[float, float]]) -> pd.DataFrame:
    """Return the shares of every map on which the heavier cap helps, and harms.

    The columns `helps_by_two`, `helps_by_four`, and so for harms, have them with the step in ω so
    many times as wide.
    """
    fine, twice, four_times = (
        pd.DataFrame(row for pair in pairs for row in grid.areas(*pair))
        for grid in (spectra, spectra.coarser(2), spectra.coarser(4))
    )
    shares = {
        name + ending: grown[column]
        for column, name in SHARES.items()
        for ending, grown in (("", fine), ("_by_two", twice), ("_by_four", four_times))
    }
    return fine.drop(columns=[*SHARES, "linearised"]).assign(**shares)


def mean(rows: pd.DataFrame, name: str) -> tuple[float, float]:
    """Return the mean of a share over maps, and its error, by two coarser grids.

    The trapezoidal rule is of second order: a step n times as wide is off by n² times the error,
    so that a coarser grid shows n² − 1 times the error. Twice that is taken.
    """
    fine, two, four = (float(rows[name + ending].mean()) for ending in ("", "_by_two", "_by_four"))
    return fine, 2.0 * max(abs(fine - two) / 3.0, abs(fine - four) / 15.0)


def apart(table: pd.DataFrame, change: str) -> pd.DataFrame:
    """Return the spectra of the column, and of frames of which only so much is taken."""
    return table[(table.change == change) | (table.mass_ratio == COLUMN)]


def parts(spectra: Spectra, light: float, heavy: float) -> pd.DataFrame:
    """Return every map cut into what only the lighter, only the heavier and both overturn."""
    rows = []
    for place in spectra.places():
        helps = spectra.reversals(place, heavy, light)
        harms = spectra.reversals(place, light, heavy)
        both = without(spectra.at(place, light), helps)
        labels = {"slenderness_deg": place.slenderness, "shape": place.shape}
        for mode, pieces in (("helps", helps), ("harms", harms), ("both", both)):
            rows += [
                labels | {"x": place.frequency_ratio, "lower": low, "upper": high, "mode": mode}
                for low, high in pieces
            ]
    return pd.DataFrame(rows)


def reversals(spectra: Spectra, pairs: list[tuple[float, float]]) -> pd.DataFrame:
    """Return all bands of amplitude that overturn the heavier frame of a pair alone."""
    rows = [
        (*place, light, heavy, low, high)
        for place in spectra.places()
        for light, heavy in pairs
        for low, high in spectra.reversals(place, light, heavy)
    ]
    return pd.DataFrame(rows, columns=[*Place._fields, "light", "heavy", "low", "high"])


def sample(spectra: Spectra, bands: pd.DataFrame, spec: dict, tightened: float) -> Finding:
    """Judge points within the bands, picked by their length, by the two routes."""
    random = np.random.default_rng(spec["seed"])
    widths = (bands.high - bands.low).to_numpy()
    picked = bands.iloc[random.choice(len(bands), spec["points"], p=widths / widths.sum())]
    confirmed = 0
    for band in picked.itertuples(index=False):
        place, amplitude = Place(*band[:4]), random.uniform(band.low, band.high)
        found = [spectra.judged(place, g, amplitude, tightened) for g in (band.light, band.heavy)]
        confirmed += found == [[False] * 2, [True] * 2]
    return truth(confirmed == len(picked), points=len(picked), confirmed=confirmed)


def without_impact(spectra: Spectra, pairs: list[tuple[float, float]]) -> Finding:
    """Are there reversals in which the heavier frame overturns without an impact?"""
    at_once = Spectra(spectra.settings, spectra.table[spectra.table["mode"] == "without impact"])
    widths, compared = [0.0], 0
    for place in spectra.places():
        for light, heavy in pairs:
            falls = at_once.at(place, heavy)
            compared += bool(len(falls))
            widths += [high - low for low, high in without(falls, spectra.at(place, light))]
    rounding = 1e-6  # of g tan α: ends of intervals have nine digits
    return truth(max(widths) < rounding, compared=compared, widest=max(widths))


def lowest_apart(spectra: Spectra, gammas: list[float]) -> dict:
    """Test whether the minimum amplitude rises if only p̂, or only √r, is that of the frame.

    Where it seems to fall, the column is searched anew at the finest resolution.
    """
    compared, falls = 0, []
    for place in spectra.places():
        low = spectra.lowest(place, COLUMN)
        for gamma in gammas:
            high = spectra.lowest(place, gamma)
            compared += min(low, high) < math.inf
            if high < low * (1.0 - 1e-8):
                falls.append((spectra.again(place, COLUMN, low)[0] / high - 1.0, place))
    proven = [fall for fall in falls if fall[0] > 1e-8]
    largest = max(proven, key=lambda fall: fall[0]) if proven else None
    evidence = {"largest": largest[0], **largest[1].described()} if largest else {}
    return truth(not proven, compared=compared, exceptions=len(proven), **evidence)


def confirmed(spectra: Spectra, found: tuple, tightened: float) -> tuple[dict, pd.DataFrame]:
    """Return a counterexample by all routes, and its two histories.

    The linearised equation has a third route, its closed form.
    """
    width, place, light, heavy, amplitude = found
    histories = []
    for gamma, falls in ((light, False), (heavy, True)):
        _, block, pulse = place.line(gamma)
        pulse = pulse.scaled(amplitude)
        routes = spectra.judged(place, gamma, amplitude, tightened)
        if place.linearised:
            exact = simulate_linear_exact(block, pulse, duration=pulse.duration, samples=2)
            routes = [*routes, exact.overturned]
        if routes != [falls] * len(routes):
            raise ArithmeticError(f"{place}, γ = {gamma} at {amplitude:.6g}: routes say {routes}")
        time = np.linspace(0.0, SHOWN * pulse.duration, SAMPLES)
        response = simulate(block, pulse, samples=time)
        history = {
            **place.described(),
            "amplitude_over_uplift": amplitude,
            "mass_ratio": gamma,
            "time": time / pulse.duration,
            "acceleration": pulse.excitation(time),
            "rotation_over_alpha": response.rotation / block.slenderness,
            "outcome": response.outcome,
            "peak_over_alpha": response.peak_rotation / block.slenderness,
        }
        histories.append(pd.DataFrame(history))
    finding = {
        "width_of_band": width,
        "amplitude_over_uplift": amplitude,
        "survives": finite(light),
        "overturns": finite(heavy),
        "routes": len(routes),
        **place.described(),
    }
    return finding, pd.concat(histories)


def at_every_pair(shares: pd.DataFrame) -> Finding:
    """Does every pair of γ have a reversal?"""
    harmed = (shares.harms > 0.0).groupby([shares.lighter, shares.heavier]).any()
    return truth(harmed.all(), pairs=len(harmed))


def _widths(bands: pd.DataFrame) -> pd.DataFrame:
    """Return the width of all bands together at each frequency of a shape."""
    width = (bands.high - bands.low).rename("width")
    return width.groupby([bands["shape"], bands.frequency_ratio], sort=False).sum().reset_index()


def causes(harms: dict[str, float]) -> dict[str, Finding]:
    """Compare the areas on which p̂ alone, √r alone and both cause overturning."""
    return {
        "size_harms": truth(harms["size"] > MANY * harms["restitution"]),
        "restitution_spares": truth(harms["both"] < harms["size"]),
    }


def linear_twin(settings: dict, found: tuple) -> tuple[Spectra, tuple]:
    """Return the widest band of the linearised equation at the place of a counterexample."""
    _, place, light, heavy, _ = found
    place = place._replace(linearised=True)
    table = solve([place.line(gamma) for gamma in (light, heavy)], settings)
    alone = settings | {"slendernesses": [place.slenderness], "shapes": [place.shape]}
    spectra = Spectra(alone, table)
    return spectra, spectra.counterexample([(light, heavy)], linearised=True)


def apart_findings(why: pd.DataFrame) -> dict[str, Finding]:
    """What p̂ alone, √r alone and both do, over the spectra of each."""
    ends = why[why.heavier == finite(MASSLESS)]
    shares = {
        f"{change}_{name}": mean(ends[ends.change == change], name)
        for change in CHANGES
        for name in SHARES.values()
    }
    return {
        "apart": truth(True, **shares),
        **causes({change: shares[f"{change}_harms"][0] for change in CHANGES}),
    }


def extent(shares: pd.DataFrame) -> dict[str, Finding]:
    """How much of the maps is reversed, and for which pairs."""
    ends = shares[(shares.lighter == COLUMN) & (shares.heavier == finite(MASSLESS))]
    worst = shares.loc[shares.harms.idxmax()]
    pairs = shares.groupby(["lighter", "heavier"], sort=False)
    return {
        "helps": value(*mean(ends, "helps")),
        "harms": value(*mean(ends, "harms")),
        "most_harm": value(
            worst.harms,
            max(abs(worst.harms - worst[name]) for name in ("harms_by_two", "harms_by_four")),
            **worst[["lighter", "heavier", "slenderness_deg", "shape"]],
        ),
        "pairs": truth(
            True,
            pairs=[
                {"lighter": light, "heavier": heavy}
                | {name: mean(rows, name)[0] for name in SHARES.values()}
                for (light, heavy), rows in pairs
            ],
        ),
    }


def findings(
    reversals_areas: pd.DataFrame, reversals_why: pd.DataFrame, reversals_widths: pd.DataFrame
) -> dict[str, Any]:
    """Return what shares of the maps and widths of bands say; minima are in the spectra."""
    shapes = [
        {"shape": shape, **dict(zip(("from", "to"), _middle(rows), strict=True))}
        for shape, rows in reversals_widths.groupby("shape", sort=False)
    ]
    of_bands = {
        "heavier_is_more_stable": {"holds": reversals_widths.empty},
        "at_every_pair": at_every_pair(reversals_areas),
        "where": truth(True, shapes=shapes),
    }
    return of_bands | extent(reversals_areas) | apart_findings(reversals_why)


def main(settings: dict, solver: dict, table: pd.DataFrame) -> tuple[dict[str, pd.DataFrame], dict]:
    whole = table[table.change == "both"]
    spectra = Spectra(settings, whole)
    pairs = list(combinations(settings["mass_ratios"], 2))
    bands, shares = reversals(spectra, pairs), areas(spectra, pairs)
    changes = {change: Spectra(settings, apart(table, change)) for change in CHANGES}
    separated = [(COLUMN, gamma) for gamma in settings["separated"]]
    why = pd.concat(areas(changes[change], separated).assign(change=change) for change in CHANGES)
    rises, reversed_at = spectra.lowest_rises(), spectra.counterexample(pairs)
    exact, histories = confirmed(spectra, reversed_at, solver["tightened"])
    twin, linear_histories = confirmed(*linear_twin(settings, reversed_at), solver["tightened"])
    step = settings["amplitudes"]["resolution"]
    span = settings["amplitudes"]["highest"] - settings["amplitudes"]["lowest"]
    lowest = {
        change: lowest_apart(changes[change], settings["separated"]) for change in CHANGES[1:]
    }
    widths = _widths(bands)
    drawn = findings(shares, why, widths)
    found = {
        "heavier_is_more_stable": truth(
            drawn.pop("heavier_is_more_stable")["holds"],
            holds_when=rises.holds,
            condition="what counts is the lowest amplitude of a pulse that overturns",
            by_the_linearised=twin,
            **exact,
        ),
        "lowest_amplitude_rises": rises.with_evidence(widest_missed=step),
        "never_without_impact": without_impact(spectra, pairs),
        "at_every_pair": drawn.pop("at_every_pair"),
        **{name: drawn.pop(name) for name in ("helps", "harms", "most_harm", "pairs")},
        "where": drawn.pop("where"),
        **drawn,
        "lowest_rises_apart": truth(all(one.holds for one in lowest.values()), **lowest),
        "sample_agrees": sample(spectra, bands, settings["sample"], solver["tightened"]),
        # the uniform searches alone, without the halving of every boundary
        "simulations_at_least": value(len(lines(settings)) * (math.ceil(span / step) + 1), 0.0),
    }
    drawn = settings | {"slendernesses": settings["drawn"]}
    maps = pd.concat(
        parts(Spectra(drawn, apart(table, change)), COLUMN, MASSLESS).assign(change=change)
        for change in CHANGES
    )
    tables = {
        "spectra": whole.drop(columns="change"),
        "areas": shares,
        "why": why,
        "widths": widths,
        "drawn": maps,
        "histories": pd.concat([histories, linear_histories]),
    }
    return tables, found


def _middle(widths: pd.DataFrame) -> np.ndarray:
    """Return the frequencies between which nine tenths of the reversals lie."""
    order = widths.sort_values("frequency_ratio")
    reached = order.width.cumsum() / order.width.sum()
    return order.frequency_ratio.to_numpy()[np.searchsorted(reached, [0.05, 0.95])]


def work(job: Any) -> tuple:
    table = pd.concat(map(pd.read_csv, job.input.shards))
    table = table.sort_values(["change", *ORDER], ignore_index=True)
    tables, findings = main(job.params.settings, job.params.solver, table)
    return *(
        tables[name] for name in ("spectra", "areas", "why", "widths", "drawn", "histories")
    ), findings


if __name__ == "__main__":
    run(snakemake, work)
