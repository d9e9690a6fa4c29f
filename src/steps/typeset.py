"""Compile a document, which reads results/ itself: the same bytes each time."""

import json
from typing import Any

import typst
import yaml

from replication.config import read_yaml
from replication.numbers import Numbers, inputs
from replication.step import log_to, publish, stop


def captions(path: str, config: dict) -> dict[str, dict]:
    """Return title, alternative text and text of each figure; {keys} are those of the config."""
    try:
        return {
            name: {
                "title": about["title"],
                "alt": about["alt"],
                "text": about["text"].format(**inputs(config)),
            }
            for name, about in read_yaml(path).items()
        }
    except (KeyError, IndexError) as key:
        stop(f"{path}: a text has {{{key.args[0]}}}, which is no key of config/config.yaml")


def compiled(source: str, inputs: dict[str, str], **how: Any) -> bytes:
    """Return a document as PDF or HTML."""
    try:
        return typst.compile(source, root=".", ignore_system_fonts=True, sys_inputs=inputs, **how)
    except typst.TypstError as fault:  # its text has no place; the diagnostic has
        stop(f"{source} cannot be compiled\n{fault.diagnostic}")


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        source, config = snakemake.input.source, snakemake.params.config
        texts = {
            "studies": json.dumps(snakemake.params.studies),
            "config": yaml.safe_dump(config, allow_unicode=True),
            "captions": json.dumps(captions(snakemake.input.captions, config)),
        }
        html = compiled(source, texts | {"check": "numbers"}, format="html").decode()
        if without := Numbers(html).without:
            stop(
                f"{source}: numbers without a source (paper/format.typ says how to write one)\n"
                + "\n".join(f"{number} in: {sentence}" for number, sentence in without)
            )
        publish(snakemake, {snakemake.output[0]: compiled(source, texts, pdf_standards=["a-2b"])})
