"""How the functions of the kernel are compiled, and where their machine code is kept.

numba's own cache is bound to the path of a file, looks at the file of a function only, and may pair
the machine code of one process with the index of another. This one has a folder for each state of
the kernel and of what compiles it, and a file for each function and its types: all copies of the
same code share it.
"""

import hashlib
import os
import pickle
import platform
import sys
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import llvmlite
import numba
import numpy as np
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

from topheavy import checks
from topheavy.ground import shapes

_DIGEST = hashlib.sha256().digest_size


def cache_folder() -> Path:
    """Return the folder of all compiled code.

    It is `topheavy` in the folder that NUMBA_CACHE_DIR names, or XDG_CACHE_HOME, or in `~/.cache`.
    """
    named = os.environ.get("NUMBA_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    return Path(named or Path.home() / ".cache", "topheavy").absolute()


def state(sources: Path, numbers: Path) -> str:
    """Return a checksum of the sources in a folder, of the file of numbers, and of what compiles.

    `ground/shapes.py` is such a file, as the machine code contains its numbers. Of the variables of
    numba all but the folder of its cache may change the machine code.
    """
    files = [(path.relative_to(sources).as_posix(), path) for path in sources.rglob("*.py")]
    texts = [(name, path.read_bytes()) for name, path in sorted([*files, ("", numbers)])]
    versions = (numba.__version__, llvmlite.__version__, np.__version__, platform.python_version())
    options = {name: value for name, value in os.environ.items() if name.startswith("NUMBA_")}
    options.pop("NUMBA_CACHE_DIR", None)
    return hashlib.sha256(repr((texts, versions, sorted(options.items()))).encode()).hexdigest()


class _FolderCache(_Cache):
    """The machine code of a function, in a file for each tuple of types and each CPU.

    The content of a file begins with a checksum of what it was compiled for and of the rest. A file
    of which it does not hold is compiled anew and replaced. A file is replaced as a whole, so that
    several processes may write at once.
    """

    def __init__(self, function: Any, folder: Path) -> None:
        self.name = f"{function.__module__}.{function.__qualname__}"
        self.folder = folder

    @property
    def cache_path(self) -> str:
        return str(self.folder)

    def enable(self) -> None: ...

    def disable(self) -> None: ...

    def flush(self) -> None: ...

    def _key(self, types: Any, codegen: Any) -> tuple[bytes, Path]:
        """Return what a file is for, and its path."""
        key = repr((self.folder.name, self.name, types, codegen.magic_tuple())).encode()
        return key, self.folder / f"{self.name}-{hashlib.sha256(key).hexdigest()[:16]}.machine"

    def load_overload(self, types: Any, context: Any) -> Any:
        """Return the compiled function for these types and this CPU, or None."""
        context.refresh()
        key, path = self._key(types, context.codegen())
        try:
            if _is_others(self.folder):
                return None
            content = path.read_bytes()
        except OSError:
            _say_once(self.name)
            return None
        if content[:_DIGEST] != hashlib.sha256(key + content[_DIGEST:]).digest():
            return None
        return CompileResult._rebuild(context, *pickle.loads(content[_DIGEST:]))

    def save_overload(self, types: Any, result: Any) -> None:
        """Keep a compiled function; a folder that cannot be written costs the next process time."""
        if result.library.has_dynamic_globals or _is_others(self.folder):
            return  # addresses of this process; what somebody else may have written
        key, path = self._key(types, result.codegen)
        code = dumps(result._reduce())
        try:
            self.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
            with TemporaryDirectory(dir=self.folder) as mine:
                file = Path(mine, "machine")
                file.write_bytes(hashlib.sha256(key + code).digest() + code)
                file.replace(path)
        except OSError as error:
            _warn(f"the compiled kernel is not kept in {self.folder} ({error.strerror})")


def _is_others(folder: Path) -> bool:
    """Return, with a warning, whether another user may have written in a folder."""
    if not hasattr(os, "getuid") or not folder.exists():
        return False
    found = folder.stat()
    if is_others := found.st_uid not in (0, os.getuid()) or bool(found.st_mode & 0o022):
        _warn(f"others can write to {folder}, so no compiled kernel is taken from it")
    return is_others


@cache
def _warn(reason: str) -> None:
    """Warn once a process: each function of the kernel meets the same folder."""
    checks.warn(
        f"{reason}; name a folder that you alone can write in NUMBA_CACHE_DIR, or each process "
        "compiles anew"
    )


SLOW = tuple(f"topheavy.kernel.{name}." for name in ("lanes", "outcome", "trace"))
"""Modules whose functions take seconds to compile."""


@cache
def _say() -> None:
    text = "topheavy compiles its kernel, once on this machine: up to 20 s"
    print(text, file=sys.stderr, flush=True)


def _say_once(function: str) -> None:
    """Say on stderr that this process compiles, if that takes seconds; of all of it one time."""
    if function.startswith(SLOW):
        _say()


FOLDER = cache_folder() / state(Path(__file__).parent, Path(shapes.__file__))[:16]


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
    dispatcher = numba.njit(**given | options)(function)
    dispatcher._cache = _FolderCache(function, FOLDER)
    return dispatcher
