"""Long calls of the compiled kernel, which Ctrl-C ends.

Compiled code does not look for signals, and Python only between its own instructions. Hence a long
call runs in threads that hold no lock of Python's, while the main thread waits for them: a wait
that a signal ends.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from topheavy.kernel.outcome import HALT, working_array

Found = TypeVar("Found")

#: Histories of fewer samples, all together, are over within a second or two, whatever happens.
LONG = 100_000


def in_threads(
    calls: Sequence[Callable[[NDArray[np.float64]], Found]], threads: int = 1
) -> list[Found]:
    """Return what the calls return, each given a working array of its own.

    Whatever ends the wait halts the histories under way at their next step; calls that have not
    begun do not begin.
    """
    arrays = [working_array() for _ in calls]
    with ThreadPoolExecutor(threads) as pool:
        try:
            return list(pool.map(lambda call, array: call(array), calls, arrays))
        except BaseException:
            for array in arrays:
                array[HALT, 0] = 1.0
            raise
