"""Turn the source's series into those of data/: python prepare.py test_011.txt test_012.txt ..."""

import sys
from pathlib import Path

import numpy as np
from scipy.signal import butter, sosfiltfilt
from simulate import UNIT


def prepared(acceleration):
    """Return accelerations (g, 800 Hz) without what is above 35 Hz, at 100 Hz, in units of UNIT."""
    series = sosfiltfilt(butter(4, 35.0, fs=800.0, output="sos"), acceleration)[::8]
    return np.round((series - np.median(series)) / UNIT).astype(np.int16)


if __name__ == "__main__":
    series = {Path(path).stem: prepared(np.loadtxt(path, usecols=1)) for path in sys.argv[1:]}
    np.savez_compressed("accelerations.npz", **series)
