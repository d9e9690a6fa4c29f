"""The process of the forks: load packages, then fork for each script of a client.

It imports nothing of the repository, so that each script finds its modules as they are.
"""

import gc
import json
import os
import selectors
import shutil
import signal
import socket
import sys
from contextlib import suppress
from functools import partial
from pathlib import Path
from types import ModuleType
from typing import NamedTuple

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


class Request(NamedTuple):
    """A script, the folder and the environment that it runs in, and its three streams."""

    script: str
    folder: str
    environment: dict[str, str]
    streams: list[int]


def serve(address: str) -> Request | None:
    """Fork for each request, and return it in the fork; return None when the run has ended.

    A client learns how its fork ended. A fork whose client was killed is killed.
    """
    asks = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    asks.bind(address)
    asks.listen()
    with selectors.DefaultSelector() as events:
        events.register(asks, selectors.EVENT_READ, _fork)
        events.register(0, selectors.EVENT_READ)
        while True:
            (event, _), *_ = events.select()  # one at a time: it may make another void
            if event.data is None:
                return None
            if request := event.data(events, event.fileobj):
                return request


def _fork(events: selectors.BaseSelector, asks: socket.socket) -> Request | None:
    """Fork for a client that asks, and return its request in the fork alone."""
    client, _ = asks.accept()
    asked, streams, *_ = socket.recv_fds(client, REQUEST, 3)
    if not asked:  # a client that was killed
        client.close()
    elif pid := os.fork():
        for stream in streams:
            os.close(stream)
        ends = os.pidfd_open(pid)
        events.register(ends, selectors.EVENT_READ, partial(_tell, client=client, pid=pid))
        events.register(client, selectors.EVENT_READ, partial(_kill, pid=pid))
    else:
        asks.close()
        client.close()
        return Request(*json.loads(asked), streams)
    return None


def _tell(events: selectors.BaseSelector, ends: int, *, client: socket.socket, pid: int) -> None:
    """Tell a client how its fork ended."""
    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    with suppress(OSError):
        client.send(bytes([code if code >= 0 else 128 - code]))
    for each in (ends, client):
        with suppress(KeyError):
            events.unregister(each)
    os.close(ends)
    client.close()


def _kill(events: selectors.BaseSelector, client: socket.socket, *, pid: int) -> None:
    """End the fork of a client that is no more."""
    events.unregister(client)
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


def become(request: Request) -> None:
    """Do in a fork what Python does for a script."""
    for number, stream in enumerate(request.streams):
        os.dup2(stream, number)
        os.close(stream)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    os.chdir(request.folder)
    os.environ.clear()
    os.environ.update(request.environment)
    sys.argv = [request.script]
    sys.path.insert(0, str(Path(request.script).parent))
    main = ModuleType("__main__")
    main.__file__ = request.script
    sys.modules["__main__"] = sys.modules["__mp_main__"] = main  # the second is multiprocessing's
    text = Path(request.script).read_text(encoding="utf-8")
    exec(compile(text, request.script, "exec"), vars(main))


if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # of the terminal, which the run answers
    signal.signal(signal.SIGTERM, signal.SIG_IGN)  # of the run, which ends with this one's input
    for name in PACKAGES:
        with suppress(ImportError):
            __import__(name)
    gc.freeze()  # no garbage collector of a fork writes to what all share
    if request := serve(sys.argv[1]):
        become(request)
    else:
        shutil.rmtree(Path(sys.argv[1]).parent)
