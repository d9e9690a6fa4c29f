"""The edges of a step: its log, its tables, its findings, and the check of its inputs.

Figures and studies import from the machine only what this module and `drawing` have.
A step returns findings, by which claims of the ledger are judged: `value` for a number with its
error and unit, `truth` for a statement with the numbers that support it.
"""

import re
import resource
import signal
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, TextIO

from replication.judging.calls import library, noted
from replication.judging.findings import Finding, Findings, write_findings
from replication.workflow.code import undeclared

if TYPE_CHECKING:
    import numpy as np
    import pandas as pd

DIGITS = "%.9g"
PEAK = "peak memory: "
"""How the last line of a log begins."""


def run(job: Any, main: Callable[[Any], Any]) -> None:
    """Run a step as a job of Snakemake, and write what it returns.

    Parameters
    ----------
    job
        The object `snakemake` that Snakemake puts into every script.
    main
        Takes the job and returns one result for each output of the rule, in the order of the rule:
        a table for a CSV file, findings for a JSON file, a text as it is. It returns None when it
        writes its outputs itself.

    Raises
    ------
    RuntimeError
        When the process loaded a module of the repository that the rule does not declare.
    ValueError
        When a finding has a reserved name or a misspelt field.
    """
    with log_to(job.log[0]):
        with noted(library(job.input)) as called:
            results = main(job)
        if results is not None:
            results = results if isinstance(results, tuple) else (results,)
            for path, result in zip(job.output, results, strict=True):
                if path.endswith(".json"):
                    made = Findings.of(result)
                    write_findings(path, replace(made, called=tuple(sorted(called))))
                elif isinstance(result, str):
                    Path(path).write_text(result, encoding="utf-8")
                else:
                    write_table(path, result)
        if gap := undeclared(job.input):
            raise RuntimeError(
                f"rule {job.rule} loaded {', '.join(gap)}, which is not among its inputs: a change "
                "there would leave its results stale; expected an import statement in its code"
            )
        print(f"{PEAK}{peak_memory():.1f} MB")


def peak_memory() -> float:
    """Return the most memory that this process has had, and with it the largest child's, MB."""
    own, child = (
        resource.getrusage(who).ru_maxrss
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )
    status = Path("/proc/self/status")
    if status.exists():  # on Linux ru_maxrss is in KiB, and begins with that of the program before
        (own,) = map(int, re.findall(r"VmHWM:\s*(\d+) kB", status.read_text(encoding="utf-8")))
        return (own + child) / 1024
    return (own + child) / 1024**2


@contextmanager
def log_to(path: str) -> Iterator[TextIO]:
    """Send what is printed, and a traceback if it comes to that, to a file.

    Ctrl-C ends the process at once, without a traceback.
    """
    kept = sys.stdout, sys.stderr
    on_interrupt = signal.signal(signal.SIGINT, signal.SIG_DFL)
    with Path(path).open("w", encoding="utf-8") as log:
        sys.stdout = sys.stderr = log
        try:
            yield log
        except BaseException:
            sys.excepthook(*sys.exc_info())
            raise
        finally:
            sys.stdout, sys.stderr = kept
            signal.signal(signal.SIGINT, on_interrupt)


def value(number: float, error: float, unit: str = "", **more: Any) -> Finding:
    """Return a finding with a value, an estimate of its error, and its unit.

    For a misprint, `meant_value` and `kind` say what is meant (`findings.Finding`).
    """
    return Finding.of({"value": float(number), "error": float(error), "unit": unit, **_plain(more)})


def truth(holds: bool, **evidence: Any) -> Finding:
    """Return a finding that holds or not, with the evidence.

    For a misprint, `meant_holds` and `kind` say whether the intended form holds.
    """
    return Finding.of({"holds": bool(holds), **_plain(evidence)})


def write_table(path: str, columns: "Mapping[str, Any] | pd.DataFrame") -> None:
    """Write a table as CSV, in the digits that are justified."""
    import pandas as pd  # for 0.3 s, which steps without a table need not take

    pd.DataFrame(columns).to_csv(path, index=False, float_format=DIGITS, lineterminator="\n")


def grid(spec: Mapping[str, float]) -> "np.ndarray":
    """Return the uniform grid of a config entry with lowest, highest and points."""
    import numpy as np

    return np.linspace(spec["lowest"], spec["highest"], int(spec["points"]))


def _plain(mapping: Mapping[str, Any]) -> dict[str, Any]:
    """Return the mapping with NumPy's numbers and arrays as Python's, and findings as entries."""
    return {key: _plain_item(item) for key, item in mapping.items()}


def _plain_item(item: Any) -> Any:
    if isinstance(item, Finding):
        return dict(item.entries)
    return item.tolist() if hasattr(item, "tolist") else item
