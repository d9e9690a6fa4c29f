"""A claim: one row of the ledger, a statement of the paper in our words; and its verdict."""

from collections.abc import Mapping
from dataclasses import MISSING, dataclass, fields
from pathlib import Path
from typing import Any

from replication.inputs.suggestions import hint


@dataclass(frozen=True, kw_only=True)
class Claim:
    """A row of the ledger. The head of paper/claims.yaml explains the fields of a row.

    Two fields are not part of the row. `study` names the source of the claim: a study, "" for the
    paper, `ledger.OURS` for a claim of ours that supports claims of the paper, or
    `ledger.REPRODUCED` for a number of ours that a new run gives again. `ledger` is the file that
    names its rule and finding.
    """

    id: str
    where: str
    equation: int | None = None
    statement: str
    printed: float | str | None = None
    unit: str = ""
    tolerance: float | None = None
    because: str = ""
    function: str = ""
    rule: str = ""
    finding: str = ""
    by_definition: bool = False
    ours: bool = False
    reproduced: bool = False
    expected: str
    remark: str = ""
    study: str = ""
    ledger: str | Path = ""

    @classmethod
    def of(cls, row: Mapping[str, Any], ledger: str | Path, study: str = "") -> "Claim":
        """Return the claim of a row in a ledger.

        Raises
        ------
        ValueError
            When the row has an unknown key, or lacks one that every row has.
        """
        keys = [field.name for field in fields(cls) if field.name not in ("study", "ledger")]
        for key in row:
            if key not in keys:
                raise ValueError(
                    f"{ledger}: {row.get('id')}: the row has an unknown key {key!r}; "
                    f"{hint(key, keys)}"
                )
        required = [field.name for field in fields(cls) if field.default is MISSING]
        if missing := [key for key in required if key not in row]:
            raise ValueError(f"{ledger}: {row.get('id')}: the row lacks {', '.join(missing)}")
        return cls(**row, study=study, ledger=ledger)


@dataclass(frozen=True, kw_only=True)
class JudgedClaim:
    """A row of results/claims.json: a claim, the result for it, and the verdict.

    The published row has no field that is as its default here.
    """

    id: str
    study: str = ""
    where: str
    equation: int | None = None
    statement: str
    printed: float | str | None = None
    computed: float | bool | None = None
    meant: float | None = None
    kind: str = ""
    condition: str = ""
    error: float | None = None
    unit: str = ""
    tolerance: float | None = None
    verdict: str
    expected: str
    not_tested: str = ""
    remark: str = ""
    function: str = ""
    rule: str = ""
