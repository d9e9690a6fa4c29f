"""Run a step: compute its tables, draw its findings from them as written, and write all at once."""

import json
import math
import os
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from inspect import signature
from io import StringIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    import numpy as np

PARENT = os.getppid()
"""The parent of this process when the module was loaded."""
RUN = int(os.environ.get("RUN", PARENT))
"""The process of Snakemake; the Snakefile sets the variable."""
ROOT = Path(__file__).resolve().parents[2]
OURS = ("src", "figures")
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
        When a result is not what the rule declares, or `publish` refuses it.
    """
    with log_to(job.log[0]):
        params = {name: content for name, content in job.params.items() if name != "code"}
        made = call(compute, job.rule, tables_of(job.input), params)
        names = [name for name, _ in job.output.items() if name != "findings"]
        if not isinstance(made, Mapping) or not set(names) <= set(made):
            made = dict.fromkeys(names, made) if len(names) == 1 else {}
        texts = {
            path: _text(made.get(name), path, compute, job.rule)
            for name, path in job.output.items()
            if name != "findings"
        }
        if hasattr(job.output, "findings"):
            written = {
                path: StringIO(text) for path, text in texts.items() if path.endswith(".csv")
            }
            results = call(findings, job.rule, tables_of(job.input, written), params)
            texts[job.output.findings] = findings_text(results, compute)
        publish(job, texts)


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


def grid(spec: Mapping[str, float]) -> "np.ndarray":
    """Return the uniform grid of a config entry with lowest, highest and points."""
    import numpy as np

    return np.linspace(spec["lowest"], spec["highest"], int(spec["points"]))


def geometric(spec: Mapping[str, float]) -> "np.ndarray":
    """Return the grid in equal ratios of a config entry with lowest, highest and points."""
    import numpy as np

    return np.geomspace(spec["lowest"], spec["highest"], int(spec["points"]))


def power_above(difference: float, tolerance: float) -> float:
    """Return the lowest power of ten above a difference of solvers and above their tolerance.

    The digits of such a difference are rounding, which depends on the processor.
    """
    return 10.0 ** math.ceil(math.log10(max(difference, tolerance)))


def stop(message: str) -> NoReturn:
    """End the step with a message and without a traceback."""
    raise SystemExit(message)


def call(
    function: Callable, rule: str, tables: Mapping[str, Any], params: Mapping[str, Any]
) -> Any:
    """Call a function with the tables, inputs and parameters that it takes by name."""
    import pandas as pd

    def content(source: Any) -> Any:
        if isinstance(source, list):
            return [content(each) for each in source]
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


def publish(job: Any, made: Mapping[str, str | bytes], modules: Iterable[str] = ()) -> None:
    """Write files beside their places and rename them.

    `modules` are the files of modules that another process loaded for this job.

    Raises
    ------
    SystemExit
        When this process loaded a module of the repository that `code` of its rule does not name: a
        change there would leave the results stale. When the run that began the step has ended:
        a later run may have written these files already.
    """
    declared = {Path(path).resolve() for path in [*job.input, *job.params.get("code", [])]}
    files = {getattr(module, "__file__", None) for module in list(sys.modules.values())}
    loaded = {Path(path).resolve() for path in {*files, *modules} if path}
    inside = {path.relative_to(ROOT) for path in loaded - declared if path.is_relative_to(ROOT)}
    other = sorted(
        str(p)
        for p in loaded
        if p.parts[-2:] == ("topheavy", "__init__.py") and not p.is_relative_to(ROOT)
    )
    if other:
        stop(
            f"rule {job.rule} loaded {other[0]}, which is not in this folder: "
            "uv sync, or pip install -e ."
        )
    if gap := sorted(str(path) for path in inside if path.parts[0] in OURS):
        stop(
            f"rule {job.rule} loaded {', '.join(gap)}, which its `code` does not name: a change "
            "there would leave its results stale. Import it by a statement, or name it in `code`"
        )
    if os.getppid() != PARENT or not _alive(RUN):
        stop("the run that began this step has ended: nothing is written")
    new = {path: f"{path}.{os.getpid()}.new" for path in made}
    for path in made:
        for left in Path(path).parent.glob(f"{Path(path).name}.*.new"):
            if not _alive(int(left.name.split(".")[-2])):  # by a process that was killed
                left.unlink()
    try:
        for path, content in made.items():
            Path(new[path]).write_bytes(content.encode() if isinstance(content, str) else content)
        for path in made:
            os.replace(new[path], path)
    finally:
        for path in new.values():
            Path(path).unlink(missing_ok=True)


@contextmanager
def log_to(path: str) -> Iterator[None]:
    """Send what is printed, and the error if it comes to that, to the log that Snakemake shows."""
    kept = sys.stdout, sys.stderr
    with Path(path).open("w", encoding="utf-8") as log:
        sys.stdout = sys.stderr = log
        try:
            yield
        except SystemExit as error:
            print(error.code)
            raise SystemExit(1) from None
        except Exception:
            traceback.print_exc()
            raise SystemExit(1) from None
        finally:
            sys.stdout, sys.stderr = kept


def where(function: Callable) -> str:
    """Return the script of a function, from the root of the repository."""
    path = Path(function.__globals__["__file__"]).resolve()
    return str(path.relative_to(ROOT)) if path.is_relative_to(ROOT) else str(path)


def _text(made: Any, path: str, compute: Callable, rule: str) -> str | bytes:
    import pandas as pd

    if isinstance(made, str | bytes) and not path.endswith(".csv"):
        return made
    columns = made.values() if isinstance(made, Mapping) else []
    if made is None or isinstance(made, str) or any(isinstance(one, Mapping) for one in columns):
        stop(
            f"{where(compute)}: compute returned {made!r:.60} where rule {rule} declares the table "
            f"{path}. Return a pandas.DataFrame; findings(table) draws the findings from it"
        )
    return pd.DataFrame(made).to_csv(index=False, float_format=DIGITS, lineterminator="\n")


def _alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except OSError:
        return False
    return True


def _plain(item: Any) -> Any:
    """Return NumPy's numbers and arrays, also inside of mappings and lists, as Python's."""
    if isinstance(item, Mapping):
        return {key: _plain(each) for key, each in item.items()}
    if isinstance(item, list | tuple):
        return [_plain(each) for each in item]
    return item.tolist() if hasattr(item, "tolist") else item
