"""What the machine uses of Snakemake beyond its public interface: here, and nowhere else.

pyproject.toml bounds Snakemake's version. `USED` names what classes have to have, and
`MODIFIERS` what rules have: a test fails for each that Snakemake drops.
"""

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

from snakemake.io import regex_from_filepattern

USED = (
    *(f"snakemake.persistence:PersistenceBase.{name}" for name in ("lock", "locked")),
    "snakemake.persistence:PersistenceBase.cleanup_locks",
    "snakemake.scheduling.job_scheduler:JobScheduler.exit_gracefully",
    *(f"snakemake.workflow:Workflow.{name}" for name in ("_prepare_dag", "_build_dag", "rules")),
    *(f"snakemake.dag:DAG.{name}" for name in ("needrun_jobs", "needrun", "finished", "jobs")),
    *(f"snakemake.rules:Rule.{name}" for name in ("set_input", "set_log", "is_producer")),
    *(
        f"snakemake.rules:Rule.{name}"
        for name in ("get_wildcards", "expand_input", "expand_output", "expand_params")
    ),
)
MODIFIERS = ("input_modifier", "log_modifier", "benchmark_modifier")
"""What Snakemake applies to the paths of a rule; None where the rule has no such paths."""


def can_have_paths(rule: Any, workflow: Any) -> None:
    """Let a rule have inputs, a log and a benchmark that its Snakefile does not name."""
    for name in MODIFIERS:
        if getattr(rule, name) is None:
            setattr(rule, name, workflow.modifier.path_modifier)


def script_of(rule: Any, script: str) -> str:
    """Return the path or URI of the script of a rule."""
    return str(rule.basedir.join(script).get_path_or_uri(secret_free=True))


def with_files_of_jobs(rules: Iterable[Any], wanted: Iterable[str]) -> list[str]:
    """Return paths, with all inputs and outputs of the jobs of these rules that make them."""
    found = dict.fromkeys(wanted)
    for rule in rules:
        for path in filter(rule.is_producer, list(found)):
            files, *_ = rule.expand_input(rule.get_wildcards(path))
            made, *_ = rule.expand_output(rule.get_wildcards(path))
            found |= dict.fromkeys(map(str, [*files, *made]))
    return list(found)


def timed_by(rule: Any, names: Iterable[str]) -> list[str]:
    """Return the names of jobs, as costs have them, whose benchmark is one of a rule."""
    if not rule.benchmark:
        return []
    own = re.compile(regex_from_filepattern(str(rule.benchmark)))
    return [name for name in names if own.match(f"results/benchmarks/{name}.tsv")]


def maker_among(rules: Iterable[Any]) -> Callable[[str], Any | None]:
    """Return a function of a path: the first of the rules that makes this file, or None."""
    patterns, plain = [], {}
    for rule in rules:
        if rule.has_wildcards():
            patterns.append(rule)
        else:
            plain |= {str(path): rule for path in rule.output}
    return lambda path: plain.get(path) or next((r for r in patterns if r.is_producer(path)), None)


def users_of(rules: Iterable[Any]) -> dict[Any, list[Any]]:
    """Return, for each rule, those that read what it makes, as far as their inputs are paths."""
    rules = list(rules)
    found: dict[Any, list[Any]] = {rule: [] for rule in rules}
    maker = maker_among(rules)
    for rule in rules:
        paths = {str(path) for path in rule.input if not callable(path)}
        makers = {maker(path) for path in paths if path.startswith("results/")}
        for made in makers - {None}:
            found[made].append(rule)
    return found


def job_of(rule: Any, path: str) -> tuple[dict[str, str], list[Any], list[Any]]:
    """Return wildcards, inputs and parameters of the job of a rule that makes a file."""
    words = rule.get_wildcards(path)
    read = rule.expand_input(words)[0]
    return words, read, rule.expand_params(words, read, rule.expand_output(words)[0], None)[0]


def runs_jobs(workflow: Any) -> bool:
    """Return whether this process is a run, and not a dry run or a job of one."""
    from snakemake_interface_executor_plugins.settings import ExecMode

    is_main = workflow.exec_mode == ExecMode.DEFAULT
    return workflow.scheduler is not None and not workflow.dryrun and is_main


def unfinished(workflow: Any) -> list[Any]:
    """Return the jobs that a run has left."""
    dag = workflow.dag
    return [job for job in dag.needrun_jobs(exclude_finished=False) if not dag.finished(job)]


def targets(workflow: Any) -> set[str]:
    """Return the names of the rules that a run was to make."""
    return {rule.name for rule in workflow.dag.targetrules}


def on_signal(handler: Callable[..., Any]) -> None:
    """Let a function take the place of the scheduler's own handler of SIGTERM."""
    from snakemake.scheduling.job_scheduler import JobScheduler

    JobScheduler.exit_gracefully = handler


def hold_while_locked(alone: Callable[[], AbstractContextManager[None]], killed: str) -> None:
    """Let a run hold `alone()` with Snakemake's lock, and `--unlock` while it removes that.

    A lock of a run that does not hold it any more is refused by the message `killed`.
    """
    from snakemake.exceptions import CliException
    from snakemake.persistence import PersistenceBase

    lock, clean = PersistenceBase.lock, PersistenceBase.cleanup_locks

    @contextmanager
    def locked(self: Any) -> Iterator[None]:
        with alone():
            if self.locked:
                raise CliException(killed)
            with lock(self):
                yield

    def unlocked(self: Any) -> None:
        with alone():
            clean(self)

    PersistenceBase.lock, PersistenceBase.cleanup_locks = locked, unlocked


@contextmanager
def planned(
    root: Path,
    config: Mapping[str, Any],
    targets: Iterable[str] | None,
    triggers: Iterable[str],
) -> Iterator[Any]:
    """Read the Snakefile of a folder, plan its jobs, and give the workflow with its DAG.

    Without targets, these are all rules that can be requested by name.
    """
    from snakemake.api import SnakemakeApi
    from snakemake.settings.enums import Quietness, RerunTrigger
    from snakemake.settings.types import (
        ConfigSettings,
        DAGSettings,
        OutputSettings,
        ResourceSettings,
    )

    with SnakemakeApi(OutputSettings(quiet={Quietness.ALL})) as api:
        parsed = api.workflow(
            resource_settings=ResourceSettings(cores=1),
            config_settings=ConfigSettings(config=dict(config)),
            snakefile=(root / "Snakefile").resolve(),
            workdir=root.resolve(),
        )
        workflow = parsed._workflow
        if targets is None:
            targets = [rule.name for rule in workflow.rules if not rule.has_wildcards()]
        chosen = RerunTrigger.parse_choices_set(list(triggers))
        parsed.dag(DAGSettings(targets=set(targets), rerun_triggers=chosen))
        workflow._prepare_dag(forceall=False, ignore_incomplete=True, lock_warn_only=True)
        workflow._build_dag()
        yield workflow
