"""Run a step: compute its tables, draw its findings from them as written, and write all at once."""

import json
import math
from collections.abc import Callable, Mapping
from inspect import signature
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from replication.job import ROOT, log_to, stop, write

DIGITS = "%.9g"


def run(job: Any, compute: Callable, findings: Callable | None = None) -> None:
    """Compute the tables of a rule, draw its findings from them, and write both.

    Parameters
    ----------
    job
        The object `snakemake` of a script.
    compute
        Takes, by name, tables of the rule's inputs (a table has the name of its file, or of the
        input), other named inputs as paths, and parameters of the rule. It returns the table, or a
        dictionary of tables and texts by the names of the rule's outputs.
    findings
        Takes, by name, the tables of inputs and outputs as they are in their files, and parameters
        of the rule. It returns findings by name, made by `value` and `truth`.

    Raises
    ------
    SystemExit
        When a result is not what the rule declares, or `write` refuses it.
    """
    with log_to(job.log[0]):
        params = {name: content for name, content in job.params.items() if name != "code"}
        content = call(compute, job.rule, tables_of(job.input), params)
        paths = {name: path for name, path in job.output.items() if name != "findings"}
        if not isinstance(content, Mapping) or not set(paths) <= set(content):
            content = dict.fromkeys(paths, content) if len(paths) == 1 else {}
        texts = {
            path: _text(content.get(name), path, compute, job.rule) for name, path in paths.items()
        }
        if hasattr(job.output, "findings"):
            written = {
                path: StringIO(text) for path, text in texts.items() if path.endswith(".csv")
            }
            results = call(findings, job.rule, tables_of(job.input, written), params)
            texts[job.output.findings] = findings_text(results, compute)
        write(job, texts)


def value(number: float, error: float, unit: str = "", **more: Any) -> dict[str, Any]:
    """Return a finding with a value, an estimate of its error, and its unit.

    The error is over solvers, models, samples or windows, whichever is largest. Where our copy of
    the paper differs from its premises, `meant_value` is what is meant, and `kind` the discrepancy.
    """
    return {"value": float(number), "error": float(error), "unit": unit, **_plain(more)}


def truth(holds: bool, **evidence: Any) -> dict[str, Any]:
    """Return a finding that holds or not, with evidence.

    `holds_when` says whether it holds on the `condition`; `meant_holds` whether it holds as meant,
    where our copy of the paper differs from its premises by `kind`.
    """
    return {"holds": bool(holds), **_plain(evidence)}


def check(holds: bool, message: str) -> None:
    """Stop the step unless a check of its solver holds."""
    if not holds:
        stop(f"a check of this step fails: {message}")


def grid(spec: Mapping[str, float]) -> np.ndarray:
    """Return the uniform grid of a config entry with lowest, highest and points."""
    return np.linspace(spec["lowest"], spec["highest"], int(spec["points"]))


def geometric(spec: Mapping[str, float]) -> np.ndarray:
    """Return the grid in equal ratios of a config entry with lowest, highest and points."""
    return np.geomspace(spec["lowest"], spec["highest"], int(spec["points"]))


def power_above(difference: float, tolerance: float) -> float:
    """Return the lowest power of ten above a difference of solvers and above their tolerance.

    The digits of such a difference are rounding, which depends on the processor.
    """
    return 10.0 ** math.ceil(math.log10(max(difference, tolerance)))


def call(
    function: Callable, rule: str, tables: Mapping[str, Any], params: Mapping[str, Any]
) -> Any:
    """Call a function with the tables, inputs and parameters that it takes by name."""

    def content(source: Any) -> Any:
        if isinstance(source, list):
            return [content(part) for part in source]
        if isinstance(source, StringIO):
            source.seek(0)
            return pd.read_csv(source)
        return pd.read_csv(source) if str(source).endswith(".csv") else str(source)

    wanted = list(signature(function).parameters)
    if missing := [name for name in wanted if name not in tables and name not in params]:
        stop(
            f"{where(function)}: {function.__name__} takes '{missing[0]}'; rule {rule} has the "
            f"inputs {', '.join(tables) or '(none)'} and the parameters "
            f"{', '.join(params) or '(none)'}"
        )
    return function(**{n: content(tables[n]) if n in tables else params[n] for n in wanted})


def tables_of(inputs: Any, written: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Return what a function may take by name: files by their stems, and named inputs."""
    named = dict(inputs.items()) if hasattr(inputs, "items") else {}
    paths = [str(path) for path in inputs]
    tables = {Path(path).stem: path for path in paths if path.endswith(".csv")}
    tables |= {
        name: list(paths_of) if not isinstance(paths_of, str) else paths_of
        for name, paths_of in named.items()
    }
    return tables | {Path(path).stem: source for path, source in (written or {}).items()}


def findings_text(findings: Mapping[str, Any], source: Callable) -> str:
    """Return the content of a findings file."""
    for name, finding in findings.items():
        if not isinstance(finding, dict) or not {"value", "holds"} & set(finding):
            stop(
                f"{where(source)}: the finding '{name}' is {finding!r}; "
                "expected value(…) or truth(…)"
            )
    try:
        return json.dumps(findings, indent=1, ensure_ascii=False, allow_nan=False) + "\n"
    except ValueError:
        bad = next(
            n for n, f in findings.items() if "NaN" in json.dumps(f) or "Infinity" in json.dumps(f)
        )
        stop(f"{where(source)}: the finding '{bad}' is {findings[bad]}; expected finite numbers")


def where(function: Callable) -> str:
    """Return the script of a function, from the root of the repository."""
    path = Path(function.__globals__["__file__"]).resolve()
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)


def _text(table: Any, path: str, compute: Callable, rule: str) -> str | bytes:
    if isinstance(table, str | bytes) and not path.endswith(".csv"):
        return table
    parts = table.values() if isinstance(table, Mapping) else []
    if table is None or isinstance(table, str) or any(isinstance(part, Mapping) for part in parts):
        stop(
            f"{where(compute)}: compute returned {table!r:.60} where rule {rule} declares the "
            f"table {path}. Return a pandas.DataFrame; findings(table) draws the findings from it"
        )
    return pd.DataFrame(table).to_csv(index=False, float_format=DIGITS, lineterminator="\n")


def _plain(item: Any) -> Any:
    """Return NumPy's numbers and arrays, also inside of mappings and lists, as Python's."""
    if isinstance(item, Mapping):
        return {key: _plain(part) for key, part in item.items()}
    if isinstance(item, list | tuple):
        return [_plain(part) for part in item]
    return item.tolist() if hasattr(item, "tolist") else item
