"""Have a script run by the process of the forks, and end as it ends: `forks`.

The arguments are the address of that process and those of Python.
"""

import json
import os
import socket
import sys

ENDED = "the process that waits for this script has ended: run the same command again"


def run(address: str, script: str) -> int | None:
    """Return how a script ended, or None when it was not begun."""
    asked = json.dumps([script, os.getcwd(), dict(os.environ)]).encode()
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as server:
        try:
            server.connect(address)
            socket.send_fds(server, [asked], [0, 1, 2])
        except OSError:
            return None
        try:
            ended = server.recv(1)
        except ConnectionResetError:
            ended = b""
    if not ended:
        sys.exit(ENDED)
    return ended[0]


if __name__ == "__main__":
    address, *words = sys.argv[1:]
    alone = len(words) == 1 and os.environ.get("OMP_NUM_THREADS") == "1"
    if alone and (ended := run(address, words[0])) is not None:
        sys.exit(ended)
    os.execv(sys.executable, [sys.executable, *words])
