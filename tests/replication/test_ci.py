"""CI in two depths: slow parts run by name, and what is left out is said."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CI = "src/replication/ci"
ALWAYS = [
    "a browser",
    "installation and lint",
    "make reproduce",
    "make reproduce, once more",
    "make check",
    "make verify",
    "make test",
]
CLUSTER = {"make cluster-test"}  # of a paper that has one
IGNORED = "results/\nmade\n*.svg\n*.pdf\nmake\nchromium\n"
MAKE = """#!/bin/sh
echo "$1" >> made
if [ "$1" = reproduce ]; then
  mkdir -p results/tables results/findings
  for name in tables/a.csv findings/a.json claims.json; do
    test -e results/$name || echo bytes > results/$name
  done
  echo "Nothing to be done"
fi
"""


class Tree:
    """A repository with the scripts of CI, and a make that writes down its targets."""

    def __init__(self, folder, paper=True):
        self.folder = folder
        self.environment = os.environ | {
            "PATH": f"{folder}:{os.environ['PATH']}",
            "GIT_CONFIG_GLOBAL": "/dev/null",
            "GIT_CEILING_DIRECTORIES": str(folder.parent),
        }
        ignored = None if paper else shutil.ignore_patterns("paper")
        for part in (".ci", CI):
            shutil.copytree(ROOT / part, folder / part, ignore=ignored)
        for name, text in ((".gitignore", IGNORED), ("make", MAKE), ("chromium", "#!/bin/sh\n")):
            (folder / name).write_text(text, encoding="utf-8")
            (folder / name).chmod(0o755)
        self.run("git", "init", "--quiet")

    def run(self, *command, **environment):
        return subprocess.run(
            command,
            cwd=self.folder,
            env=self.environment | environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
        )

    def commit(self):
        who = ("-c", "user.name=a", "-c", "user.email=a@b.c")
        self.run("git", "add", "--all")
        done = self.run("git", *who, "commit", "--quiet", "--allow-empty", "--message=x")
        assert done.returncode == 0, done.stderr

    def plan(self, *words):
        """Return which parts would run, and which are left out."""
        done = self.run("bash", ".ci/run", "plan", *words)
        assert done.returncode == 0, done.stderr
        left = re.findall(r"^!!! LEFT OUT: ([^:]+): ", done.stderr, re.MULTILINE)
        return re.findall(r"^=== (.+)$", done.stdout, re.MULTILINE), left


@pytest.fixture
def tree(tmp_path):
    return Tree(tmp_path)


def test_quick_parts_run_each_time_and_all_leaves_out_nothing_but_the_cluster(tree):
    tree.commit()
    everything, left = tree.plan("all")
    assert set(left) <= CLUSTER
    assert [part for part in everything if part in ALWAYS] == ALWAYS
    assert everything[-1] == "make test"
    for _ in range(3):
        tree.commit()
        runs, left = tree.plan()
        assert runs == ALWAYS
        assert set(left) - CLUSTER == {"slow parts"}
    listed = tree.run("bash", ".ci/run", "list").stdout.splitlines()
    assert set(listed) == set(everything) - set(ALWAYS)
    assert {"every twelfth step again", "make archive", "a study comes and goes"} < set(listed)
