"""No result depends on the width of the registers; without FMA, outcomes and impacts do not.

numba compiles for a CPU, which sets the width; each width has a process of its own.
"""

import json
import os
import platform
import subprocess
import sys

import numpy as np
import pytest

from topheavy.kernel.grid import FUSED, LANES

ASK = """
import json, math
import numpy as np
from topheavy import RockingBlock
from topheavy.kernel.forcing import RECORD, SHAPES, prepare_record, prepare_two_records
from topheavy.kernel.grid import FUSED, LANES, mixed_outcomes_of, outcomes_of
from topheavy.kernel.taylor import oscillator
found = []
for linearised in (False, True):
    block = oscillator(RockingBlock(1.0, math.radians(9.5), 0.9, linearised))
    scales, amplitudes = np.linspace(0.5, 9.0, 11), block.level * np.linspace(1.001, 9.0, 40)
    for name in sorted(set(SHAPES) - {"harmonic"}):
        found.append(outcomes_of(block, SHAPES[name], scales, amplitudes))
    time = 0.02 * np.arange(1000)
    waves = np.sin(2 * time) + np.sin(3.7 * time + 1) - np.sin(6.1 * time)
    record = prepare_record(block.level * waves)
    factors = np.geomspace(0.3, 5.0, 40)
    found.append(outcomes_of(block, RECORD, np.array([0.02]), factors, record))
    other = oscillator(RockingBlock(1.0, math.radians(17.0), 0.8, linearised))
    both = prepare_two_records(block.level * waves, 0.2 * np.cos(0.1 * np.arange(900)), 0.731)
    mixture = (np.arange(40) % 2, np.where(np.arange(40) % 3, 0.02, 0.031), factors)
    lifts = np.linspace(-1.0, 2.0, 40)
    for record, more in ((record, {}), (both, {"lifts": lifts})):
        found.append(mixed_outcomes_of([block, other], RECORD, *mixture, record, **more))
peaks, overturned, impacts = ([row.tobytes().hex() for row in rows] for rows in zip(*found))
print(json.dumps([LANES, FUSED, peaks, overturned, impacts]))
"""


def ask(**cpu):
    environment = {key: value for key, value in os.environ.items() if "NUMBA_CPU" not in key}
    done = subprocess.run(
        [sys.executable, "-c", ASK],
        env=environment | cpu,
        capture_output=True,
        text=True,
        check=True,
    )
    width, has_fma, peaks, overturned, impacts = json.loads(done.stdout)
    read = [np.frombuffer(bytes.fromhex(text)) for text in peaks]
    return width, has_fma, read, overturned, impacts


@pytest.fixture(scope="module")
def here():
    """The results for the CPU of this machine."""
    found = ask()
    assert found[:2] == (LANES, FUSED)
    assert any(0 < np.isnan(peaks).mean() < 1 for peaks in found[2])
    return found


@pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64") or not FUSED, reason="this CPU has one width only"
)
def test_narrow_registers_give_the_same_bits(here):
    width, has_fma, *found = ask(NUMBA_CPU_NAME="generic", NUMBA_CPU_FEATURES="+avx,+fma")
    assert width == 4
    assert width < LANES
    assert has_fma
    for one, other in zip(found[0], here[2], strict=True):
        np.testing.assert_array_equal(one, other)
    assert found[1:] == list(here[3:])


def test_cpu_of_any_kind_gives_the_same_outcomes(here):
    """The least that numba compiles for; on x86 it has neither AVX nor FMA."""
    width, has_fma, peaks, overturned, impacts = ask(NUMBA_CPU_NAME="generic")
    assert width == 4
    assert has_fma == (platform.machine() in ("aarch64", "arm64"))
    assert overturned == here[3]
    assert impacts == here[4]
    for one, other in zip(peaks, here[2], strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-6)
