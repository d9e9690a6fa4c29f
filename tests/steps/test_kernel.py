"""The solver is compiled by one job, before any other needs it."""

import subprocess
import sys

from tests.cases import ROOT

REST = """
import sys
sys.path.insert(0, "src")
import numpy as np
from numba.extending import is_jitted
from steps.kernel import COLUMN, PULSE, RECORD, compute
from topheavy import overturned_by, overturning_intervals, overturning_map, simulate

def compiled():
    kernel = [m for name, m in sys.modules.items() if name.startswith("topheavy.kernel.")]
    functions = {f for module in kernel for f in vars(module).values() if is_jitted(f)}
    return {(f.__name__, str(types)) for f in functions for types in f.signatures}

compute()
before = compiled()
frequencies, amplitudes = np.linspace(4.0, 8.0, 3), np.array([0.2, 0.3])
overturning_map(COLUMN.block().linear(), "one-cosine", frequencies, amplitudes)
overturning_map(COLUMN, "one-sine", frequencies[::2], 0.3)
for motion in (PULSE, RECORD):
    overturning_intervals(COLUMN, motion, (0.5, 4.0), resolution=0.5)
    overturned_by(COLUMN, motion, [0.5, 2.0])
    simulate(COLUMN.block().linear(), motion, samples=10)
print(*sorted(name for name, _ in compiled() - before))
"""


def test_one_job_compiles_all_of_the_kernel():
    done = subprocess.run(
        [sys.executable, "-c", REST], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert done.stdout == "\n"
