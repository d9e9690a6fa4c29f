"""What a run made, from what, by what and with which verdicts: a Workflow Run RO-Crate."""

import json
import tomllib
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

from rocrate.rocrate import ROCrate

from replication.inputs.config_keys import Key, keys
from replication.inputs.parts import config_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.claim import JudgedClaim
from replication.judging.ledger import read_judged
from replication.origin import about, entities
from replication.origin.entities import ref, refs
from replication.origin.recorded import CRATE, LEFT_OUT, WORKFLOW
from replication.origin.software import installed
from replication.workbench import run
from replication.workflow.provenance import Job, noted_jobs, source_version, workflow_jobs

SPECIFICATION = "https://w3id.org/ro/crate/1.1"
WORKFLOW_CRATE = "https://w3id.org/workflowhub/workflow-ro-crate/1.0"
PROFILES = {
    "https://w3id.org/ro/wfrun/process/0.5": "Process Run Crate",
    "https://w3id.org/ro/wfrun/workflow/0.5": "Workflow Run Crate",
    WORKFLOW_CRATE: "Workflow RO-Crate",
}
SHA256 = "https://w3id.org/ro/terms/workflow-run#sha256"
"""What `sha256` means; the context of RO-Crate 1.1 has no such term."""

MACHINE = "src/replication/VERSION"

SNAKEMAKE = {
    "@id": "https://w3id.org/workflowhub/workflow-ro-crate#snakemake",
    "@type": "ComputerLanguage",
    "name": "Snakemake",
    "url": "https://snakemake.readthedocs.io",
}


def main(
    jobs: Collection[Job],
    differs_each_run: Iterable[str],
    config: Mapping[str, Iterable[Key]],
    claims: Iterable[JudgedClaim],
    software: Mapping[str, str],
    machine: str,
    project: Mapping[str, Any],
    citation: Mapping[str, Any],
) -> dict[str, Any]:
    """Return the crate as JSON-LD: of the jobs of `rule all`, and the keys of each part's config.

    Outputs that differ each run or are made after it have no checksum, nor have the logs.
    """
    left_out = {CRATE, *differs_each_run}
    parameters, values = entities.parameters(config)
    packages = entities.packages(software)
    files = entities.files(jobs, left_out)
    actions = entities.actions(jobs, left_out, values)
    written_by, paper = about.article(citation["references"][0])
    findings = {Path(path).stem: path for job in jobs for path in job.findings}
    reviews = entities.reviews(claims, findings, paper["@id"])
    unlisted = {
        "@id": LEFT_OUT,
        "@type": "PropertyValue",
        "name": "Outputs without a checksum",
        "value": sorted({*left_out, *(str(Path(p).parent) for job in jobs for p in job.logs)}),
    }
    authors, licences = [*about.people(citation["authors"])], about.licences(citation)
    profiles = [
        {"@id": profile, "@type": "CreativeWork", "name": name, "version": profile.split("/")[-1]}
        for profile, name in PROFILES.items()
    ]
    workflow = {
        "@type": ["File", "SoftwareSourceCode", "ComputationalWorkflow"],
        "name": citation["title"],
        "version": source_version() or "unknown",
        "programmingLanguage": ref(SNAKEMAKE),
        "input": refs(parameters),
        "softwareRequirements": refs(packages),
    }
    described = {
        WORKFLOW: workflow,
        MACHINE: {"name": "The version of src/replication", "version": machine},
    }
    root = about.root(citation, project) | {
        "author": refs(authors),
        "license": refs(licences),
        "citation": ref(paper),
        "conformsTo": refs(profiles),
        "hasPart": refs(files),
        "mainEntity": ref(WORKFLOW),
        "mentions": refs([*actions, *reviews, unlisted]),
    }
    crate = ROCrate(version="1.1")
    crate.metadata["conformsTo"] = refs([SPECIFICATION, WORKFLOW_CRATE])
    crate.metadata.extra_terms["sha256"] = SHA256
    for name, value in root.items():
        crate.root_dataset[name] = value
    for entity in files:
        crate.add_jsonld(entity | described.get(entity["@id"], {}))
    who = [*profiles, *authors, *licences, *written_by, paper, SNAKEMAKE]
    for entity in [*who, *packages, *parameters, *values, *actions, *reviews, unlisted]:
        crate.add_jsonld(dict(entity))
    return crate.metadata.generate()


def work(job: Any) -> None:
    project = _toml(job.input.project)
    groups = project.get("tool", {}).get("replication", {}).get("groups", [])
    crate = main(
        noted_jobs() or workflow_jobs(config=job.config, targets=["all"]),
        job.params.differs_each_run,
        {part: keys(Path(config_of(part)), used) for part, used in job.params.configs.items()},
        read_judged(job.input.claims),
        installed(_toml(job.input.lock), groups),
        Path(MACHINE).read_text(encoding="utf-8").strip(),
        project["project"],
        read_yaml(job.input.citation),
    )
    print(f"{len(crate['@graph'])} entities")
    text = json.dumps(crate, indent=1, ensure_ascii=False, allow_nan=False)
    Path(job.output[0]).write_text(text + "\n", encoding="utf-8")


def _toml(path: str) -> dict[str, Any]:
    return tomllib.loads(Path(path).read_text(encoding="utf-8"))


if __name__ == "__main__":
    run(snakemake, work)
