"""The process of the forks: load packages, then fork for each script of a client.

It imports nothing of the repository, so that each script finds its modules as they are.
"""

import gc
import json
import os
import shutil
import signal
import socket
import sys
from contextlib import suppress
from pathlib import Path
from select import select
from types import ModuleType

PACKAGES = (
    "snakemake.script",
    "numpy",
    "pandas",
    "scipy.integrate",
    "scipy.optimize",
    "scipy.signal",
    "scipy.special",
    "numba",
    "matplotlib.pyplot",
    "matplotlib.backends.backend_svg",
)
"""What many jobs of many papers import; those that are not installed are left out."""

REQUEST = 2**20
"""Bytes: the most that a request may have, with its environment."""


def serve(address: str) -> socket.socket | None:
    """Fork for each client, and return it in the fork; return None when the run has ended."""
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as asks:
        asks.bind(address)
        asks.listen()
        while 0 not in select([0, asks], [], [])[0]:
            client, _ = asks.accept()
            if os.fork() == 0:
                return client
            client.close()
    with suppress(ChildProcessError):
        while os.wait():
            pass
    return None


def attend(client: socket.socket) -> None:
    """Fork once more for the script of a client, tell how it ended, and end it with the client."""
    asked, streams, *_ = socket.recv_fds(client, REQUEST, 3)
    if asked and (pid := os.fork()):
        ends = os.pidfd_open(pid)
        if ends not in select([client, ends], [], [])[0]:
            os.kill(pid, signal.SIGKILL)
        code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
        with suppress(OSError):
            client.send(bytes([code if code >= 0 else 128 - code]))
        os._exit(0)
    elif asked:
        client.close()
        become(streams, *json.loads(asked))


def become(streams: list[int], script: str, folder: str, environment: dict[str, str]) -> None:
    """Do what Python does for a script."""
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = [script]
    sys.path.insert(0, str(Path(script).parent))
    main = ModuleType("__main__")
    main.__file__ = script
    sys.modules["__main__"] = sys.modules["__mp_main__"] = main  # the second is multiprocessing's
    exec(compile(Path(script).read_text(encoding="utf-8"), script, "exec"), vars(main))


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of the terminal, which the run answers
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # of the run, which ends with this one's input
    for name in PACKAGES:
        with suppress(ImportError):
            __import__(name)
    gc.freeze()  # no garbage collector of a fork writes to what all share
    if client := serve(sys.argv[1]):
        attend(client)
    else:
        shutil.rmtree(Path(sys.argv[1]).parent)
