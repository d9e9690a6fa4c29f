"""Snakemake with its own arguments, which Ctrl-C ends with one line at any moment."""

import signal
import sys

from replication.workflow.stopping import interrupt

if __name__ == "__main__":
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, interrupt)
    from snakemake.cli import main
    from snakemake.shell import shell

    # A job that still imports its modules would print where it was; `interrupt` ends it.
    shell.prefix("set -euo pipefail; trap '' INT; ")
    sys.exit(main())
