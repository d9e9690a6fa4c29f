"""The whole numbers of this study in the README are those that were published."""

import json
from pathlib import Path

import pandas as pd

from steps import headlines

ROOT = Path(__file__).parents[3]
REFERENCE = ROOT / "tests" / "reference"


def published(rule: str) -> dict:
    return json.loads((REFERENCE / "findings" / f"{rule}.json").read_text(encoding="utf-8"))


def test_counts_are_the_published_ones():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    said = " ".join(headlines.found(readme).split())
    ends = published("certainty_break_even")["deficit_ends_the_benefit"]
    least, most, median = (f"{100 * ends[name]:.0f}" for name in ("least", "most", "median"))
    assert (
        f"deficits of {least} to {most} % (median {median} %, over {ends['compared']} comp" in said
    )
    less = pd.read_csv(REFERENCE / "studies" / "certainty_benefit.csv").query("way == 'both'")
    ranges = [sorted(100 * less[less.factor == factor].less) for factor in (1.0, 0.9)]
    first, last = ("–".join(f"{one:.0f}" for one in both) for both in ranges)
    assert f"from {first} to {last} percentage points" in said
    rescaled = published("certainty_rescaled")["reversals_end"]
    assert f"Two of {rescaled['groups']} pairs of a measured component" in said
    assert rescaled["own"] == 2
