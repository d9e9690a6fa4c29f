"""The report: find the files that its Typst sources read, and compile it."""

import json
import re
import shutil
import tempfile
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from replication.judging.digits import numbers
from replication.judging.ledger import read_judged
from replication.pages.captions import alternative

FILE = re.compile(
    r'\b(?:import|include|json|csv|yaml|toml|xml|read|image|bibliography)\s*\(?\s*"([^"@]+\.\w+)"'
)
FINDING = re.compile(r'\bfound\("(\w+)"\)')
TABLE = re.compile(r'\btable-of\("(\w+)"\)')
PICTURE = re.compile(r'\bpicture\(\s*("\w+"|\([^)]*\))')


def reads(*sources: str | Path, root: str | Path = ".") -> list[str]:
    """Return the files that Typst sources read, through the sources that they include.

    A source names a file in quotes, or as a table or findings. `compiled` fails on any other file.
    All paths are from the root, the folder that Typst calls /; the sources are in the answer.
    """
    found: set[str] = set()
    waiting = [str(source) for source in sources]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        if not path.endswith(".typ"):
            continue
        text = (Path(root) / path).read_text(encoding="utf-8")
        for name in FILE.findall(text):
            waiting.append(name[1:] if name[0] == "/" else str(Path(path).parent / name))
        waiting += [f"results/findings/{name}.json" for name in FINDING.findall(text)]
        waiting += [f"results/tables/{name}.csv" for name in TABLE.findall(text)]
    return sorted(found)


def refuse_unshown(figures: Iterable[str], sources: Iterable[str]) -> None:
    """Raise ValueError for figures (paths without ending) that no source of a document shows."""
    shown = set()
    for source in (Path(each) for each in sources if each.endswith(".typ")):
        calls = PICTURE.findall(source.read_text(encoding="utf-8"))
        for name in re.findall(r'"(\w+)"', " ".join(calls)):
            shown |= {f"figures/{name}", f"{source.parent.as_posix()}/figures/{name}"}
    if faults := [
        f"{each}.py draws a figure that no document shows; expected "
        f'#picture("{Path(each).name}", […]) in a document or a section, or no such script'
        for each in figures
        if each not in shown
    ]:
        raise ValueError("\n".join(faults))


def compiled(source: str, inputs: Iterable[str], options: Mapping[str, str]) -> bytes:
    """Return the PDF of a Typst source, compiled beside its declared inputs and nothing else.

    A file that the source reads and that is not declared therefore stops the run. Otherwise the
    report could become outdated. The options are the values of `sys.inputs` in the source.

    Raises
    ------
    ValueError
        When the source cannot be compiled, with the file, the line and the calls that led there.
    """
    import typst  # here, as the Snakefile imports this module and does not need typst

    with tempfile.TemporaryDirectory() as folder:
        for path in inputs:
            copy = Path(folder, path)
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, copy)
        try:
            return typst.compile(
                str(Path(folder, source)),
                root=folder,
                ignore_system_fonts=True,
                pdf_standards=["a-2b"],
                sys_inputs=dict(options),
            )
        except typst.TypstError as fault:  # its text has no place; the diagnostic has
            places = re.sub(rf"\S*{re.escape(Path(folder).name)}/", "", fault.diagnostic)
            raise ValueError(f"{source} cannot be compiled\n{places}") from None


def options_of(studies: Iterable[str], captions: Mapping[str, Mapping[str, Any]]) -> dict[str, str]:
    """Return the values of `sys.inputs` in the documents, after a run."""
    articles = [name for name in studies if Path(f"studies/{name}/article.typ").is_file()]
    in_decimals = {row.id: numbers(row) for row in read_judged("results/claims.json")}
    return {
        "studies": ",".join(studies),
        "articles": ",".join(articles),
        "numbers": json.dumps(in_decimals),
        "alternatives": json.dumps({path: alternative(entry) for path, entry in captions.items()}),
    }


def figure_numbers(options: Mapping[str, str]) -> dict[str, str]:
    """Return the number of each picture's figure, in the article or, with S, in the supplement.

    Both are compiled in the working folder, with the figures and results of a run.
    """
    import typst

    found = {}
    for name, letter in (("report", ""), ("supplement", "S")):
        if not (source := Path("paper", f"{name}.typ")).is_file():
            continue
        images = typst.query(
            str(source),
            "figure.where(kind: image)",
            root=".",
            ignore_system_fonts=True,
            sys_inputs=dict(options),
        )
        for number, figure in enumerate(json.loads(images), 1):
            for path in re.findall(r'"source": "/([^"]+)"', json.dumps(figure["body"])):
                found[path] = f"{letter}{number}"
    return found
