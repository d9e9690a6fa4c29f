"""What README.md and docs/findings.md say of the results: every passage, from published results.

A passage has a title, and a function that writes it. Numbers and the words that depend on them
(more or fewer, raises or lowers, all or none) follow from the tables, findings and verdicts in
tests/reference; `need` refuses a passage whose words they no longer bear. `make publish` writes the
passages, and `make check` compares them.
"""

import math
import re
import textwrap
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pandas as pd

from steps.shared.published import WORDS, Passage, Published, need, span

STUDIES = Path(__file__).resolve().parents[2] / "studies"
WIDTH = 126
ROUGH = 0.7  # a coefficient of friction above it is said
PARAGRAPH = re.compile(r"^(?:- )?\*\*(.+?)\.?\*\*.*?(?=\n\n|\n- |\Z)", re.DOTALL | re.MULTILINE)
FINDINGS = "docs/findings.md"

HEAD = """# What we found

N. Makris and M. F. Vassiliou (2014), *Are some top-heavy structures more stable?*, J. Struct. Eng.
140(5), 06014001, doi:10.1061/(ASCE)ST.1943-541X.0000933. `make publish` writes this page from the
published results. [Each claim, with its verdict](verdicts.md).

*Frame*: two equal free-standing columns under a loose beam. *γ*: mass of the beam over that of both
columns. *Minimum*: minimum overturning acceleration, the lowest peak of a ground motion that
overturns. *Uplift acceleration*: that above which a column begins to rock. *Frequency parameter*:
how fast a column rocks; lower for a larger column. *α*: slenderness angle, its tangent is the width
over the height. *√r*: coefficient of restitution, the angular velocity after an impact over that
before. *Family*: synthetic ground motions, near-fault or broadband, of two earthquakes.
"""


def of_answer(results: Published) -> str:
    results.need(
        lowest_amplitude_rises_with_mass="confirmed",
        heavier_is_more_stable="qualified",
    )
    return (
        "**Yes, under the paper's assumptions, for the weakest pulse that overturns and for the "
        "probability over many motions, as far as we computed. No for each single motion:** some "
        "overturn only the heavier frame. We compared no measured response."
    )


def of_verdicts(results: Published) -> str:
    of = results.counts()
    need(of["refuted"] == 0, f"{of['refuted']} claims of the paper are refuted")
    wrong = of["slip"] + of["misprint"]
    return (
        f"Of their {of.total()} claims, {of['confirmed']} are confirmed and {of['qualified']} "
        f"hold only on conditions that we state and test; {wrong} have slips or misprints in our "
        f"text, {of['by definition']} is a definition, {of['not tested']} were not tested, and "
        "none is refuted. That text is a transcription: a slip may be its own. Other rows are our "
        "own claims, the refuted ones hypotheses:"
    )


def of_size(results: Published) -> str:
    results.need(
        minimum_is_a_proven_boundary="confirmed", nothing_below_the_minimum_overturns="confirmed"
    )
    pulse, column = results.config["heavier"]["pulse"], results.config["structures"]["temple"]
    minima = results.table("heavier").set_index("mass_ratio").lowest_overturning_low
    size = results.table("mass_ratio").set_index("mass_ratio").size_ratio
    shapes = results.table("vase").set_index("shape")
    bare = shapes[shapes.structure == "bare"].minimum_overturning
    heavy = shapes[
        (shapes.structure == "free") & (shapes.mass_ratio == math.inf)
    ].minimum_overturning
    rises = heavy / bare - 1.0
    need(
        pulse["shape"] == "one-cosine" and bool((rises > 0.0).all()),
        "a heavy beam raises not every minimum",
    )
    return (
        f"Between impacts the frame rocks like one column that is at most {size[math.inf]:.1f} "
        f"times as large. Under a pulse of one cosine of {pulse['period']:.1f} s, the weakest "
        f"peak that overturns a {2 * column['half_height']:.0f} m column rises from "
        f"{minima[0.0]:.3f} g alone to {minima[math.inf]:.3f} g under a very heavy beam; both are "
        f"proven by two programs. Under {WORDS[len(rises)]} shapes of pulses of this period, it "
        f"rises by {span(rises)} %."
    )


