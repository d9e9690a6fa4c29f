"""Captions of the HTML report, and the verdicts on the claims that belong to each result."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from replication.inputs.strict_yaml import read_yaml
from replication.inputs.suggestions import hint
from replication.judging.claim import JudgedClaim
from replication.judging.verdicts import VERDICTS

MARKUP = re.compile(r"([\\*`|_])")
FIELDS = ("where", "statement", "verdict", "remark")
"""What the report tells of a claim."""

NO_CAPTION = (
    "{} has no caption; expected one in figures/captions.yaml or, for a study, in its captions.yaml"
)


def read_captions(paths: Iterable[str | Path]) -> dict[str, dict[str, Any]]:
    """Read the captions of the paper and of its studies, by the path of the result.

    Raises
    ------
    ValueError
        When a result has two captions.
    """
    captions: dict[str, dict[str, Any]] = {}
    for path in paths:
        read = read_yaml(path)
        twice = sorted(set(captions) & set(read))
        if twice:
            raise ValueError(f"{path}: {twice[0]} has a caption already; expected one each")
        captions |= read
    return captions


def alternative(entry: Mapping[str, Any]) -> str:
    """Return the alternative text of a result: its own, or else its title."""
    return str(entry.get("alt", entry["title"]))


def check_captions(
    captions: Mapping[str, Mapping[str, Any]],
    figures: Iterable[str],
    claims: Iterable[str],
    is_made: Callable[[str], bool],
) -> None:
    """Refuse captions that leave a figure out, or name what does not exist.

    Raises
    ------
    ValueError
        With one line for each figure without a caption and each caption that names no result, or
        names a claim that is not in a ledger.
    """
    claims = set(claims)
    faults = [NO_CAPTION.format(each) for each in sorted(set(figures) - set(captions))]
    for result, entry in captions.items():
        if not is_made(result):
            faults.append(f"the captions have {result}, which no rule makes; delete this entry")
        faults += [
            f"the caption of {result} names {name!r}; {hint(name, claims)}"
            for name in sorted(set(entry["claims"]) - claims)
        ]
    if faults:
        raise ValueError("\n".join(faults))


def captioned(
    result: str, captions: Mapping[str, Mapping[str, Any]], claims: Iterable[JudgedClaim]
) -> dict[str, Any]:
    """Return title, caption and judged claims of a result, escaped for reStructuredText."""
    entry = captions[result]
    judged = {claim.id: claim for claim in claims}
    about = [judged[key] for key in entry["claims"]]
    return {
        "title": entry["title"],
        "category": entry["category"],
        "caption": escaped(entry["caption"]),
        "alt": escaped(alternative(entry)),
        "verdict": verdict(claim.verdict for claim in about),
        "claims": [{key: escaped(getattr(claim, key)) for key in FIELDS} for claim in about],
    }


def verdict(verdicts: Iterable[str]) -> str:
    """Return the number of claims of a result with each verdict, in the order of VERDICTS."""
    count = Counter(verdicts)
    return ", ".join(f"{count[name]} {name}" for name in VERDICTS if count[name]) or "no claim"


def escaped(text: str) -> str:
    """Return a text on one line in which reStructuredText finds no markup."""
    return r"\ " + MARKUP.sub(r"\\\1", " ".join(text.split()))  # a list could begin with (a)
