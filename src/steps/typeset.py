"""Compile a document, which reads results/ itself: the same bytes each time."""

import json

import typst
import yaml

from replication.config import read_yaml
from replication.step import log_to, publish, stop


def captions(path: str, config: dict) -> dict[str, dict]:
    """Return title, alternative text and text of each figure; {keys} are those of the config."""
    try:
        return {
            name: {
                "title": about["title"],
                "alt": about["alt"],
                "text": about["text"].format(config=config),
            }
            for name, about in read_yaml(path).items()
        }
    except (KeyError, IndexError) as key:
        stop(f"{path}: a text has {{config[{key.args[0]}]}}, which is no key of config/config.yaml")


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        inputs = {
            "studies": json.dumps(snakemake.params.studies),
            "config": yaml.safe_dump(snakemake.params.config, allow_unicode=True),
            "captions": json.dumps(captions(snakemake.input.captions, snakemake.params.config)),
        }
        try:
            pdf = typst.compile(
                snakemake.input.source,
                root=".",
                ignore_system_fonts=True,
                pdf_standards=["a-2b"],
                sys_inputs=inputs,
            )
        except typst.TypstError as fault:  # its text has no place; the diagnostic has
            stop(f"{snakemake.input.source} cannot be compiled\n{fault.diagnostic}")
        publish(snakemake, {snakemake.output[0]: pdf})
