"""The file codecheck.yml, in which an author lists the files that an independent check recreates.

The specification is https://codecheck.org.uk/spec/config/2.0/. The author's part is the manifest
and the paper; the codechecker adds codechecker, report, summary and certificate.
"""

from collections.abc import Iterable, Mapping
from pathlib import PurePath
from typing import Any

import yaml

from replication.origin.about import name_of
from replication.pages.blanks import MARK
from replication.workflow.provenance import Job, makers

SPECIFICATION = "https://codecheck.org.uk/spec/config/2.0/"
HEAD = """\
%YAML 1.1
---
# `make publish` writes this file from the outputs of `rule all`, their captions and CITATION.cff.
# `make reproduce` makes every file of the manifest.
# No CODECHECK has been done: codechecker, report, summary and certificate are missing for this
# reason. The person who checks adds them.
"""
UNNAMED = {"name": "see CITATION.cff"}
"""Who stands for authors that are still to be filled in there."""

NO_ORCID = """\
# The specification requires the ORCID of each author; CITATION.cff has none of {}.
"""


def codecheck_file(
    jobs: Iterable[Job], captions: Mapping[str, Mapping[str, Any]], citation: Mapping[str, Any]
) -> str:
    """Return the text of codecheck.yml, of the jobs of `rule all` and the captions by path."""
    authors = [_author(each) for each in citation["authors"]]
    lacking = [one["name"] for one in authors if one != UNNAMED and "ORCID" not in one]
    reference = "paper/report.pdf of this repository; CITATION.cff has no DOI"
    if "doi" in citation:
        reference = f"https://doi.org/{citation['doi']}"
    content = {
        "version": SPECIFICATION,
        "paper": {"title": citation["title"], "authors": authors, "reference": reference},
        "manifest": manifest(jobs, captions),
    }
    text = yaml.safe_dump(content, allow_unicode=True, sort_keys=False, width=1000)
    return HEAD + (NO_ORCID.format(", ".join(lacking)) if lacking else "") + text


def manifest(
    jobs: Iterable[Job], captions: Mapping[str, Mapping[str, Any]]
) -> list[dict[str, str]]:
    """Return path and comment of every document, figure and table that the jobs make."""
    jobs = list(jobs)
    comments = {}
    for path, job in sorted(makers(jobs).items()):
        kind = PurePath(path).suffix
        if kind == ".pdf":
            comments[path] = f"Document, made by rule {job.rule}"
        elif path in captions:
            comments[path] = captions[path]["title"]
        elif kind == ".csv" and PurePath(path).is_relative_to("results/tables"):
            drawn = [out for each in jobs if path in each.inputs for out in each.outputs]
            shown = sorted(out for out in drawn if out in captions)
            comments[path] = f"Table, computed by {', '.join(job.scripts)}"
            comments[path] += f"; drawn in {', '.join(shown)}" if shown else ""
    rank = {".pdf": 0, ".csv": 2}  # documents come first, tables last
    order = sorted(comments, key=lambda path: (rank.get(PurePath(path).suffix, 1), path))
    return [{"file": path, "comment": comments[path]} for path in order]


def _author(entry: Mapping[str, str]) -> dict[str, str]:
    if name_of(entry).startswith(MARK):
        return UNNAMED
    author = {"name": name_of(entry)}
    if "orcid" in entry:
        author["ORCID"] = entry["orcid"].removeprefix("https://orcid.org/")
    return author
