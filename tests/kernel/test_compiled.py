"""What is compiled is kept between processes, and no result depends on the width of registers.

numba compiles for a CPU, which sets the width; each width has a process of its own.
"""

import json
import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import topheavy
from topheavy.kernel.compiled import cache_folder, state, writable_folder
from topheavy.kernel.lanes.vectors import HAS_FMA, WIDTH

PACKAGE, OTHER = Path(topheavy.__file__).parent, "bodies/free_rocking.py"


ASK = """
from topheavy.kernel.rest import next_tick
next_tick(1.0)
print(sum(next_tick.stats.cache_hits.values()))
"""


def test_next_process_finds_what_one_has_compiled(tmp_path):
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path)}
    command = [sys.executable, "-c", ASK]
    hits = [subprocess.check_output(command, env=environment, text=True) for _ in range(2)]
    assert [*map(int, hits)] == [0, 1]


@pytest.mark.parametrize(
    "changed", ["kernel/rest.py", "kernel/lanes/steps.py", "ground/shapes.py", OTHER]
)
def test_change_of_any_source_is_another_state(tmp_path, changed):
    package = tmp_path / "topheavy"
    shutil.copytree(PACKAGE, package)

    def now(folder):
        return state(folder / "kernel", folder / "ground/shapes.py", folder / OTHER)

    before = now(package)
    assert before == now(PACKAGE)
    (package / changed).write_bytes((package / changed).read_bytes() + b"\n")
    assert now(package) != before


def test_folder_is_where_the_user_keeps_caches(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    assert cache_folder() == tmp_path / "home" / ".cache" / "topheavy"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache_folder() == tmp_path / "xdg" / "topheavy"
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "numba"))
    assert cache_folder() == tmp_path / "numba" / "topheavy"


def test_without_a_folder_to_write_to_nothing_is_kept(monkeypatch, tmp_path):
    (tmp_path / "file").touch()
    command = [sys.executable, "-c", ASK]
    environment = os.environ | {"NUMBA_CACHE_DIR": str(tmp_path / "file")}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr.count("cannot be kept")) == ("0\n", 1)

    def no_home():
        raise RuntimeError("Could not determine home directory.")

    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    monkeypatch.setattr(Path, "home", no_home)
    with pytest.warns(UserWarning, match="Could not determine home .* set NUMBA_CACHE_DIR"):
        assert writable_folder() is None


ASK_WIDTH = """
import json, math
import numpy as np
from topheavy import RockingBlock
from topheavy.kernel.forcing import RECORD, SHAPES, prepare_record
from topheavy.kernel.grid import outcomes_of
from topheavy.kernel.lanes.vectors import HAS_FMA, WIDTH
from topheavy.kernel.taylor import oscillator
found = []
for linearised in (False, True):
    block = oscillator(RockingBlock(1.0, math.radians(9.5), 0.9, linearised))
    scales, amplitudes = np.linspace(0.5, 9.0, 11), block.level * np.linspace(1.001, 9.0, 40)
    cells = np.zeros(440, int), np.repeat(scales, 40), np.tile(amplitudes, 11)
    for name in sorted(set(SHAPES) - {"harmonic"}):
        found.append(outcomes_of([block], SHAPES[name], *cells))
    time = 0.02 * np.arange(1000)
    waves = np.sin(2 * time) + np.sin(3.7 * time + 1) - np.sin(6.1 * time)
    record = prepare_record(block.level * waves)
    factors = np.geomspace(0.3, 5.0, 40)
    other = oscillator(RockingBlock(1.0, math.radians(17.0), 0.8, linearised))
    both = prepare_record(block.level * waves, 0.2 * np.cos(0.1 * np.arange(900)), 0.731)
    mixture = (np.arange(40) % 2, np.where(np.arange(40) % 3, 0.02, 0.031), factors)
    lifts = np.linspace(-1.0, 2.0, 40)
    for record, more in ((record, {}), (both, {"lifts": lifts})):
        found.append(outcomes_of([block, other], RECORD, *mixture, record, **more))
peaks, overturned, impacts = ([row.tobytes().hex() for row in rows] for rows in zip(*found))
print(json.dumps([WIDTH, HAS_FMA, peaks, overturned, impacts]))
"""


def ask_width(**cpu):
    environment = {key: value for key, value in os.environ.items() if "NUMBA_CPU" not in key}
    done = subprocess.run(
        [sys.executable, "-c", ASK_WIDTH],
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
    results = ask_width()
    assert results[:2] == (WIDTH, HAS_FMA)
    assert any(0 < np.isnan(peaks).mean() < 1 for peaks in results[2])
    return results


@pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64") or not HAS_FMA,
    reason="this CPU has one width only",
)
def test_narrow_registers_give_the_same_bits(here):
    width, has_fma, *results = ask_width(NUMBA_CPU_NAME="generic", NUMBA_CPU_FEATURES="+avx,+fma")
    assert width == 4
    assert width < WIDTH
    assert has_fma
    for one, other in zip(results[0], here[2], strict=True):
        np.testing.assert_array_equal(one, other)
    assert results[1:] == list(here[3:])


def test_cpu_of_any_kind_gives_the_same_outcomes(here):
    """The least that numba compiles for; on x86 it has neither AVX nor FMA."""
    width, has_fma, peaks, overturned, impacts = ask_width(NUMBA_CPU_NAME="generic")
    assert width == 4
    assert has_fma == (platform.machine() in ("aarch64", "arm64"))
    assert overturned == here[3]
    assert impacts == here[4]
    for one, other in zip(peaks, here[2], strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-6)
