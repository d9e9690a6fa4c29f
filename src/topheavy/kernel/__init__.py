"""The compiled kernel: Taylor steps with proven events. It knows arrays and floats, no structures.

Time is τ = p t throughout, so that p is in none of its formulas. The layers above are
`topheavy.simulate`, which follows one history (`outcome`, `trace`), and `topheavy.overturning`,
which follows many at once in the vector registers of the CPU (`grid`, the door to `lanes`).
"""

import hashlib
import os
from pathlib import Path

from numba import config

from topheavy import shapes

_HERE = Path(__file__).parent


def _load() -> None:
    """Import the modules with a cache of their own for this very state of the code.

    numba's cache looks at the file of a function only: after a change of what it calls, in another
    file, it would go on with the old machine code. `topheavy.shapes` is among the sources, as the
    machine code contains its numbers. The cache is in the folder that the environment variable
    NUMBA_CACHE_DIR names, or beside the modules.
    """
    files = [*sorted(_HERE.rglob("*.py")), Path(shapes.__file__)]
    sources = b"".join(path.read_bytes() for path in files)
    before = config.CACHE_DIR  # type: ignore[attr-defined]
    cache = Path(before or _HERE / "__pycache__", hashlib.sha256(sources).hexdigest()[:16])
    if before or os.access(_HERE, os.W_OK):
        config.CACHE_DIR = str(cache)  # type: ignore[attr-defined]
    try:
        from topheavy.kernel import (  # noqa: F401
            bernstein,
            forcing,
            grid,
            interrupt,
            march,
            outcome,
            rest,
            tail,
            taylor,
            trace,
        )
        from topheavy.kernel.lanes import pulses, records, steps, vectors  # noqa: F401
    finally:
        config.CACHE_DIR = before  # type: ignore[attr-defined]


_load()
