"""Write the page of the library's functions with pdoc, in a user's order, from their docstrings.

The examples are run, and the figure that one draws is shown below it.
"""

import doctest
import inspect
import os
import re
import sys
import tempfile
from base64 import b64encode
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
import pdoc

import topheavy
from documents.frame import framed
from replication.drawing import picture
from replication.job import stop
from replication.step import run

OTHERS = "types of results, constants"
"""The heading of the names that the docstring of the package does not list."""

SMALL = {"figure.figsize": (5.0, 3.4), "path.simplify_threshold": 1.0}  # of a pixel


def headings() -> dict[str, list[str]]:
    """Return the public names, a function of a module as `plot.history`, by their headings."""
    text, _, _ = str(topheavy.__doc__).partition("It does not model")
    items = re.findall(r"^- (.+?): (.+(?:\n  .+)*)", text, re.MULTILINE)
    listed = {title: re.findall(r"`(\w+)`", names) for title, names in items}
    known = [name for names in listed.values() for name in names]
    listed[OTHERS] = [name for name in topheavy.__all__ if name not in known]
    return {
        title[0].upper() + title[1:]: [full for name in names for full in functions(name)]
        for title, names in listed.items()
    }


def functions(name: str) -> list[str]:
    """Return a public name, or of a module the names of its functions."""
    if not inspect.ismodule(module := getattr(topheavy, name)):
        return [name]
    members = inspect.getmembers(module, inspect.isfunction)
    inside = [part for part, function in members if function.__module__ == module.__name__]
    return [f"{name}.{part}" for part in inside if part[0] != "_"]


def described() -> pdoc.doc.Module:
    """Return pdoc's description of the library, with all public names in one module."""
    module = pdoc.doc.Module(topheavy)
    module.submodules = []
    module.members = {full: member(full) for names in headings().values() for full in names}
    for doc in nested(module):
        if isinstance(doc, pdoc.doc.Function):
            doc.signature = as_written(doc)
    return module


def member(full: str) -> pdoc.doc.Doc:
    """Return pdoc's description of a public name, of a class without undocumented members."""
    *module, name = full.split(".")
    content = getattr(getattr(topheavy, module[0]) if module else topheavy, name)
    source = getattr(content, "__module__", ""), name
    if inspect.isclass(content):
        doc = pdoc.doc.Class("topheavy", full, content, source)
        doc.members = {name: inner for name, inner in doc.members.items() if shows(inner)}
        doc.own_members = [*doc.members.values()]
        doc.inherited_members, doc.decorators, doc.bases = {}, [], []
        return doc
    if inspect.isfunction(content):
        doc = pdoc.doc.Function("topheavy", full, content, source)
        doc.name = full
        return doc
    modules = [sys.modules[path] for path in sorted(sys.modules) if path.startswith("topheavy.")]
    places = (pdoc.doc.Module(module).get(name) for module in modules if name in vars(module))
    text = next(doc.docstring for doc in places if doc and doc.docstring)
    return pdoc.doc.Variable(
        "topheavy", full, taken_from=source, docstring=text, default_value=content
    )


def shows(doc: pdoc.doc.Doc) -> bool:
    """Return whether the page shows a member of a class: the constructor, or a documented one."""
    return doc.name == "__init__" or bool(doc.docstring and doc.name[0] != "_")


def nested(doc: Any) -> Iterator[Any]:
    """Return the members of a module, and those of its classes."""
    for inner in doc.own_members:
        yield inner
        if inner.kind == "class":
            yield from nested(inner)


class Annotation(str):
    """An annotation as its source has it; pdoc would print what NumPy's aliases stand for."""

    __repr__ = str.__str__


def as_written(doc: pdoc.doc.Function) -> inspect.Signature:
    """Return the signature of a function, with public names in full so that pdoc links them."""

    def written(annotation: Any) -> Any:
        if not isinstance(annotation, str):
            return annotation
        names = "|".join(topheavy.__all__)
        return Annotation(re.sub(rf"\b({names})\b", r"topheavy.\1", annotation))

    signature = inspect.signature(doc.obj)
    parameters = [
        argument.replace(annotation=written(argument.annotation))
        for argument in signature.parameters.values()
    ]
    returned = doc.name != "__init__" and written(signature.return_annotation)
    return signature.replace(
        parameters=parameters, return_annotation=returned or inspect.Signature.empty
    )


