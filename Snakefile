"""Makris & Vassiliou (2014): config → tables → findings → verdicts, figures, documents.

A rule names its script, inputs, outputs, and as parameters its code and its section of the config.
A change of one of them repeats the rule, also when a file has an older time.
"""

import os
import re
import sys
import time
from base64 import urlsafe_b64encode
from functools import cache
from glob import glob
from importlib.util import find_spec
from pathlib import Path

from snakemake.utils import min_version

library = find_spec("topheavy")
BASE = Path(workflow.basedir).resolve()
if library and Path(library.origin).resolve().is_relative_to(BASE):
    if Path.cwd() != BASE:
        sys.exit(f"this folder is {Path.cwd()}; all paths are of {BASE}: run there")
else:
    sys.exit(
        f"the environment {sys.prefix} is not of this folder (its library is "
        f"{library.origin if library else 'missing'}): a copied .venv still belongs to the folder "
        "where it was made. Remove it, then make reproduce; or: pip install -e ."
    )
sys.path.insert(0, "src")
from replication.claims import read_claims
from replication.config import components, read_config, read_yaml
from replication.sections import Paper
from replication.sources import checksums, digest, imported, is_sealed, versions

min_version("9.27")
if re.search(r"[^\w@%+=:,./-]", sys.executable):
    sys.exit(
        f"Snakemake does not quote the path of its Python, {sys.executable}: move the folder, or the "
        "environment, to a path without spaces"
    )
BEGUN = time.time()
# Jobs keep the compiled modules that they import, also where an image forbids it: two seconds a job.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)


for path in ["config/config.yaml", *workflow.configfiles]:
    read_yaml(path)  # its mistakes have a line, and it refuses a doubled key


configfile: "config/config.yaml"


report: "paper/overview.rst"


# The scripts of each rule: a rule joins by code(…), and Snakemake's `rules` has the rest.
SCRIPTS = {}


def code(script, *more, rule=""):
    """Return what the results of a rule depend on beside its parameters, as one more parameter.

    These are, by checksum or version: the script and all that it imports; packages; inputs that no
    rule makes; and the rules that make its other inputs. A rule has the name of its script, or `rule`.
    The digest of all this, and of its parameters, goes into the seals of its results.
    """
    for path in (script, *more):
        if not os.path.isfile(path):
            sys.exit(f"a rule names the file {path}, which is not there")
    name = rule or Path(script).stem
    if name in SCRIPTS:
        sys.exit(
            f"two rules are {name} in code(…); expected code(…, rule=…) with their names"
        )
    SCRIPTS[name] = (script, *more)
    return lambda wildcards: dependencies(name) | {f"rule {name}": digest_of(name)}


def digest_of(name):
    """Return the digest of what the results of a rule depend on."""
    return digest(dependencies(name), parameters(name))


@cache
def dependencies(name):
    """Return what the results of a rule depend on, from all rules."""
    modules = imported(*SCRIPTS[name])
    before = sorted({maker(path) for path in inputs(name)} - {""})
    return (
        checksums(modules)
        | versions(modules)
        | sources(name)
        | {f"rule {n}": digest_of(n) for n in before}
    )


def inputs(name):
    return [str(path) for path in getattr(rules, name).input]


def outputs(name):
    return [str(path) for path in getattr(rules, name).output]


def parameters(name):
    """Return the parameters of a rule without its code."""
    pairs = getattr(rules, name).params.items()
    return {key: content for key, content in pairs if key != "code"}


def sources(name):
    """Return the inputs of a rule that no rule makes, with their checksums.

    Snakemake would keep a result without a word where its rule reads an old file in results/.
    """
    paths = [path for path in inputs(name) if not maker(path)]
    for path in paths:
        if path.startswith("results/") or not os.path.isfile(path):
            folder = Path(path).parent
            beside = [other for other in made() if Path(other).parent == folder]
            sys.exit(
                f"rule {name} ({SCRIPTS[name][0]}) reads {path}, which no rule makes; expected one "
                f"of {', '.join(beside)}"
            )
    return checksums(paths)


@cache
def maker(path):
    """Return the name of the rule that makes a file, or nothing."""
    for name in SCRIPTS:
        for output in outputs(name):
            if re.fullmatch(re.sub(r"{\w+}", ".+", output), path):
                return name
    return ""


def shown(path, category="Tables"):
    """Return an output that `snakemake --report` shows, with a caption from rules/."""
    return report(path, caption="report.rst", category=category)


def made(ending=""):
    """Return the files that rules make so far."""
    paths = sorted(path for name in SCRIPTS for path in outputs(name))
    return [path for path in paths if path.endswith(ending) and "{" not in path]


def strays():
    """Yield results that the job on Snakemake's record did not write, or not as they are.

    Snakemake itself makes those of an interrupted job again.
    """
    for name in SCRIPTS:
        for path in sum((glob(re.sub(r"{\w+}", "*", o)) for o in outputs(name)), []):
            key = urlsafe_b64encode(path.encode()).decode()  # of a file in .snakemake
            record = Path(".snakemake/metadata", key)
            known = re.findall(
                rf"'rule {name}': '(\w+)'",
                record.read_text("utf-8") if record.is_file() else "",
            )
            if not is_sealed(path, known) and not os.path.isfile(
                f".snakemake/incomplete/{key}"
            ):
                yield path


CONFIGS = [*map(os.path.relpath, workflow.configfiles)]
if any(text.startswith("--config=") or text in ("--config", "-C") for text in sys.argv):
    CONFIGS.insert(
        0,
        "--config, which makes texts of numbers in brackets or braces (use --configfile),",
    )
PAPER = read_config(" over ".join(CONFIGS), Paper, config)


include: "rules/paper.smk"
include: "rules/beyond.smk"
include: "rules/documents.smk"


for name in SCRIPTS:
    sources(name)  # before any job
if foreign := sorted(strays()):
    few = f"rm {' '.join(foreign)}, or " if len(foreign) < 6 else ""
    sys.exit(
        f"{foreign[0]}{f' and {len(foreign) - 1} others are' if foreign[1:] else ' is'} not what a job "
        "wrote here with the code and parameters on Snakemake's record (it was made elsewhere, edited, or written by "
        f"a job of a killed run; or the record was renewed by --touch or cleaned up): {few}make clean. Then run again"
    )


rule all:
    default_target: True
    input:
        made(),
    message:
        "All results are there"


def last_lines():
    """Print verdicts, faults and where results lie, if this run has come so far."""
    log = Path("results/logs/expected.log")
    if log.is_file() and log.stat().st_mtime >= BEGUN:
        print(log.read_text("utf-8"), end="")


onstart:
    for called, paths in (("horizontal", HORIZONTAL), ("vertical", UPWARD)):
        names = ", ".join(map(os.path.basename, paths))
        print(f"Records taken as {called} components: {names or 'none'}")


onsuccess:
    last_lines()


onerror:
    last_lines()
