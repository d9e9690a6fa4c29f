"""What a Snakefile of a replication begins with, and what its rules share."""

import gc
import os
from functools import cache, partial
from pathlib import Path

from replication.pages.captions import (
    alternative,
    captioned,
    check_captions,
    read_captions,
)
from replication.workflow.closing import close
from replication.workflow.code import code, results_read
from replication.workflow.completion import complete, findings_made
from replication.workflow.costs import paths, read_costs
from replication.workflow.forks import start_scripts_as_forks
from replication.workflow.internals import with_files_of_jobs
from replication.origin.recorded import CRATE
from replication.judging.ledger import read_judged, read_ledger
from replication.judging.ledger_check import check_ledger
from replication.inputs.configuration import Sections
from replication.inputs.parts import PAPER, Part
from replication.workflow.origins import Origins, published_results
from replication.workflow.lock import one_run_at_a_time
from replication.workflow.place import check_place
from replication.workflow.provenance import note_jobs
from replication.workflow.progress import one_line_a_job
from replication.workflow.stopping import end_on_sigterm
from replication.inputs.strict_yaml import read_yaml
from replication.inputs.study_config import check_needs, read_study_config
from replication.pages.opening import opening
from replication.pages.typeset import reads, refuse_unshown
from replication.workflow.unmade import made_by, refuse_unmade

gc.disable()  # until jobs begin: a DAG leaves hardly any garbage; the search for it takes 0.6 s
check_place()
close(workflow)
end_on_sigterm()
one_run_at_a_time()
if not workflow.dryrun:
    one_line_a_job()


report: "pages/opening.rst"


def begin():
    """Begin a run: note its jobs, and start the process that their scripts are forks of."""
    gc.enable()
    note_jobs(workflow)
    start_scripts_as_forks(workflow)


onstart:  # of a Snakefile without its own
    begin()


def read_strictly(path):
    """Read the config files with file and line of a mistake: Snakemake keeps the last of equal keys."""
    for each in [path, *workflow.configfiles]:
        read_yaml(each)


def config_files():
    """Return the names of the config files; those of --configfile, which go over it, come first."""
    return " over ".join(dict.fromkeys(map(os.path.relpath, workflow.configfiles)))


def parts(check):
    """Return the parts of the work by name: the paper, and the studies that the config names.

    `check` raises a ValueError for what is wrong with the config of a study.
    """
    over = [Path(each).name for each in workflow.configfiles]
    over = [each for each in dict.fromkeys(over) if each != "config.yaml"]
    global config
    config = Sections(config)
    studies = {
        name: Sections(read_study_config(name, check, over=over))
        for name in config["studies"]
    }
    for name, section in studies.items():
        section.path = f"studies/{name}/config.yaml"
    check_needs(studies)
    return {name: Part(name, of) for name, of in {PAPER: config, **studies}.items()}


def everything(wildcards):
    """Return all inputs and outputs of a run, except the crate that lists them, which is made last."""
    return made_or_read()


@cache
def made_or_read():
    """Return all inputs and outputs of a run but the crate; the rules are complete when it is asked.

    What only another job needs is named as well: when it is missing, Snakemake makes it again only
    if somebody requests it. A failed or interrupted job leaves its outputs missing.
    """
    drawn = {table for tables in FIGURES.values() for table in tables}
    wanted = dict.fromkeys(f"results/tables/{table}.csv" for table in sorted(drawn))
    rules = [each for each in workflow.rules if each.name != "crate" and each.output]
    for each in rules:
        asked = [*each.input, *([] if each.has_wildcards() else each.output)]
        wanted |= dict.fromkeys(str(path) for path in asked if not callable(path))
    wanted = {path: None for path in wanted if "{" not in path}
    # A rule with wildcards reads and makes what its jobs do, and these are known by one of their files.
    return with_files_of_jobs([each for each in rules if each.has_wildcards()], wanted)


def longest_first():
    """Start first what begins the longest path to the end; a rule's own priority is added."""
    for each, seconds in paths(workflow.rules, read_costs(Path("docs/costs.csv"))):
        each.priority += round(seconds)


def only_shards_leave_this_machine():
    """Run all but the shards where Snakemake runs, when it sends jobs to a cluster.

    A shard has the wildcard of scattergather. Without a cluster this changes nothing.
    """
    workflow.localrules(
        *(
            each.name
            for each in workflow.rules
            if "scatteritem" not in each.wildcard_names
        )
    )


def caption_of(result):
    """Return what the HTML report says of a result: its caption and verdict (caption.rst)."""
    claims = read_judged("results/claims.json")
    captions = read_captions(part.captions for part in PARTS.values())
    return captioned(str(result), captions, claims)


def shown(output):
    """Mark the last output of a rule for the HTML report; its caption is looked up when that is made.

    One label alone, since Snakemake's page turns a second one that has two values into a switch.
    """

    def label(wildcards, output):
        about = caption_of(output[-1])
        return {"result: claims": f"{about['title']}: {about['verdict']}"}

    return report(
        output,
        caption=str(Path(workflow.basedir, "src/replication/pages/caption.rst")),
        category=lambda wildcards, output: caption_of(output[-1])["category"],
        labels=label,
    )
