"""The chain from an output, a claim or a finding back to the paper and the inputs."""

import hashlib
import json
from dataclasses import replace

import pytest

from replication.commands.trace import Item, Job, chain, find, read_jobs
from replication.judging.claim import Claim
from tests.cases import ROOT

CLAIM = Claim(
    id="peak_is_low",
    where="p. 3, Eq. (24)",
    statement="The peak is low.",
    function="topheavy.bodies.structures.size_ratio",
    rule="peaks",
    finding="low",
    expected="confirmed",
)
UNTESTED = Claim(
    id="photograph",
    where="p. 1",
    statement="It survived.",
    expected="not tested",
    remark="Not to be computed.",
)
EQUATIONS = [replace(UNTESTED, id=name) for name in ("eq9_positive", "eq19", "eq9_negative")]
LEDGER = [CLAIM, UNTESTED, *EQUATIONS]
TABLE, FOUND = "results/tables/peaks.csv", "results/findings/peaks.json"
STEP = Job("peaks", "Snakefile:7", ("src/steps/peaks.py",), ("data/record.AT2",), (TABLE, FOUND))
FIGURE = Job("figure", "Snakefile:9", ("figures/peaks.py",), (TABLE,), ("figures/peaks.svg",))
JOBS = [FIGURE, STEP]
FILES = {
    "src/steps/peaks.py": "from topheavy import RockingFrame\n",
    "figures/peaks.py": "import math\n",
    "data/record.AT2": "0.1\n",
    TABLE: "1\n",
    FOUND: json.dumps(
        {
            "low": {"holds": True},
            "height": {"value": 0.5, "error": 1e-9, "unit": "m"},
            "pull_0.2": {"value": 0.1, "error": 1e-9, "unit": "g"},
        }
    ),
    "figures/peaks.svg": "<svg/>\n",
}
SUMS = {path: hashlib.sha256(text.encode()).hexdigest() for path, text in FILES.items()}


@pytest.fixture
def tree(tmp_path, plant):
    """Files of a finished run."""
    return plant(tmp_path, FILES)


@pytest.fixture
def told(tree):
    """What is printed for a name."""

    def lines(name, jobs=JOBS):
        return "\n".join(chain(find(name, jobs, LEDGER, tree), jobs, SUMS, tree))

    return lines


def test_chain_of_a_claim_begins_in_the_paper(told):
    text = told("peak_is_low")
    assert text.startswith("claim peak_is_low: The peak is low.\n  paper     p. 3, Eq. (24)\n")
    assert (
        "function  topheavy.bodies.structures.size_ratio  src/topheavy/bodies/structures.py:"
        in text
    )
    assert "verdict   peak_is_low: confirmed (holds)" in text
    assert "data/record.AT2" in text
    assert told("photograph").endswith("photograph: not tested (Not to be computed.)")


def test_claim_of_an_equation_names_its_row_and_the_functions_that_cite_it(claims):
    claim = next(claim for claim in claims if claim.id == "eq25")
    lines = [*chain(Item(None, claims=(claim,)), (), {})]
    places = [
        (line, *line.split()[-1].split(":")) for line in lines if ".yaml:" in line or "cit" in line
    ]
    assert "src/topheavy/bodies/structures.py" in {path for _, path, _ in places}
    for line, path, number in places:
        body = (ROOT / path).read_text(encoding="utf-8").splitlines()[int(number) - 1 :]
        if line.startswith("  ledger  "):
            assert body[0] == "- id: eq25"
        else:
            assert line.startswith("  cited by  ")
            assert body[0].lstrip().startswith("def ")
            assert "(25)" in " ".join(body[:80])


@pytest.mark.parametrize(
    ("name", "begins"),
    [
        ("peaks.height", 'height = {"value": 0.5, "error": 1e-09, "unit": "m"}'),
        ("findings/peaks.json:height", 'height = {"value": 0.5'),
        ("peaks.json:height.error", 'height = {"value": 0.5'),
        ("peaks.pull_0.2", 'pull_0.2 = {"value": 0.1'),
        ("peaks.json:pull_0.2.value", 'pull_0.2 = {"value": 0.1'),
        ("peaks.low", "claim peak_is_low"),
        ("peaks.csv", "results/tables/peaks.csv  sha256 "),
    ],
)
def test_item_is_found_by_its_rule_its_file_or_the_end_of_its_path(told, name, begins):
    text = told(name)
    assert text.startswith(begins)
    assert ("claim" in text) == (name == "peaks.low")  # which it judges
    assert "data/record.AT2" in text


def test_shards_of_a_rule_share_a_line_and_a_block(told):
    shards = [Job("shard", "a:1", STEP.scripts, (), (f"results/{n}.csv",)) for n in range(8)]
    paths = tuple(path for job in shards for path in job.outputs)
    text = told("peaks.csv", [FIGURE, replace(STEP, inputs=paths), *shards])
    assert "  input     results/0.csv and 7 more  from rule shard" in text
    assert text.count("  rule      shard") == 1


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("figures/peak.svg", "did you mean figures/peaks.svg"),
        ("peaks.heights", "did you mean peaks.height"),
        ("peak_is_lo", "did you mean peak_is_low"),
        ("eq9", "did you mean eq9_negative or eq9_positive or eq19[?]"),
        ("zzz", "no output, claim or finding is called 'zzz'; expected"),
        ("data/record.AT2", "data/record.AT2 is made by no rule; it goes into peaks"),
    ],
)
def test_unknown_name_gets_one_message_with_what_is_close(told, name, message):
    with pytest.raises(ValueError, match=message):
        told(name)


def test_end_of_two_paths_names_both(told):
    other = Job("other", "a:1", STEP.scripts, (), ("results/other/peaks.csv",))
    with pytest.raises(ValueError, match=r"results/other/peaks\.csv, results/tables/peaks\.csv"):
        told("peaks.csv", [*JOBS, other])


def test_jobs_are_those_of_the_crate_and_without_a_run_there_are_none(tmp_path, plant):
    run = {"@id": "#run", "@type": "CreateAction", "name": "The run", "result": []}
    job = {"@id": "#job/a", "@type": "CreateAction", "name": "peaks"}
    job |= {"description": "Rule peaks, Snakefile:7", "instrument": {"@id": STEP.scripts[0]}}
    job |= {"object": [{"@id": "data/record.AT2"}], "result": [{"@id": TABLE}, {"@id": FOUND}]}
    graph = [run, job, {"@id": TABLE, "@type": "File", "sha256": "ab"}]
    path = plant(tmp_path, {"crate.json": json.dumps({"@graph": graph})}) / "crate.json"
    assert read_jobs(path) == ([STEP], {TABLE: "ab"})
    with pytest.raises(ValueError, match="is not made yet; expected a finished run"):
        read_jobs(tmp_path / "none.json")
