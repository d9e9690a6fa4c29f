"""A job of Snakemake around its work: its log, and its results written at once or not at all."""

import os
import sys
import traceback
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

PARENT = os.getppid()
"""The parent of this process when the module was loaded."""
RUN = int(os.environ.get("RUN", PARENT))
"""The process of Snakemake; the Snakefile sets the variable."""
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


def write(job: Any, made: Mapping[str, str | bytes], modules: Iterable[str] = ()) -> None:
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


def _alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except OSError:
        return False
    return True
