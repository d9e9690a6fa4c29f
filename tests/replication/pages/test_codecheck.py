"""codecheck.yml: what CODECHECK 2.0 demands of an author, and nothing that a check would add."""

from pathlib import Path

import yaml

from replication.pages.codecheck import codecheck_file, manifest
from replication.workflow.provenance import Job

JOBS = [
    Job(
        "peaks",
        scripts=("src/peaks.py",),
        outputs=("results/tables/peaks.csv", "results/shards/peaks.csv", "results/claims.json"),
    ),
    Job("figure", inputs=("results/tables/peaks.csv",), outputs=("figures/peaks.svg",)),
    Job("report", inputs=("figures/peaks.svg",), outputs=("paper/report.pdf",)),
]
CAPTIONS = {"figures/peaks.svg": {"title": "Peaks: all"}}
CITATION = {
    "title": "On “peaks”",
    "authors": [
        {
            "given-names": "A.",
            "family-names": "Bee",
            "orcid": "https://orcid.org/0000-0002-1825-0097",
        }
    ],
}


def test_missing_orcid_is_told_and_a_doi_is_the_reference():
    citation = {"title": "T", "authors": [{"name": "The Bees"}], "doi": "10.1/x"}
    text = codecheck_file(JOBS, CAPTIONS, citation)
    assert "CITATION.cff has none of The Bees" in text
    assert "ORCID" not in codecheck_file(JOBS, CAPTIONS, CITATION).partition("version:")[0]
    assert yaml.safe_load(text)["paper"]["reference"] == "https://doi.org/10.1/x"


def test_every_figure_table_and_document_of_the_run_is_listed(jobs):
    made = {out for job in jobs for out in job.outputs}
    captions = {out: {"title": out} for out in made if out.endswith(".svg")}
    listed = [entry["file"] for entry in manifest(jobs, captions)]
    assert len(set(listed)) == len(listed)
    kinds = (".pdf", ".svg")
    assert {out for out in made if out.endswith(kinds)} <= set(listed) <= made
    assert {Path(path).suffix for path in listed} >= {*kinds, ".csv"}
