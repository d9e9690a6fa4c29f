"""Execute a notebook, the same bytes each time, and render it as HTML."""

import os
import tempfile
from pathlib import Path

from replication.workbench import run


def main(source: Path, executed: Path, page: Path) -> None:
    # Jupyter reads these when it is imported: nothing of a user's own set-up may leak in.
    private = tempfile.mkdtemp()
    os.environ |= {"IPYTHONDIR": private, "JUPYTER_CONFIG_DIR": private}
    os.environ |= {"JUPYTER_PLATFORM_DIRS": "1"}
    import nbformat
    from nbclient import NotebookClient
    from nbconvert import HTMLExporter

    notebook = nbformat.read(source, as_version=4)
    client = NotebookClient(
        notebook,
        timeout=300,
        record_timing=False,
        resources={"metadata": {"path": str(source.parent)}},
    )
    client.execute()
    nbformat.write(notebook, executed)
    body, _ = HTMLExporter(
        exclude_input_prompt=True, exclude_output_prompt=True
    ).from_notebook_node(notebook, resources={"metadata": {"name": source.stem}})
    page.write_text(body, encoding="utf-8")


if __name__ == "__main__":
    run(snakemake, lambda job: main(*map(Path, (job.input.notebook, *job.output))))