def of_central_result(results: Published) -> str:
    results.need(eq23="confirmed", eq24="confirmed", lowest_amplitude_rises_with_mass="confirmed")
    ratios = results.table("mass_ratio").set_index("mass_ratio")
    minima = results.table("heavier").set_index("mass_ratio").lowest_overturning_low
    need(
        abs(ratios.share_of_size_gain[1.0] - 2.0 / 3.0) < 1e-9,
        "γ = 1 does not give two thirds of the gain",
    )
    shapes = results.config["spectra"]["shapes"]
    return (
        "The equation of motion (23) and the equivalent size (24) follow by computer algebra. "
        "The frequency parameter of the frame decreases with γ to √(2/3) = "
        f"{ratios.frequency_ratio[math.inf]:.3f} times that of its column. Two thirds of the gain "
        f"in size are reached at γ = 1 ({minima[1.0]:.3f} g in place of {minima[0.0]:.3f} g). The "
        f"minimum rises with γ at every tested frequency of {WORDS[len(shapes)]} pulse shapes."
    )


def of_support(results: Published) -> str:
    lowers, raises = (
        results.finding("vase", f"{name}")
        for name in ("fixed_mass_always_lowers", "frame_always_raises")
    )
    wide = sum(raises["exceptions_of_width"]["0.02"].values())
    need(raises["exceptions"] == 0, "a free mass lowers a minimum")
    need(
        lowers["exceptions_under_records"] == 1,
        "not one record reverses that a fixed mass lowers the minimum",
    )
    floor = results.config["vase"]["floor"]
    need(floor == 1e-3, "the floor of the minima is not a thousandth")
    pulses = lowers["exceptions"] - lowers["exceptions_under_records"]
    return (
        "A mass lowers the minimum of a column if it is fixed to its top, and raises it if two "
        f"columns carry it freely. {pulses} short pulses and one record reverse the first. None "
        f"of {raises['comparisons']} comparisons reverses the second; if intervals narrower than "
        f"2 % of the uplift acceleration are left out, {wide} do. Those narrower than a "
        "thousandth are not excluded."
    )


def of_portals(results: Published) -> str:
    results.need(portal_overturns_last="confirmed", portal_joints_carry_more="confirmed")
    price, last = (
        results.finding("portal", "joints_carry_more"),
        results.finding("vase", "portal_overturns_last"),
    )
    rows_of_portals = results.table("vase").query("structure == 'portal'")
    rows = rows_of_portals[rows_of_portals["shape"] == "one-cosine"]
    held, pulled = rows.dropna(subset="minimum_overturning"), rows.dropna(subset="pulled_from")
    (quoted,) = held.itertuples()
    every = rows_of_portals.dropna(subset="minimum_overturning")
    slides = [f"{one:.2f}" for one in sorted(every.friction[every.friction > ROUGH])]
    spans = " and ".join(f"{one:.1f}" for one in pulled.span)
    over = {
        state: span([end for of in price[state].values() for end in of["joint_moment"]], 1, 1.0)
        for state in ("rocks", "rests_pinned")
    }
    need(
        price["pulled"] == 0 and price["largest_friction"] < ROUGH,
        "a portal that is compared leaves the ground or slides",
    )
    return (
        "With the mass fixed to both columns, the one-cosine pulse of "
        f"{results.config['vase']['period']:.1f} s must reach {quoted.minimum_overturning:.2f} "
        f"g if the columns' axes are {quoted.span:.1f} m apart. With {spans} m, the ground would "
        f"have to pull the base from {pulled.pulled_from.min():.1f} g on, before the portal "
        f"overturns; so it would for {last['pulled']} of {last['compared']} portals under three "
        f"such pulses, and {WORDS[len(slides)]} of the others require a coefficient of friction of "
        f"{' and '.join(slides)}. In {price['rocking']} comparisons in which the portal "
        f"rocks and both survive, the moments at its joints are {over['rocks']} times the largest "
        f"in the columns of the frame, impacts left out; {price['of_one_moment']} of these share "
        "one moment, which depends on span and peak acceleration. While it rests on pinned "
        f"bases, they are {over['rests_pinned']} times as large."
    )


def of_trilith(results: Published) -> str:
    results.need(trilith_no_pure_rocking="qualified")
    claims, states = results.claims, results.finding("trilith_states", "most_starts_keep_rocking")
    need(
        results.finding("trilith_orbit", "steady_rocking")["holds"],
        "the steady rocking is not proven",
    )
    steady = results.finding("trilith_states", "one_steady_rotation")["steady_over_alpha"]
    shares = (
        states[name] / states["starts"] for name in ("keep_rocking", "come_to_rest", "overturn")
    )
    rocking, rests, falls = (f"{100 * share:.1f}" for share in shares)
    return (
        "The shake table of the trilith of Peña et al. (2008) stayed at "
        f"{claims['trilith_base_acceleration_in_g']['computed']:.3f} g, below the "
        f"{claims['trilith_uplift_acceleration']['computed']:.3f} g of uplift. From a smooth "
        f"start our model stays at rest, as the paper says; of {states['starts']} starts in "
        f"motion, {rocking} % keep rocking at {steady:.3f} α, {rests} % come to rest, and {falls} "
        "% overturn. The steady rocking is proven to exist and to attract motions near it, by "
        "one program; the shares are computed."
    )


