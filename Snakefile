"""Makris & Vassiliou (2014): config → tables → findings → verdicts, figures, documents.

A rule names its script, inputs, outputs, and as parameters its code and its section of the config.
A change of one of them repeats the rule. A study is a folder in studies/, named in `studies`.
"""

import os
import re
import sys
import time
from glob import glob
from hashlib import sha256

from snakemake.utils import min_version

sys.path.insert(0, "src")
from replication.claims import read_claims
from replication.config import *
from replication.sections import Paper

min_version("9.27")
if re.search(r"[^\w@%+=:,./-]", sys.executable):
    sys.exit(
        f"Snakemake does not quote the path of its Python, {sys.executable}: move the folder, or the "
        "environment, to a path without spaces"
    )
BEGUN = time.time()
os.environ["RUN"] = str(os.getpid())  # a step whose run has ended writes nothing


configfile: "config/config.yaml"


def checksums(*paths):
    """Return files with their checksums: as a parameter of a rule, a change repeats it."""
    if missing := [path for path in paths if not os.path.isfile(path)]:
        sys.exit(f"a rule names the file {missing[0]}, which is not there")
    return {
        path: sha256(open(path, "rb").read()).hexdigest()[:12] for path in sorted(paths)
    }


code = checksums


def library(*folders):
    """Return the modules of folders of the library with their checksums."""
    inside = [
        glob(f"src/topheavy/{folder}/**/*.py", recursive=True) for folder in folders
    ]
    return code(*(path for paths in inside for path in paths))


def made(ending=""):
    """Return the files that rules make so far."""
    paths = (str(path) for each in workflow.rules for path in each.output)
    return sorted(path for path in paths if path.endswith(ending) and "{" not in path)


for path in ["config/config.yaml", *workflow.configfiles]:
    read_yaml(path)  # refuses a doubled key
PAPER = read_config(
    " over ".join(map(os.path.relpath, workflow.configfiles)), Paper, config
)
SMALL = [
    path for path in glob("src/topheavy/*.py*") if os.path.basename(path) != "plot.py"
]
STEP = code(
    "src/replication/__init__.py", "src/replication/step.py", "src/steps/__init__.py"
)
CORE = STEP | code(*SMALL) | library("bodies", "ground", "kernel", "outcomes")
DOCUMENTS = STEP | code(
    *glob("src/replication/*.py")
)  # what claims, figures and documents load
SETTINGS = {"paper": PAPER}  # each study adds its own

if os.path.isdir("results") and not os.path.isdir(".snakemake/metadata"):
    sys.exit(
        "results/ was made elsewhere, so that Snakemake cannot tell what is stale: make clean"
    )


include: "rules/paper.smk"
include: "rules/beyond.smk"


for study in PAPER["studies"]:
    if not os.path.isfile(f"studies/{study}/study.smk"):
        sys.exit(
            f"config/config.yaml: studies has {study!r}; expected the name of a folder in studies/"
        )

    include: f"studies/{study}/study.smk"


include: "rules/documents.smk"


# Snakemake keeps a result without a word where its rule reads a file that no rule makes.
MADE = made()
for each in workflow.rules:
    for path in (str(path) for path in each.input if not callable(path)):
        is_source = os.path.isfile(path) and not path.startswith("results/")
        if is_source or "{" in path or path in MADE:
            continue
        if not any(other.is_producer(path) for other in workflow.rules):
            folder = os.path.dirname(path)
            beside = [other for other in MADE if os.path.dirname(other) == folder]
            sys.exit(
                f"rule {each.name} ({os.path.relpath(each.snakefile)}) reads {path}, which no rule "
                f"makes; expected one of {', '.join(beside)}"
            )


rule all:
    default_target: True
    input:
        MADE,
        expand("results/notebooks/{name}.html", name=NOTEBOOKS),
    message:
        "All results are there"


def summary():
    """Print the verdicts, if this run has made them."""
    path = "results/summary.txt"
    if os.path.isfile(path) and os.path.getmtime(path) >= BEGUN:
        print(open(path).read(), end="")


onstart:
    for called, paths in (("horizontal", HORIZONTAL), ("vertical", UPWARD)):
        names = ", ".join(map(os.path.basename, paths))
        print(f"Records taken as {called} components: {names or 'none'}")


onsuccess:
    summary()


onerror:
    summary()
