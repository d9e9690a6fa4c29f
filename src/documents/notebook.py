"""Execute a notebook, the same bytes each time, and render it as a page without scripts."""

import json
import os
import re
import tempfile
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert

from documents.frame import framed
from replication.job import log_to, write

CELLS = """
{%- extends "base/display_priority.j2" -%}
{%- block markdowncell %}{{ cell.source | markdown2html }}{% endblock -%}
{%- block input %}{{ cell.source | highlight_code(metadata=cell.metadata) }}{% endblock -%}
{%- block execute_result -%}
{% block data_priority scoped %}{{ super() }}{% endblock %}
{%- endblock -%}
{%- block stream %}<pre>{{ output.text | ansi2html }}</pre>{% endblock -%}
{%- block data_text %}<pre>{{ output.data["text/plain"] | ansi2html }}</pre>{% endblock -%}
{%- block data_html -%}
<div class="scroll" tabindex="0">
{{ output.data["text/html"] | replace("<th></th>", "<td></td>") }}
</div>
{%- endblock -%}
{%- block data_latex -%}
<div class="equation" tabindex="0">{{ output.data["text/latex"] | mathml }}</div>
{%- endblock -%}
{%- block data_png -%}
<img class="picture" src="data:image/png;base64,{{ output.data["image/png"] | escape_html }}"
alt="{{ output | get_metadata("alt", "image/png") | escape_html }}">
{%- endblock -%}
"""
"""The cells of a page; formulas are MathML, and pictures have the texts that their cells give."""

MODULES = """
import sys
for module in list(sys.modules.values()):
    if path := getattr(module, "__file__", None):
        print(path)
"""
"""A last cell, which does not stay: the kernel tells what it has loaded, each file in a line, as
nbclient takes a time that grows with the square of a line."""


def render(notebook: Any, style: str) -> str:
    """Return an executed notebook as a page, with its first heading as its title."""
    from jinja2 import DictLoader
    from nbconvert import HTMLExporter
    from nbconvert.filters.markdown_mistune import IPythonRenderer, MarkdownWithMath

    class Renderer(IPythonRenderer):
        """Markdown with its formulas as MathML."""

        def inline_math(self, body: str) -> str:
            return convert(body)

        def block_math(self, body: str) -> str:
            return convert(body, display="block")

    exporter = HTMLExporter(
        extra_loaders=[DictLoader({"cells.html.j2": CELLS})],
        template_file="cells.html.j2",
        filters={
            "mathml": lambda latex: convert(latex.strip("$"), display="block"),
            "markdown2html": lambda text: MarkdownWithMath(
                Renderer(escape=False, exclude_anchor_links=True)
            ).render(text),
        },
    )
    body, _ = exporter.from_notebook_node(notebook)
    title = re.search("<h1[^>]*>(.*?)</h1>", body)[1]
    return framed(title, f"<main>{body}</main>", "notebook", f"<style>{style}</style>")


def execute(source: Path) -> Any:
    """Return a notebook with the outputs of its cells; its metadata name the modules it loaded."""
    private = tempfile.mkdtemp()  # nothing of a user's own set-up may leak in
    Path(private, "matplotlibrc").touch()
    os.environ |= {
        "IPYTHONDIR": private,
        "JUPYTER_CONFIG_DIR": private,
        "MATPLOTLIBRC": private,
        "JUPYTER_PLATFORM_DIRS": "1",
    }
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(source, as_version=4)
    notebook.cells.append(nbformat.v4.new_code_cell(MODULES))
    client = NotebookClient(
        notebook,
        timeout=300,
        record_timing=False,
        coalesce_streams=True,  # or one text is one output or several, by the speed of the machine
        resources={"metadata": {"path": str(source.parent)}},
        extra_arguments=["--log-level=ERROR"],  # not that the kernel listens on this machine
    )
    client.execute()
    (listed,) = notebook.cells.pop().outputs
    notebook.metadata["modules"] = listed["text"].splitlines()
    return notebook


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        source = Path(snakemake.input.notebook)
        notebook = execute(source)
        modules = notebook.metadata.pop("modules")
        texts = {
            snakemake.output.executed: json.dumps(notebook, indent=1, ensure_ascii=False) + "\n",
            snakemake.output.page: render(notebook, Path(snakemake.input.sheet).read_text("utf-8")),
        }
        write(snakemake, texts, modules)
