"""Write the pages that follow from the workflow and its config, without a run: `make pages`."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from replication.captions import read_captions
from replication.codecheck import codecheck_file
from replication.config_page import config_page
from replication.parts import PAPER, captions_of
from replication.provenance import workflow_jobs
from replication.strict_yaml import read_yaml


def codecheck() -> str:
    """Return the text of codecheck.yml."""
    studies = read_yaml("config/config.yaml")["studies"]
    captions = read_captions(captions_of(part) for part in [PAPER, *studies])
    return codecheck_file(workflow_jobs(targets=["all"]), captions, read_yaml("CITATION.cff"))


PAGES: Mapping[str, Callable[[], str]] = {
    "config/README.md": lambda: config_page(Path("config/config.yaml")),
    "codecheck.yml": codecheck,
}
"""By its path, what returns the text of a page."""


def write() -> None:
    """Write every page, and print its path."""
    for path, text in PAGES.items():
        Path(path).write_text(text(), encoding="utf-8")
        print(path)


def outdated() -> Iterator[str]:
    """Yield a line for each page that is not as `write` would write it."""
    for path, text in PAGES.items():
        page = Path(path)
        if not page.is_file() or page.read_text(encoding="utf-8") != text():
            yield f"{path} is not up to date; run 'make pages', read the diff, and commit it"


if __name__ == "__main__":
    write()
