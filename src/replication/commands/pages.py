"""Write the pages that follow from workflow, config and what is published: `make pages`.

No run is necessary.
"""

from collections.abc import Callable, Iterator
from functools import cache, partial
from pathlib import Path
from typing import Any

from replication.inputs.parts import PAPER, captions_of, config_of
from replication.inputs.strict_yaml import read_yaml
from replication.judging.ledger import read_judged
from replication.pages.captions import read_captions
from replication.pages.codecheck import codecheck_file
from replication.pages.config_page import config_page
from replication.pages.edition import verdict_page
from replication.pages.edition_check import CLAIMS
from replication.pages.exhibits import exhibits_page
from replication.pages.seal import VERDICTS
from replication.workflow.costs import read_costs
from replication.workflow.provenance import Job, workflow_jobs


def studies() -> list[str]:
    """Return the names of the studies of the config."""
    return read_yaml(config_of(PAPER))["studies"]


def captions() -> dict[str, dict[str, Any]]:
    """Return the captions of the paper and of its studies."""
    return read_captions(captions_of(part) for part in [PAPER, *studies()])


@cache
def jobs() -> list[Job]:
    """Return the jobs of `rule all`; reading the workflow takes seconds."""
    return workflow_jobs(targets=["all"])


def codecheck() -> str:
    """Return the text of codecheck.yml."""
    return codecheck_file(jobs(), captions(), read_yaml("CITATION.cff"))


def exhibits() -> str:
    """Return the text of docs/exhibits.md."""
    return exhibits_page(jobs(), captions(), read_costs(Path("docs/costs.csv")))


def verdicts() -> str:
    """Return the text of docs/verdicts.md, by the published rows."""
    return verdict_page(read_judged(CLAIMS), Path(CLAIMS).parent)


ASKED = {"codecheck.yml": codecheck, "docs/exhibits.md": exhibits}
"""The pages that only a paper has in which their file, maybe empty, is there."""


def pages() -> dict[str, Callable[[], str]]:
    """Return, by the path of each page, what returns its text."""
    inputs = {config_of(PAPER): "README.md"} | {config_of(name): "INPUTS.md" for name in studies()}
    return {
        **{
            str(Path(path).with_name(page)): partial(config_page, Path(path))
            for path, page in inputs.items()
        },
        **{path: text for path, text in ASKED.items() if Path(path).is_file()},
        **({VERDICTS: verdicts} if Path(CLAIMS).is_file() else {}),
    }


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
