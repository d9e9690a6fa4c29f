"""Write the pages that follow from workflow, config and what is published: `make pages`.

No run is necessary.
"""

from collections.abc import Callable, Iterator
from functools import cache
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
from replication.workflow.provenance import Job, workflow_jobs


def studies() -> list[str]:
    """Return the names of the studies of the config."""
    return read_yaml(config_of(PAPER))["studies"]


@cache
def jobs() -> list[Job]:
    """Return the jobs of `rule all`; reading the workflow takes seconds."""
    return workflow_jobs(targets=["all"])


def pages() -> dict[str, Callable[[], str]]:
    """Return, by the path of each page, what returns its text.

    A paper has codecheck.yml and docs/exhibits.md only if their file, maybe empty, is there.
    """
    parts = [PAPER, *studies()]
    captions = read_captions(map(captions_of, parts))
    costs, numbers = read_costs(Path("docs/costs.csv")), read_numbers(Path("docs/figures.csv"))
    asked: dict[str, Callable[[], str]] = {
        "codecheck.yml": lambda: codecheck_file(jobs(), captions, read_yaml("CITATION.cff")),
        "docs/exhibits.md": lambda: exhibits_page(jobs(), captions, costs, numbers),
    }
    found = {path: text for path, text in asked.items() if Path(path).is_file()}
    if Path(CLAIMS).is_file():
        found[VERDICTS] = lambda: verdict_page(read_judged(CLAIMS), Path(CLAIMS).parent)
    return found


def write() -> None:
    """Write every page, and print its path."""
    for path, text in pages().items():
        Path(path).write_text(text(), encoding="utf-8")
        print(path)


def outdated() -> Iterator[str]:
    """Yield a line for each page that is not as `write` would write it."""
    for path, text in pages().items():
        page = Path(path)
        if not page.is_file() or page.read_text(encoding="utf-8") != text():
            yield f"{path} is not up to date; run 'make pages', read the diff, and commit it"


if __name__ == "__main__":
    write()
