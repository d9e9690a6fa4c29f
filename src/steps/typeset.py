"""Compile a document, which reads results/ itself: the same bytes each time."""

import json
from typing import Any

import typst
import yaml

from replication.config import read_yaml
from replication.step import log_to, publish, stop


class Input:
    """A part of the config that a caption names; in print a number has the mark of its source."""

    def __init__(self, content: Any, path: str = "") -> None:
        self.content, self.path = content, path

    def __getitem__(self, key: str | int) -> "Input":
        return Input(self.content[key], f"{self.path}.{key}".lstrip("."))

    def __format__(self, how: str) -> str:
        return f"⟨config:{self.path}⟩{self.content:{how}}"


class Columns(Input):
    """Columns by their names, in print with height and width."""

    def __getitem__(self, key: str) -> "Columns":
        return Columns(self.content[key], f"{self.path}.{key}")

    def __format__(self, how: str) -> str:
        return " by ".join(
            f"⟨config:{self.path}.{half}⟩{2 * self.content[half]:g} m"
            for half in ("half_height", "half_width")
        )


def captions(path: str, config: dict) -> dict[str, dict]:
    """Return what captions.yaml has of each figure; {keys} in its text are those of the config.

    Each input in the text has the mark of its source, ⟨config:vase.period⟩1.5 (paper/format.typ).
    """
    known = {"config": Input(config), "column": Columns(config["structures"], "structures")}
    try:
        return {
            name: {
                "title": about["title"],
                "alt": about["alt"],
                "text": about["text"].format(**known),
            }
            for name, about in read_yaml(path).items()
        }
    except (KeyError, IndexError) as key:
        stop(f"{path}: a text has {{config[{key.args[0]}]}}, which is no key of config/config.yaml")


def inputs_of(job: Any) -> dict[str, str]:
    """Return what a document takes from the run: studies, config and captions."""
    return {
        "studies": json.dumps(job.params.studies),
        "config": yaml.safe_dump(job.params.config, allow_unicode=True),
        "captions": json.dumps(captions(job.input.captions, job.params.config)),
    }


def compiled(source: str, inputs: dict[str, str], form: str = "pdf") -> bytes:
    """Return a document as PDF or HTML."""
    standards = {"pdf_standards": ["a-2b"]} if form == "pdf" else {}
    try:
        return typst.compile(
            source, root=".", ignore_system_fonts=True, format=form, sys_inputs=inputs, **standards
        )
    except typst.TypstError as fault:  # its text has no place; the diagnostic has
        stop(f"{source} cannot be compiled\n{fault.diagnostic}")


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        pdf = compiled(snakemake.input.source, inputs_of(snakemake))
        publish(snakemake, {snakemake.output[0]: pdf})
