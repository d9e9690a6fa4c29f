"""Write the pages that follow from the workflow and what is published; `make publish` calls it."""

from pathlib import Path

from replication.inputs.parts import PAPER, captions_of, config_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_judged
from replication.pages.captions import read_captions
from replication.pages.codecheck import codecheck_file
from replication.pages.edition import verdict_page
from replication.pages.edition_check import CLAIMS
from replication.pages.exhibits import exhibits_page, read_numbers
from replication.pages.seal import VERDICTS
from replication.workflow.costs import read_costs
from replication.workflow.provenance import workflow_jobs


def write() -> None:
    """Write every page, and print its path.

    A paper has codecheck.yml and docs/exhibits.md only if their file, maybe empty, is there.
    """
    jobs = workflow_jobs(targets=["all"])
    parts = [PAPER, *read_yaml(config_of(PAPER))["studies"]]
    captions = read_captions(map(captions_of, parts))
    costs, numbers = read_costs(Path("docs/costs.csv")), read_numbers(Path("docs/figures.csv"))
    found = {
        "codecheck.yml": codecheck_file(jobs, captions, read_yaml("CITATION.cff")),
        "docs/exhibits.md": exhibits_page(jobs, captions, costs, numbers),
        VERDICTS: verdict_page(read_judged(CLAIMS), Path(CLAIMS).parent),
    }
    for path, text in found.items():
        if path == VERDICTS or Path(path).is_file():
            Path(path).write_text(text, encoding="utf-8")
            print(path)
