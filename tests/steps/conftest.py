"""The steps are scripts: their folder is on the path when Snakemake runs them, and here."""

import sys
from pathlib import Path

STEPS = str(Path(__file__).parents[2] / "src" / "steps")
if STEPS not in sys.path:
    sys.path.insert(0, STEPS)