def drawn(doc: pdoc.doc.Doc, style: Path) -> str:
    """Run the examples of a docstring, and return what they draw as an SVG, or nothing.

    Raises
    ------
    SystemExit
        When an example is not true.
    """
    names = {"th": topheavy, "np": np}
    test = doctest.DocTestParser().get_doctest(doc.docstring, names, doc.fullname, None, None)
    report: list[str] = []
    with mpl.rc_context(SMALL, style):
        if doctest.DocTestRunner(verbose=False).run(test, out=report.append).failed:
            stop("".join(report))
        if not plt.get_fignums():
            return ""
        labels = ", ".join(
            f"{axes.get_ylabel()} over {axes.get_xlabel()}" for axes in plt.gcf().axes
        )
        title = doc.docstring.splitlines()[0]
        return picture(plt.gcf(), title, f"What the example draws: {labels}")


def pictures(module: pdoc.doc.Module, style: str, records: list[str]) -> dict[str, str]:
    """Return what examples draw, by their names; they read records, and write into a folder."""
    paths, before = [Path(path).resolve() for path in [style, *records]], Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "data/records").mkdir(parents=True)
        for record in paths[1:]:
            Path(folder, "data/records", record.name).symlink_to(record)
        os.chdir(folder)
        try:
            shown = {doc.qualname: drawn(doc, paths[0]) for doc in nested(module)}
        finally:
            os.chdir(before)
    return {name: svg for name, svg in shown.items() if svg}


def page(module: pdoc.doc.Module, shown: dict[str, str], style: str) -> str:
    """Return the page, the same each time: under headings, with pictures, without sources."""
    pdoc.render.configure(docformat="numpy", show_source=False, search=False, math=False)
    for doc in nested(module):
        if doc.qualname in shown:
            doc.docstring += f"\n\nFIGURE-{doc.qualname}"
    text = re.search("(?s)<main.*</main>", pdoc.render.html_module(module, {"topheavy": module}))[0]

    def figure(match: re.Match[str]) -> str:
        content = b64encode(shown[match[1]].encode()).decode()
        alt = re.search("(?s)<desc>(.*?)</desc>", shown[match[1]])[1]
        return f'<img class="picture" src="data:image/svg+xml;base64,{content}" alt="{alt}">'

    text = re.sub(r"FIGURE-([\w.]+)", figure, text)
    text = re.sub(r'<h6 id="[^"]*">(.*?)</h6>', r"<h3>\1</h3>", text)  # an id for all functions
    link = r'class="headerlink" href="#([\w.]+)"'
    text = re.sub(link, r'\g<0> aria-label="Link to \1"', text)
    text = re.sub(r"<input [^>]*>\s*<label [^>]*></label>", "", text)  # that hide a long value
    text = text.replace("<pre><code>", '<pre tabindex="0"><code>')  # a drawing, not an example
    index = []
    for title, names in headings().items():
        section = f'<section id="{names[0]}">'
        text = text.replace(section, f"<h2>{title}</h2>\n{section}")
        links = " ".join(f'<li><a href="#{name}">{name}</a></li>' for name in names)
        index.append(f"<li><b>{title}</b><ul>{links}</ul></li>")
    body = f'<nav class="contents" aria-label="Contents"><ul>{"".join(index)}</ul></nav>\n{text}'
    return framed("Functions of topheavy", body, "functions", f"<style>{style}</style>")


def compute(style: str, records: list[str], sheet: str) -> dict[str, str]:
    """Return the page of the library's functions; `sheet` is the style of pages."""
    module = described()
    shown = pictures(module, style, records)
    return {"page": page(module, shown, Path(sheet).read_text("utf-8"))}


if __name__ == "__main__":
    run(snakemake, compute)
