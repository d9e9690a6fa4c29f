"""The RO-Crate of a run: its files with their checksums, as commands read them.

`results/ro-crate-metadata.json` is JSON-LD, a flat list of entities with links between them
(https://w3id.org/ro/crate/1.1). Its paths are from the root of the repository; an archive has a
copy at its root, where a crate has this file.
"""

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

CRATE = "results/ro-crate-metadata.json"
WORKFLOW = "Snakefile"
RUN = "#run"
"""The action that is the whole run; each job has an action of its own."""

LEFT_OUT = "#left_out"
"""The entity that lists the outputs without a checksum."""


@dataclass(frozen=True)
class Crate:
    """The files of a run."""

    checksums: Mapping[str, str]  # SHA-256 of every input and output, by its path
    rules: Mapping[str, str]  # of every output, by its path
    left_out: tuple[str, ...]  # files and folders that differ each run
    version: str  # the commit of the source, as `provenance.source_version` returns it

    @property
    def folders(self) -> list[str]:
        """The top folders that contain only output of the workflow."""
        given = {Path(path).parts[0] for path in self.checksums if path not in self.rules}
        return sorted({Path(path).parts[0] for path in self.rules} - given)


def read_crate(path: str | Path = CRATE) -> Crate:
    """Return what the crate at a path says of the files of the run.

    Raises
    ------
    ValueError
        When the file has not the entities of a crate that a run wrote.
    """
    try:
        graph = json.loads(Path(path).read_text(encoding="utf-8"))["@graph"]
        entities: dict[str, dict[str, Any]] = {entity["@id"]: entity for entity in graph}
        jobs = (entity for entity in graph if entity["@type"] == "CreateAction")
        return Crate(
            checksums={each["@id"]: each["sha256"] for each in graph if "sha256" in each},
            rules={
                made["@id"]: job["name"]
                for job in jobs
                if job["@id"] != RUN
                for made in job["result"]
            },
            left_out=tuple(entities[LEFT_OUT]["value"]),
            version=entities[WORKFLOW]["version"],
        )
    except (KeyError, TypeError, json.JSONDecodeError) as fault:
        raise ValueError(
            f"{path} is not the RO-Crate of a run ({type(fault).__name__}: {fault}); expected the "
            f"file that make reproduce writes: rm {path} && make reproduce"
        ) from None
