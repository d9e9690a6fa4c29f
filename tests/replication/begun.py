"""Runs of Snakemake that begin with its modules imported, which else is half of a short run.

One process imports them for all runs of a test process; each run is a fork of it.
"""

import atexit
import os
import runpy
import signal
import sys
import time
from collections.abc import Mapping
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from select import select

from snakemake.executors import touch

ROOT = Path(__file__).parents[2]
SERVER = get_context("forkserver")
LATER = ["snakemake.report.html_reporter", "jsonschema", "pandas", "smart_open", "yte"]
"""What Snakemake imports when it is asked to do something."""
SERVER.set_forkserver_preload(["snakemake.cli", *LATER])


class Run:
    """What `python -m module options` in a folder begins, in a session of its own."""

    def __init__(
        self,
        folder: Path,
        *options: str,
        module: str = "snakemake",
        env: Mapping[str, str] = os.environ,
    ) -> None:
        self._out, out = SERVER.Pipe(duplex=False)
        given = (module, options, str(folder), dict(env), out)
        self.process = SERVER.Process(target=_main, args=given, daemon=False)
        self.process.start()
        out.close()

    def communicate(self, timeout: float = 120.0) -> tuple[int | None, str]:
        """Wait for the end of the run and of all that it began; return its status, what it said."""
        said, until = b"", time.monotonic() + timeout
        while select([self._out], [], [], max(0.0, until - time.monotonic()))[0]:
            if not (part := os.read(self._out.fileno(), 1 << 16)):
                self.process.join()
                return self.process.exitcode, said.decode()
            said += part
        raise TimeoutError(f"the run has not ended after {timeout} s; it said\n{said.decode()}")


def _main(
    module: str, options: tuple[str, ...], folder: str, env: dict[str, str], out: Connection
) -> None:
    """Be the process that a new Python would be."""
    os.setsid()  # as a terminal, whose signals reach all processes
    for number in (1, 2):
        os.dup2(out.fileno(), number)
    out.close()
    signal.signal(signal.SIGINT, signal.default_int_handler)  # also under nohup, as the next
    signal.signal(signal.SIGHUP, signal.SIG_DFL)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(env)
    for name in [name for name in sys.modules if name.partition(".")[0] == "replication"]:
        del sys.modules[name]  # the folder may have its own
    others = (path for path in sys.path if path not in ("", str(ROOT)))
    sys.path[:] = [folder, *filter(None, env.get("PYTHONPATH", "").split(":")), *others]
    sys.argv = [module, *options]
    if "--touch" in options:
        touch.Executor.SLEEPING_TIME = 0.0  # for each job
    try:
        runpy.run_module(module, run_name="__main__", alter_sys=True)
    finally:
        atexit._run_exitfuncs()  # which multiprocessing leaves out
