"""How the functions of the kernel are compiled."""

from functools import partial
from typing import Any

from numba import njit

#: A decorator. An option that a function leaves open it takes from whichever function is first to
#: call it: the last bits would then depend on what was compiled before.
compiled: Any = partial(njit, cache=True, error_model="numpy", fastmath=False, forceinline=False)