def of_text(results: Published) -> str:
    equations = results.table("equations")
    wrong = equations[equations.follows.astype(str) == "False"].dropna(subset="equation")

    def listed(kind: str) -> str:
        numbers = [
            f"({number:.0f})" for number in wrong[wrong.fault == kind].equation.drop_duplicates()
        ]
        return f"{', '.join(numbers[:-1])} and {numbers[-1]}"

    return (
        f"Eqs. {listed('sign')} have wrong signs; Eqs. {listed('convention')} hold in another "
        "sign convention. One mass of the trilith and the radicals of p̂ are slips. We worked "
        "from a transcription; some of these may be our errors."
    )


PASSAGES: dict[str, Passage] = {
    "Size": of_size,
    "The central result holds": of_central_result,
    "The support of the mass decides": of_support,
    "A portal overturns later still": of_portals,
    "One inference requires a smooth start": of_trilith,
    "Our text of the paper has discrepancies": of_text,
}
"""The paper's; those of a study are in its folder, under the same name."""


def passages(results: Published) -> dict[str, str]:
    """Return every finding as Markdown, by its title, of the paper and of the published studies."""
    found = dict(PASSAGES)
    for study in results.config["studies"]:
        if (STUDIES / study / "headlines.py").is_file():
            found |= import_module(f"studies.{study}.headlines").PASSAGES
    return {title: write(results) for title, write in found.items()}


def bullet(title: str, text: str) -> str:
    """Return a finding as a paragraph of a list."""
    return textwrap.fill(
        f"- **{title}.** {text}", WIDTH, subsequent_indent="  ", break_on_hyphens=False
    )


def pages(root: Path) -> dict[Path, str]:
    """Return README.md and docs/findings.md with their passages written anew.

    Raises
    ------
    ValueError
        When README.md has a bold heading of a list that is no title of a passage.
    """
    path, results = root / "README.md", Published(root / "tests" / "reference")
    found = passages(results)

    def written(match: re.Match[str]) -> str:
        title = match[1]
        if not match[0].startswith("- "):
            return match[0]
        if title not in found:
            raise ValueError(
                f"README.md: {title!r} is no title of a finding; expected one of {', '.join(found)}"
            )
        return bullet(title, found[title])

    text = PARAGRAPH.sub(written, path.read_text(encoding="utf-8"))
    for pattern, write in LEADS.items():
        filled = textwrap.fill(write(results), WIDTH, break_on_hyphens=False)
        text, count = re.subn(pattern, lambda _, filled=filled: filled, text, flags=re.DOTALL)
        need(count == 1, f"README.md has {count} passages that match {pattern!r}")
    listed = "".join(f"{bullet(*each)}\n" for each in found.items())
    return {path: text, root / FINDINGS: f"{HEAD}\n{listed}"}


def of_minutes(results: Published) -> str:
    """From the speed of the published costs, to that of cores which take four times as long."""
    seconds = pd.read_csv(results.folder.parents[1] / "docs" / "costs.csv").seconds.sum()
    least, most = math.floor(seconds / 120), math.ceil(seconds / 30)
    return f"# {least} to {most} minutes on two cores"


def of_flags(results: Published) -> str:
    cells = pd.read_csv(results.folder.parents[1] / "docs" / "verify_grid.csv").cells.sum()
    return f"{cells:,} overturning flags"


LEADS = {
    r"\*\*Yes, under.*?(?=\n\n)": of_answer,
    r"Of their \d+ claims.*?(?=\n\n)": of_verdicts,
    r"# \d+ to \d+ minutes on two cores": of_minutes,
    r"[\d,]+\s+overturning\s+flags": of_flags,
}
"""Passages of the README that are no findings of a list, by what they look like."""


def headlines(root: Path) -> Iterator[str]:
    """Yield the passages of README and docs/findings.md that the published results do not give."""
    try:
        expected = pages(root)
    except (ValueError, KeyError) as error:
        yield f"headlines: {error}"
        return
    for page, text in expected.items():
        said = page.read_text(encoding="utf-8") if page.exists() else ""
        for one, other in zip(said.splitlines() + [""], text.splitlines() + [""], strict=False):
            if one != other:
                yield (
                    f"{page.relative_to(root)}: {one[:80]!r}; expected {other[:80]!r} by the "
                    "published results; `make publish` writes it"
                )
                break


def write(root: Path = Path()) -> None:
    """Write the passages of README.md and docs/findings.md."""
    for path, text in pages(root).items():
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    write()
