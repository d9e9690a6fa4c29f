"""How the functions of the kernel are compiled, and where numba keeps their machine code.

numba looks for changes in the file of a function only, and not in those that it calls. Hence each
state of the kernel has a folder of its own for numba's cache.
"""

import hashlib
import logging
import os
import tempfile
import warnings
from pathlib import Path
from typing import Any

import numba
from numba import types
from numba.core import event

from topheavy.bodies import free_rocking
from topheavy.ground import pulses, shapes


def cache_folder() -> Path:
    """Return `topheavy` within NUMBA_CACHE_DIR or XDG_CACHE_HOME or ~/.cache."""
    named = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    return Path(named or Path.home() / ".cache", "topheavy").absolute()


def state(sources: Path, *others: Path) -> str:
    """Return a checksum of the sources in a folder and of other files that they compile."""
    files = [*sorted(sources.rglob("*.py")), *others]
    return hashlib.sha256(b"".join(path.read_bytes() for path in files)).hexdigest()


SHARED_SOURCES = [Path(str(module.__file__)) for module in (shapes, pulses, free_rocking)]


def writable_folder() -> Path | None:
    """Return the folder of this state of the kernel, or None with a warning if there can be none.

    numba would look for another one, such as `__pycache__`, which other states share.
    """
    try:
        folder = cache_folder() / state(Path(__file__).parent, *SHARED_SOURCES)[:16]
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


class Notice(event.Listener):
    """Says by the logger "topheavy", once in a process, that a part of the solver is compiled."""

    is_given = False

    def on_start(self, event: event.Event) -> None:
        module = event.data["dispatcher"].py_func.__module__
        if self.is_given or not module.startswith("topheavy."):
            return
        self.is_given = True
        logging.getLogger("topheavy").warning(
            "This call compiles its part of the solver, for up to half a minute%s",
            f"; it is kept in {FOLDER}" if FOLDER else "",
        )

    def on_end(self, event: event.Event) -> None:
        pass


event.register("numba:compile", Notice())


def compiled(function: Any = None, **options: Any) -> Any:
    """Return the function compiled at its first call, or the decorator with these options.

    numba takes an option that is not given from the function that calls first: the last bits would
    depend on what was compiled before. Hence all options have a value here. Without `_nrt` numba
    does not count references to arrays, which would take a tenth of the time of a history. A
    function that is always inlined has no wrapper for Python, unless one is asked for.
    """
    if function is None:
        return lambda function: compiled(function, **options)
    defaults: Any = {"error_model": "numpy", "fastmath": False, "forceinline": False, "_nrt": False}
    wrappers = {"no_cfunc_wrapper": True, "no_cpython_wrapper": "forceinline" in options}
    config: Any = numba.config
    dispatcher, before = numba.njit(**defaults | wrappers | options)(function), config.CACHE_DIR
    template = dispatcher.get_call_template

    def call_template(arguments: Any, keywords: Any) -> Any:
        # Otherwise numba compiles a function once for each constant that it is called with.
        return template(tuple(map(types.unliteral, arguments)), keywords)

    dispatcher.get_call_template = call_template
    if FOLDER is None:
        return dispatcher
    config.CACHE_DIR = str(FOLDER)  # numba reads it as it enables the cache of a function
    try:
        dispatcher.enable_caching()
    finally:
        config.CACHE_DIR = before
    return dispatcher
