"""Captions of the HTML report, and the verdicts on the claims that belong to each result."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from replication.claim import JudgedClaim
from replication.strict_yaml import read_yaml
from replication.verdicts import VERDICTS

MARKUP = re.compile(r"([\\*`|_])")


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


def captioned(
    result: str, captions: Mapping[str, Mapping[str, Any]], claims: Iterable[JudgedClaim]
) -> dict[str, Any]:
    """Return title, caption and claims of a result, with texts escaped for reStructuredText.

    Parameters
    ----------
    claims
        The judged ledger, results/claims.json.

    Raises
    ------
    ValueError
        When the result has no caption, or its caption names a claim that is not in the ledger.
    """
    if result not in captions:
        raise ValueError(
            f"{result} has no caption; expected one in figures/captions.yaml or, for a study, "
            "in its captions.yaml"
        )
    entry = captions[result]
    judged = {claim.id: claim for claim in claims}
    unknown = sorted(set(entry["claims"]) - set(judged))
    if unknown:
        raise ValueError(f"the caption of {result} names {unknown[0]!r}; expected ids of claims")
    about = [judged[key] for key in entry["claims"]]
    return {
        "title": entry["title"],
        "category": entry["category"],
        "caption": escaped(entry["caption"]),
        "verdict": verdict(claim.verdict for claim in about),
        "claims": [
            {
                key: escaped(getattr(claim, key))
                for key in ("where", "statement", "verdict", "remark")
            }
            for claim in about
        ],
    }


def verdict(verdicts: Iterable[str]) -> str:
    """Return the number of claims of a result with each verdict, in the order of VERDICTS."""
    count = Counter(verdicts)
    return ", ".join(f"{count[name]} {name}" for name in VERDICTS if count[name]) or "no claim"


def escaped(text: str) -> str:
    """Return a text on one line in which reStructuredText finds no markup."""
    return r"\ " + MARKUP.sub(r"\\\1", " ".join(text.split()))  # a list could begin with (a)
