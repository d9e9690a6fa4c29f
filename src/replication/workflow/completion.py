"""What a rule has without saying so: inputs from its script, a message, a log, a benchmark."""

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from snakemake.io import expand, strip_wildcard_constraints

from replication.workflow.code import code, docstring
from replication.workflow.internals import can_have_paths, script_of


def complete(workflow: Any, *, timed: bool = True) -> None:
    """Give each rule that has a script the code of it as inputs, and what it lacks of the rest.

    The message is the first line of the script's docstring; log and benchmark have the name of the
    rule, and the values of its wildcards. The script is an input, too: Snakemake compares the
    contents of inputs, and of scripts only the times. Without `timed`, no rule gets a benchmark.

    Raises
    ------
    ValueError
        When a rule makes outputs without a script: a change of its code would rerun nothing.
    AttributeError
        When Snakemake's rules have no such attribute any more.
    """
    for rule in workflow.rules:
        if not rule.script:
            if rule.output:
                raise ValueError(
                    f"rule {rule.name} makes {rule.output[0]} without a script; expected "
                    "`script:`, whose code is compared: move its commands into a script"
                )
            continue
        can_have_paths(rule, workflow)
        script = os.path.relpath(script_of(rule, rule.script))
        needed, there = [CodeOf(script)] if "{" in script else code(script), list(rule.input)
        rule.set_input(*(item for item in needed if item not in there))
        if rule.message is None and "{" not in script:
            rule.message = _message(script, rule.wildcard_names)
        if rule.log:
            continue
        name = "_".join([rule.name, *(f"{{{word}}}" for word in sorted(rule.wildcard_names))])
        rule.set_log(f"results/logs/{name}.log")
        if timed:
            rule.benchmark = f"results/benchmarks/{name}.tsv"


def findings_made(rules: Iterable[Any]) -> Iterator[str]:
    """Yield the names of all findings: of the outputs that rules call `findings`."""
    for rule in rules:
        if path := dict(rule.output.items()).get("findings"):
            words = {word: values.split("|") for word, values in rule.wildcard_constraints.items()}
            yield from expand(Path(strip_wildcard_constraints(path)).stem, **words)


@dataclass(frozen=True)
class CodeOf:
    """The input function of a rule whose script has wildcards in its path."""

    script: str

    def __call__(self, wildcards: Any) -> list[str]:
        """Return the script of a job, and what it imports."""
        return code(self.script.format(wildcards=wildcards))


def _message(script: str, wildcards: Iterable[str]) -> str | None:
    """Return what a script does, as its docstring begins, and of which of its jobs."""
    if not script.endswith(".py"):
        return None
    line, *_ = (docstring(script) or script).splitlines()
    line = line.removesuffix(".").replace("{", "{{").replace("}", "}}")
    of = ", ".join(f"{{wildcards.{word}}}" for word in sorted(wildcards))
    return f"{line} ({of})" if of else line
