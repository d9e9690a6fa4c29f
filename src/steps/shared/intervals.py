"""Sets of amplitudes: arrays of disjoint intervals that ascend, shape (n, 2)."""

import numpy as np


def length(intervals: np.ndarray) -> float:
    return float(np.sum(intervals[:, 1] - intervals[:, 0]))


def overlap(first: np.ndarray, second: np.ndarray) -> float:
    """Return the length that two sets have in common."""
    low = np.maximum(first[:, None, 0], second[None, :, 0])
    high = np.minimum(first[:, None, 1], second[None, :, 1])
    return float(np.maximum(high - low, 0.0).sum())


def without(first: np.ndarray, second: np.ndarray) -> list[tuple[float, float]]:
    """Return the part of a set that is not in another; adjacent pieces are not merged."""
    pieces, others = [], second.tolist()
    for low, high in first.tolist():
        for begin, end in others:
            if end > low and begin < high:
                if begin > low:
                    pieces.append((low, begin))
                low = end
        if low < high:
            pieces.append((low, high))
    return pieces


def inside(intervals: np.ndarray, amplitudes: np.ndarray) -> np.ndarray:
    low, high = intervals[:, 0, None], intervals[:, 1, None]
    return np.any((low <= amplitudes) & (amplitudes <= high), axis=0)
