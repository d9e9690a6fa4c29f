"""Make pictures, article, supplement and numbers.md again from published tables."""

import json
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from documents import lists
from documents.draw import pictures, scripts_of_figures
from documents.typeset import checked, compiled, texts_of
from replication.config import read_yaml

CAPTIONS = "figures/captions.yaml"


def remade(
    folder: Path,
    config: dict[str, Any],
    rules: Mapping[str, Any],
    results: Mapping[str, Any],
    claims: Sequence[dict[str, Any]],
    tables: Path,
) -> dict[str, str | bytes]:
    """Return pictures and documents by name; `folder` becomes the root of the documents."""
    results = json.loads(json.dumps(results))  # as the files of a run have them
    scripts = scripts_of_figures()
    paths = {path.stem: str(path) for path in tables.glob("*.csv")}
    captions, style = read_yaml(CAPTIONS), "figures/style.mplstyle"
    drawings = pictures(scripts, paths, {"config": config}, captions, style)
    svgs = {f"{Path(s).stem}.svg": svg for s, svg in zip(scripts, drawings, strict=True)}
    shutil.copytree("paper", folder / "paper")
    shutil.copy("CITATION.cff", folder)
    contents = {f"figures/{name}": picture for name, picture in svgs.items()}
    contents |= {f"results/findings/{rule}.json": json.dumps(results[rule]) for rule in results}
    contents["results/claims.json"] = json.dumps(claims)
    for name in ("figures", "results/findings"):
        (folder / name).mkdir(parents=True)
    for path, text in contents.items():
        (folder / path).write_text(text, "utf-8")
    (folder / "results/tables").symlink_to(tables.resolve())
    texts, quotes, pages = texts_of(config, CAPTIONS), [], {}
    for name in ("report", "supplement"):
        source = f"paper/{name}.typ"
        pages[f"{name}.pdf"] = compiled(source, texts, str(folder), pdf_standards=["a-2b"])
        page = checked(source, texts, str(folder))
        pages[f"{name}.html"] = page.html
        quotes += page.quotes
    run = lists.Run(claims, captions, rules, results, config, quotes, tables)
    return svgs | pages | {"numbers.md": lists.numbers(run, lists.Docs())}
