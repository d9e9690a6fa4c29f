"""The entities of the RO-Crate of a run: files, actions, parameters, claims, software.

Each is a mapping with `@id` and `@type` of the profile Workflow Run Crate 0.5
(https://w3id.org/ro/wfrun/workflow/0.5), in the vocabulary of schema.org.
"""

import math
from collections.abc import Collection, Iterable, Mapping
from typing import Any

from replication.inputs.checksums import checksum
from replication.inputs.config_keys import Key
from replication.inputs.parts import PAPER
from replication.judging.claim import JudgedClaim
from replication.origin.recorded import RUN, WORKFLOW
from replication.workflow.provenance import Job

Entity = dict[str, Any]

PACKAGES = "https://pypi.org/project/"
PYTHON = "https://docs.python.org/release/"
FORMAL_PARAMETER = "https://bioschemas.org/profiles/FormalParameter/1.0-RELEASE"


def ref(entity: Entity | str) -> dict[str, str]:
    """Return a link to an entity, which may be given by its `@id`."""
    return {"@id": entity if isinstance(entity, str) else entity["@id"]}


def refs(entities: Iterable[Entity | str]) -> list[dict[str, str]]:
    """Return links to entities."""
    return [ref(entity) for entity in entities]


def files(jobs: Collection[Job], left_out: Collection[str]) -> list[Entity]:
    """Return every input, script and output of the jobs, with its checksum."""
    scripts = {script for job in jobs for script in job.scripts}
    paths = scripts | {path for job in jobs for path in (*job.inputs, *job.outputs)}
    return [
        {
            "@id": path,
            "@type": ["File", "SoftwareSourceCode"] if path in scripts else "File",
            "sha256": checksum(path),
        }
        for path in sorted(paths - {*left_out})
    ]


def actions(
    jobs: Iterable[Job], left_out: Collection[str], values: Iterable[Entity]
) -> list[Entity]:
    """Return the run with all inputs, parameters and outputs; then each job with its own.

    The code that a job imports is an input of the run and not of the job; its script stands for it.
    """
    jobs = sorted((job for job in jobs if job.outputs), key=lambda job: job.outputs)
    made = {path for job in jobs for path in job.outputs} - {*left_out}
    given = {path for job in jobs for path in (*job.inputs, *job.scripts)} - {*made, *left_out}
    run = {
        "@id": RUN,
        "@type": "CreateAction",
        "name": "The run",
        "instrument": ref(WORKFLOW),
        "object": [*refs(sorted(given)), *refs(values)],
        "result": refs(sorted(made)),
    }
    return [run, *(_action(job, left_out) for job in jobs if {*job.outputs} - {*left_out})]


def _action(job: Job, left_out: Collection[str]) -> Entity:
    used = (path for path in job.inputs if not path.endswith((".py", ".pyi")))
    return {
        "@id": f"#job/{job.outputs[0]}",
        "@type": "CreateAction",
        "name": job.rule,
        "description": f"Rule {job.rule}, {job.place}",
        "instrument": ref(job.scripts[0] if job.scripts else WORKFLOW),
        "object": refs(sorted({*used} - {*left_out})),
        "result": refs(path for path in job.outputs if path not in left_out),
    }


def parameters(keys: Mapping[str, Iterable[Key]]) -> tuple[list[Entity], list[Entity]]:
    """Return the parameters of the workflow, the keys of each part, and what the run gave them."""
    formal, values = [], []
    for part, found in keys.items():
        for key in found:
            name = key.place if part == PAPER else f"{part}.{key.place}"
            parameter = {
                "@id": f"#parameter/{name}",
                "@type": "FormalParameter",
                "additionalType": "PropertyValue",
                "conformsTo": ref(FORMAL_PARAMETER),
                "name": name,
                "description": key.meaning,
                "workExample": ref(f"#value/{name}"),
            }
            value = {
                "@id": f"#value/{name}",
                "@type": "PropertyValue",
                "exampleOfWork": ref(parameter),
                "name": name,
                "unitText": key.unit,
                "value": _value(key),
            }
            formal.append(without_blanks(parameter))
            values.append(without_blanks(value))
    return formal, values


def _value(key: Key) -> Any:
    """Return a single finite number or truth as such, and any other value as YAML."""
    first, *others = key.values
    single = not others and isinstance(first, (bool, int, float)) and math.isfinite(first)
    return first if single else key.value


def reviews(claims: Iterable[JudgedClaim], findings: Mapping[str, str], paper: str) -> list[Entity]:
    """Return the verdict on each claim, after the verdicts that there are.

    Of each rule the file with its findings is given. Claims without a study are the paper's.
    """
    claims = list(claims)
    ratings = {
        verdict: {
            "@id": f"#verdict/{verdict.replace(' ', '_')}",
            "@type": "Rating",
            "ratingValue": verdict,
        }
        for verdict in sorted({claim.verdict for claim in claims})
    }
    return [*ratings.values()] + [
        without_blanks(
            {
                "@id": f"#claim/{claim.id}",
                "@type": "ClaimReview",
                "name": claim.id,
                "claimReviewed": claim.statement,
                "itemReviewed": ref("./" if claim.study else paper),
                "reviewRating": ref(ratings[claim.verdict]["@id"]),
                "isBasedOn": ref(findings[claim.rule]) if claim.rule in findings else "",
            }
        )
        for claim in claims
    ]


def packages(versions: Mapping[str, str]) -> list[Entity]:
    """Return Python and each package with its version."""
    return [
        {
            "@id": f"{PYTHON if name == 'python' else f'{PACKAGES}{name}/'}{version}/",
            "@type": "SoftwareApplication",
            "name": name,
            "softwareVersion": version,
        }
        for name, version in versions.items()
    ]


def without_blanks(entity: Entity) -> Entity:
    """Return an entity without the properties that are empty texts."""
    return {name: value for name, value in entity.items() if value != ""}
