"""How many small changes of the code the tests notice: `python -m benchmarks.mutations [-j N]`.

mutations.yaml has comparisons, signs, constants and indices, sixty drawn by each of two seeds:
twenty of the library, of the steps with their judging, and of the kernel with the second solver.
Who moves or renames a line moves its entry, which leaves with the line. `baseline` is what is
found. An entry that is caught no longer ends this with an error.
"""

import sys
from collections import Counter
from pathlib import Path

from tests.faults.run import ROOT, told

MUTATIONS = ROOT / "benchmarks" / "mutations.yaml"
LIMIT = 600.0  # s


def main(path: Path = MUTATIONS) -> int:
    """Run the mutations; return how many of those that were caught are so no longer."""
    caught: Counter[str] = Counter()
    drawn: Counter[str] = Counter()
    lost = []
    for entry, found in told(path, LIMIT):
        group = entry["name"].rsplit("_", 1)[0]
        drawn[group] += 1
        caught[group] += found == "caught"
        if entry["baseline"] == "caught" != found:
            lost.append(entry["name"])
    for group, number in drawn.items():
        print(f"{group}: {caught[group]} of {number} caught")
    print(f"caught before and not now: {', '.join(lost) or 'none'}")
    return len(lost)


if __name__ == "__main__":
    sys.exit(bool(main()))
