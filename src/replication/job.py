"""A job of Snakemake around its work: its log, and what it may read and write."""

import sys
import time
import traceback
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

from replication.sources import checksums, is_sealed, write_seal

BEGUN = time.time()
"""Time at which this process loaded the module, s; `replication` comes before the library."""
ROOT = Path(__file__).resolve().parents[2]
OURS = ("src", "figures")


def stop(message: str) -> NoReturn:
    """End the step with a message and without a traceback."""
    raise SystemExit(message)


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


def write(job: Any, results: Mapping[str, str | bytes], modules: Iterable[str] = ()) -> None:
    """Write the results of a job, with their seals; Snakemake removes those of a job that fails.

    `modules` are the files of modules that another process loaded for this job.

    Raises
    ------
    SystemExit
        When this process loaded a module of the repository that `code` of its rule does not name: a
        change there would leave the results stale. When a file in `code` is no longer as it was
        when the run began, or an input has another seal than its rule writes for this run.
    """
    code = job.params["code"]
    _refuse_undeclared(job, modules)
    for path, digest in code.items():
        if Path(path).is_file() and (
            checksums([path])[path] != digest or Path(path).stat().st_mtime > BEGUN
        ):
            stop(f"{path} was changed after the run began: run again")
    for path in map(str, job.input):
        if path not in code and not is_sealed(path, code.values()):
            stop(
                f"rule {job.rule} reads {path}, which its rule did not write with this code and "
                f"these parameters: rm {path}, then run again"
            )
    for path, content in results.items():
        Path(path).write_bytes(content.encode() if isinstance(content, str) else content)
    for path in map(str, job.output):
        write_seal(path, code[f"rule {job.rule}"])


def _refuse_undeclared(job: Any, modules: Iterable[str]) -> None:
    declared = {Path(path).resolve() for path in [*job.input, *job.params.get("code", [])]}
    files = {getattr(module, "__file__", None) for module in list(sys.modules.values())}
    loaded = {Path(path).resolve() for path in {*files, *modules} if path}
    inside = {path.relative_to(ROOT) for path in loaded - declared if path.is_relative_to(ROOT)}
    for path in loaded:
        if path.parts[-2:] == ("topheavy", "__init__.py") and not path.is_relative_to(ROOT):
            stop(
                f"rule {job.rule} loaded {path}, which is not in this folder: "
                "uv sync, or pip install -e ."
            )
    if gap := sorted(str(path) for path in inside if path.parts[0] in OURS):
        stop(
            f"rule {job.rule} loaded {', '.join(gap)}, which its `code` does not name: a change "
            "there would leave its results stale. Import it by a statement, or name it in `code`"
        )
