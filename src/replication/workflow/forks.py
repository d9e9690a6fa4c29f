"""Start the scripts of jobs as forks of one process that has loaded what most of them import.

A job's own Python takes up to a second to load NumPy, SciPy, pandas, Numba and Matplotlib. The
shell in which Snakemake starts a script passes it on to `fork_client`, and that to `fork_server`.
A script starts as ever where the process of the forks is not ready yet, and when its rule has
several threads.
"""

import atexit
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from snakemake.shell import shell

from replication.workflow import fork_client, fork_server
from replication.workflow.internals import unfinished
from replication.workflow.stopping import QUIET

THREADS = ("OMP", "OPENBLAS", "MKL")
FEW = 8
"""So many jobs take less time without forks."""


def start_scripts_as_forks(workflow: Any) -> None:
    """Begin the process of the forks, which ends with this run, and let the shell know of it.

    Nothing is done for a few jobs, where there are no forks (they need Linux), and when the path of
    Python is none that can be the name of a function of the shell.
    """
    python, client = sys.executable, fork_client.__file__
    able = hasattr(os, "pidfd_open") and re.fullmatch(r"[\w./-]+", python + client)
    if not able or len(unfinished(workflow)) <= FEW:
        return
    folder = Path(tempfile.mkdtemp(prefix="forks-"))
    server = subprocess.Popen(
        [python, "-P", fork_server.__file__, folder / "socket"],
        stdin=subprocess.PIPE,  # closed when this process ends, however it ends
        stdout=subprocess.DEVNULL,
        env=os.environ | {f"{name}_NUM_THREADS": "1" for name in THREADS},
    )
    atexit.register(server.communicate)
    # Snakemake calls Python by its path, which a function of the shell may have for a name.
    passed_on = f'exec {python} -IS {client} {folder}/socket "$@"'
    begin = folder / "begin.sh"
    begin.write_text(f"{python}() {{ {passed_on}; }}\n", encoding="utf-8")
    shell.prefix(f"{QUIET}. {begin}; ")
