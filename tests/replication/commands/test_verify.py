"""A finished tree against its RO-Crate."""

import hashlib

import pytest

from replication.commands.verify import main
from replication.origin.recorded import Crate

FILES = {
    "results/tables/peaks.csv": "a,b\n1,2\n",
    "results/logs/peaks.log": "said\n",
    "results/costs.csv": "rule,seconds\n",
    "figures/peaks.svg": "<svg/>\n",
    "figures/peaks.py": "draw()\n",
}
MADE = ("results/tables/peaks.csv", "figures/peaks.svg")
CRATE = Crate(
    checksums={
        name: hashlib.sha256(FILES[name].encode()).hexdigest()
        for name in (*MADE, "figures/peaks.py")
    },
    rules=dict.fromkeys(MADE, "peaks"),
    left_out=("results/costs.csv", "results/logs"),
    version="",
)


@pytest.mark.parametrize(
    ("name", "told"),
    [
        ("results/tables/peaks.csv", "changed after rule peaks made it: its SHA-256 is "),
        ("figures/peaks.py", "changed after the run: its SHA-256 is "),
        ("results/new/other.csv", "is extra: no rule made it; move it away"),
        ("results/x.txt", "is extra: no rule made it; move it away"),
        ("figures/other.svg", "is extra: no rule made it; move it away"),
        # logs, costs and what the run did not read are not the crate's
        ("results/logs/claim.log", None),
        ("results/costs.csv", None),
        ("figures/new.py", None),
    ],
)
def test_file_that_is_not_as_the_run_left_it_is_named(plant, tmp_path, name, told):
    assert main(CRATE, plant(tmp_path, FILES)) == []
    faults = main(CRATE, plant(tmp_path, {name: "other than before"}))
    assert [fault.startswith(f"{name} {told}") for fault in faults] == [True] * bool(told)


def test_missing_file_names_the_rule_that_makes_it(plant, tmp_path):
    (plant(tmp_path, FILES) / "figures/peaks.svg").unlink()
    assert main(CRATE, tmp_path) == ["figures/peaks.svg is missing; rule peaks makes it"]


def test_link_in_place_of_a_file_or_beside_one_is_named(plant, tmp_path):
    path = plant(tmp_path, FILES) / "figures/peaks.svg"
    path.rename(tmp_path / "other.svg")
    path.symlink_to(tmp_path / "other.svg")
    (tmp_path / "results/more").symlink_to(tmp_path / "figures")
    link, extra = main(CRATE, tmp_path)
    assert link.startswith("figures/peaks.svg is a link; expected the file itself")
    assert extra == "results/more is extra: no rule made it; move it away"
