"""What is compiled is kept between processes, and no result depends on the width of registers.

numba compiles for a CPU, which sets the width; each width has a process of its own.
"""

import json
import os
import platform
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from hashlib import sha256
from pathlib import Path

import numba
import numpy as np
import pytest

import topheavy
from topheavy.kernel.compiled import _FolderCache, cache_folder, state
from topheavy.kernel.grid import FUSED, LANES

PACKAGE = Path(topheavy.__file__).parent


#: The rate of the push of a one-sine at its beginning; `trace` asks `forcing` for the ground.
ASK = """
import json, topheavy.kernel.compiled as compiled
from topheavy import RockingBlock
from topheavy.kernel.forcing import NO_RECORD, ONE_SINE, Forcing
from topheavy.kernel.taylor import oscillator
from topheavy.kernel.trace import _initial_state as first
pulse = Forcing(ONE_SINE, 0.3, 1.0, 6.0, 1.0, 0.0)
found = first(oscillator(RockingBlock(2.0, 0.2, 0.9, True)), pulse, NO_RECORD, 0.0, 0.0, 1.0)
hits = sum(first.stats.cache_hits.values())
print(json.dumps([compiled.__file__, str(compiled.FOLDER), found.rate, hits]))
"""


def ask(home: Path, cache: Path) -> tuple[float, int]:
    """Import the package of `home` in a process of its own: its answer, and what it had cached."""
    environment = {key: value for key, value in os.environ.items() if "NUMBA" not in key}
    done = subprocess.run(
        [sys.executable, "-c", ASK],
        env=environment | {"PYTHONPATH": str(home), "XDG_CACHE_HOME": str(cache)},
        cwd=home,
        capture_output=True,
        text=True,
        check=True,
    )
    where, folder, rate, hits = json.loads(done.stdout)
    assert Path(where).is_relative_to(home)
    assert Path(folder).parent == cache / "topheavy"
    assert any(Path(folder).iterdir())
    return rate, hits


def copied(to: Path) -> Path:
    skipped = shutil.ignore_patterns("__pycache__", "derivation")
    shutil.copytree(PACKAGE, to / "topheavy", ignore=skipped)
    return to


def test_copies_share_what_is_compiled_until_a_file_that_it_calls_changes(tmp_path):
    one, other, cache = copied(tmp_path / "one"), copied(tmp_path / "other"), tmp_path / "cache"
    assert ask(one, cache) == (-0.3, 0)
    assert ask(other, cache) == (-0.3, 1)

    forcing = other / "topheavy" / "kernel" / "forcing.py"
    source = forcing.read_text(encoding="utf-8")
    there = "return forcing.amplitude * value, forcing.amplitude * forcing.frequency * rate"
    assert source.count(there) == 1
    forcing.write_text(source.replace(there, there + " * 2"), encoding="utf-8")
    assert ask(other, cache) == (-0.6, 0)
    assert ask(one, cache) == (-0.3, 1)


@pytest.mark.parametrize("changed", ["kernel/rest.py", "kernel/lanes/steps.py", "ground/shapes.py"])
def test_change_of_any_source_is_another_state(tmp_path, changed):
    package = copied(tmp_path) / "topheavy"
    before = state(package / "kernel", package / "ground/shapes.py")
    assert before == state(PACKAGE / "kernel", PACKAGE / "ground/shapes.py")
    (package / changed).write_bytes((package / changed).read_bytes() + b"\n")
    assert state(package / "kernel", package / "ground/shapes.py") != before


def test_folder_is_where_the_user_keeps_caches(monkeypatch, tmp_path):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    monkeypatch.delenv("NUMBA_CACHE_DIR", raising=False)
    assert cache_folder() == tmp_path / "home" / ".cache" / "topheavy"
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "xdg"))
    assert cache_folder() == tmp_path / "xdg" / "topheavy"
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "numba"))
    assert cache_folder() == tmp_path / "numba" / "topheavy"


def one_more(x):
    return x + 1


