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

from topheavy.kernel.step import HALT, working_array

Result = TypeVar("Result")

#: Histories of fewer samples, all together, are over within a second or two, whatever happens.
MIN_THREADED_SAMPLES = 100_000


def in_threads(
    calls: Sequence[Callable[[NDArray[np.float64]], Result]], threads: int = 1
) -> list[Result]:
    """Return what the calls return; each thread takes the next and gives it its working array.

    Whatever ends the wait halts the histories under way at their next step, and all that follow at
    their first.
    """
    results: dict[int, Result] = {}
    waiting = enumerate(calls)
    arrays = [working_array() for _ in range(threads)]

    def work(w: NDArray[np.float64]) -> None:
        for number, call in waiting:
            results[number] = call(w)

    with ThreadPoolExecutor(threads) as pool:
        try:
            for done in [pool.submit(work, w) for w in arrays]:
                done.result()
        except BaseException:
            for w in arrays:
                w[HALT, 0] = 1.0
            raise
    return [results[number] for number in range(len(calls))]
