"""How the functions of the kernel are compiled, and where numba keeps their machine code.

numba looks for changes in the file of a function only, and not in those that it calls. Hence each
state of the kernel has a folder of its own for numba's cache.
"""

import hashlib
import os
import tempfile
import warnings
from pathlib import Path
from typing import Any

import numba

from topheavy.bodies import free_rocking
from topheavy.ground import shapes


def cache_folder() -> Path:
    """Return `topheavy` within NUMBA_CACHE_DIR or XDG_CACHE_HOME or ~/.cache."""
    named = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    return Path(named or Path.home() / ".cache", "topheavy").absolute()


def state(sources: Path, *others: Path) -> str:
    """Return a checksum of the sources in a folder and of other files that they compile."""
    files = [*sorted(sources.rglob("*.py")), *others]
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()


OTHERS = Path(shapes.__file__), Path(free_rocking.__file__)


def writable_folder() -> Path | None:
    """Return the folder of this state of the kernel, or None with a warning if there can be none.

    numba would look for another one, such as `__pycache__`, which no other state of the kernel has.
    """
    try:
        folder = cache_folder() / state(Path(__file__).parent, *OTHERS)[:16]
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except (OSError, RuntimeError) as error:  # RuntimeError: the user has no home
        warnings.warn(
            f"the compiled solver cannot be kept ({error}), so that each process compiles it "
            "again: set NUMBA_CACHE_DIR to a folder that can be written",
            stacklevel=2,
        )
        return None
    return folder


FOLDER = writable_folder()


def compiled(function: Any = None, **options: Any) -> Any:
    """Return the function compiled at its first call, or the decorator with these options.

    An option that a function leaves open it takes from whichever function is first to call it: the
    last bits would then depend on what was compiled before. Hence all have a value here. Without
    `_nrt` numba does not count the references to arrays, by atomic operations that take a tenth of
    the time of a history. A function that makes an array needs it, and is called by Python alone.
    """
    if function is None:
        return lambda function: compiled(function, **options)
    given: Any = {"error_model": "numpy", "fastmath": False, "forceinline": False, "_nrt": False}
    config: Any = numba.config
    dispatcher, before = numba.njit(**given | options)(function), config.CACHE_DIR
    if FOLDER is None:
        return dispatcher
    config.CACHE_DIR = str(FOLDER)  # numba reads it as it enables the cache of a function
    try:
        dispatcher.enable_caching()
    finally:
        config.CACHE_DIR = before
    return dispatcher
