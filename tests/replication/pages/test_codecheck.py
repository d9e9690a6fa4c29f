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


def test_documents_figures_and_tables_are_listed_with_a_comment():
    assert manifest(JOBS, CAPTIONS) == [
        {"file": "paper/report.pdf", "comment": "Document, made by rule report"},
        {"file": "figures/peaks.svg", "comment": "Peaks: all"},
        {
            "file": "results/tables/peaks.csv",
            "comment": "Table, computed by src/peaks.py; drawn in figures/peaks.svg",
        },
    ]


def test_author_part_is_what_the_specification_demands():
    text = codecheck_file(JOBS, CAPTIONS, CITATION)
    assert text.startswith("%YAML 1.1\n---\n")
    content = yaml.safe_load(text)
    assert list(content) == ["version", "paper", "manifest"]  # nothing of a check nobody did
    assert "# No CODECHECK has been done" in text
    assert content["version"] == "https://codecheck.org.uk/spec/config/2.0/"
    assert content["paper"]["title"] == "On “peaks”"
    assert content["paper"]["authors"] == [{"name": "A. Bee", "ORCID": "0000-0002-1825-0097"}]
    assert content["paper"]["reference"].startswith("paper/report.pdf")
    assert content["manifest"] == manifest(JOBS, CAPTIONS)


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