def kept_in(folder, function=one_more):
    """Return the function, compiled at its first call or loaded, and whether it was loaded."""
    dispatcher = numba.njit(function)
    dispatcher._cache = _FolderCache(function, folder)
    return dispatcher(1), sum(dispatcher.stats.cache_hits.values()) == 1


def test_damaged_file_is_compiled_anew_and_replaced(tmp_path):
    assert kept_in(tmp_path) == (2, False)
    (file,) = tmp_path.iterdir()
    whole = file.read_bytes()
    for damaged in (b"", whole[:-1], whole[:40], whole[:-9] + b"x" + whole[-8:]):
        file.write_bytes(damaged)
        assert kept_in(tmp_path) == (2, False)
        assert kept_in(tmp_path) == (2, True)


def test_processes_that_write_at_once_leave_whole_files(tmp_path):
    """A reader finds the whole of what one of the writers left, whenever it looks."""
    functions = [numba.njit(one_more) for _ in range(2)]
    results = [next(iter(f.overloads.values())) for f in functions if f(1)]
    cache, types, context = _FolderCache(one_more, tmp_path), (numba.int64,), functions[0].targetctx
    cache.save_overload(types, results[0])
    (file,) = tmp_path.iterdir()
    key = cache._key(types, context.codegen())[0]

    def write(result):
        for _ in range(100):
            cache.save_overload(types, result)

    contents = []
    with ThreadPoolExecutor(2) as pool:
        doing = [pool.submit(write, result) for result in results]
        while not all(each.done() for each in doing):
            contents.append(file.read_bytes())
    assert [each.result() for each in doing] == [None, None]
    assert {content[:32] == sha256(key + content[32:]).digest() for content in contents} == {True}
    assert cache.load_overload(types, context).signature == results[0].signature


def test_folder_that_cannot_be_written_is_named(tmp_path):
    blocked = tmp_path / "file"
    blocked.write_text("", encoding="utf-8")
    with pytest.warns(UserWarning, match=f"not kept in {blocked / 'state'} .*NUMBA_CACHE_DIR"):
        assert kept_in(blocked / "state") == (2, False)


@pytest.mark.parametrize("mode", [0o720, 0o702])
def test_folder_that_others_can_write_is_neither_read_nor_written(tmp_path, mode):
    folder = tmp_path / f"{mode:o}"
    assert [kept_in(folder) for _ in range(2)] == [(2, False), (2, True)]
    folder.chmod(mode)
    before = sorted(folder.iterdir())
    with pytest.warns(UserWarning, match=f"others can write to {folder}, .*NUMBA_CACHE_DIR"):
        assert not kept_in(folder)[1]
    assert sorted(folder.iterdir()) == before


ASK_WIDTH = """
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
    found = ask_width()
    assert found[:2] == (LANES, FUSED)
    assert any(0 < np.isnan(peaks).mean() < 1 for peaks in found[2])
    return found


@pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64") or not FUSED, reason="this CPU has one width only"
)
def test_narrow_registers_give_the_same_bits(here):
    width, has_fma, *found = ask_width(NUMBA_CPU_NAME="generic", NUMBA_CPU_FEATURES="+avx,+fma")
    assert width == 4
    assert width < LANES
    assert has_fma
    for one, other in zip(found[0], here[2], strict=True):
        np.testing.assert_array_equal(one, other)
    assert found[1:] == list(here[3:])


def test_cpu_of_any_kind_gives_the_same_outcomes(here):
    """The least that numba compiles for; on x86 it has neither AVX nor FMA."""
    width, has_fma, peaks, overturned, impacts = ask_width(NUMBA_CPU_NAME="generic")
    assert width == 4
    assert has_fma == (platform.machine() in ("aarch64", "arm64"))
    assert overturned == here[3]
    assert impacts == here[4]
    for one, other in zip(peaks, here[2], strict=True):
        np.testing.assert_allclose(one, other, rtol=0, atol=1e-6)
