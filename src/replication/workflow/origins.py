"""What the numbers of a result depend on beside code: parameters and inputs of its jobs."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from replication.inputs.checksums import checksum, sha256
from replication.workflow.internals import job_of, maker_among

CODE = (".ipynb", ".py", ".pyi", ".smk")
"""The endings of inputs that are code: a result is compared whatever made it."""


class Origins:
    """The jobs that each result depends on, by the rules of a workflow."""

    def __init__(self, rules: Iterable[Any]) -> None:
        self.maker = maker_among(rules)
        self.found: dict[str, dict[str, str]] = {}

    def of(self, result: str) -> dict[str, str]:
        """Return, for the job of a result and those upstream, a checksum of parameters and inputs.

        Of inputs that a job makes, its checksum is there; of a file that none makes and that is no
        code, its content is in the checksum of the job that reads it.
        """
        if result not in self.found:
            rule = self.maker(result)
            self.found[result] = self._of(rule, result) if rule else {}
        return self.found[result]

    def _of(self, rule: Any, result: str) -> dict[str, str]:
        words, read, params = job_of(rule, result)
        own, jobs = repr([*params]).encode(), {}
        for path in sorted(path for path in map(str, read) if not path.endswith(CODE)):
            above = self.of(path)
            jobs |= above
            if not above and Path(path).is_file():
                own += path.encode() + bytes.fromhex(checksum(path))
        words.pop("scatteritem", None)  # the parts of an ensemble are made alike
        name = "_".join([rule.name, *words.values()])
        return jobs | {name: sha256(own)[:16]}


def published_results(folder: Path = Path("tests/reference")) -> dict[str, str]:
    """Return the published tables and findings, by the paths of those that a run makes."""
    tables = [path for part in (".", "sources", "studies") for path in folder.glob(f"{part}/*.csv")]
    found = {f"results/tables/{path.name}": str(path) for path in sorted(tables)}
    findings = sorted(folder.glob("findings/*.json"))
    return found | {f"results/findings/{path.name}": str(path) for path in findings}
