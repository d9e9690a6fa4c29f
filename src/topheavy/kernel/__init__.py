"""The compiled kernel: Taylor steps with proven events. It knows arrays and floats, no structures.

Time is τ = p t throughout, so that p is in none of its formulas. The layers above are
`topheavy.simulate`, which follows one history (`outcome`, `trace`), and `topheavy.overturning`,
which follows many at once in the vector registers of the CPU (`lanes` and what builds on it).
"""

import hashlib
import os
from pathlib import Path

from numba import config

_HERE = Path(__file__).parent


def _load() -> None:
    """Import the modules with a cache of their own for this very state of the code.

    numba's cache looks at the file of a function only: after a change of what it calls, in another
    file, it would go on with the old machine code. The cache is in the folder that the environment
    variable NUMBA_CACHE_DIR names, or beside the modules.
    """
    sources = b"".join(path.read_bytes() for path in sorted(_HERE.glob("*.py")))
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
            lane_steps,
            lanes,
            march,
            outcome,
            pulse_batch,
            record_batch,
            rest,
            tail,
            taylor,
            trace,
        )
    finally:
        config.CACHE_DIR = before  # type: ignore[attr-defined]


_load()
