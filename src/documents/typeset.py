"""Compile a document, which reads results/ itself: the same bytes each time."""

import json
import re
from typing import Any

import typst
import yaml

from documents.quotes import Numbers
from replication.config import read_yaml
from replication.job import log_to, stop, write
from replication.marks import inputs


class NoMeaning(SystemExit):
    """A document that is not made, since a sentence has no meaning with this config."""


def captions(path: str, config: dict) -> dict[str, dict]:
    """Return what captions.yaml has of each figure; {keys} in its text are those of the config."""
    texts = {}
    for name, about in read_yaml(path).items():
        try:
            text = about["text"].format(**inputs(config))
        except KeyError as key:
            stop(
                f"{path}: the caption of {name} names {key.args[0]}, which is no key of the config"
            )
        texts[name] = about | {"text": text}
    return texts


def texts_of(config: dict[str, Any], captions_of: str) -> dict[str, str]:
    """Return what a document takes from the run beside results/."""
    return {
        "config": yaml.safe_dump(config, allow_unicode=True),
        "captions": json.dumps(captions(captions_of, config)),
    }


def compiled(source: str, texts: dict[str, str], root: str = ".", **how: Any) -> bytes:
    """Return a document as PDF or HTML; `root` is the folder of its absolute paths."""
    try:
        path = f"{root}/{source}"
        return typst.compile(path, root=root, ignore_system_fonts=True, sys_inputs=texts, **how)
    except typst.TypstError as fault:  # its text has no place; the diagnostic has
        if hit := re.search(r"no meaning: (\S+): (.*)", fault.diagnostic):
            raise NoMeaning(
                f"{source} is not made: with {hit[1]} of config/config.yaml as it is, there is no "
                f"meaning in: {hit[2]}"
            ) from None
        stop(f"{source} cannot be compiled\n{fault.diagnostic}")


def checked(source: str, texts: dict[str, str], root: str = ".") -> Numbers:
    """Return the page of a document; stop at a number that has neither a source nor a reason."""
    html = compiled(source, texts | {"web": "yes"}, root, format="html").decode()
    if without := (numbers := Numbers(html)).without:
        stop(
            f"{source}: numbers without a source (paper/format.typ says how to write one)\n"
            + "\n".join(f"{number} in: {sentence}" for number, sentence in without)
        )
    return numbers


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        source, params = snakemake.input.source, snakemake.params
        texts = texts_of(params.config, snakemake.input.captions)
        write(snakemake, {snakemake.output[0]: compiled(source, texts, pdf_standards=["a-2b"])})
