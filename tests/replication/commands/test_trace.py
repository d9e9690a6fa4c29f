"""The chain from an output, a claim or a finding back to the paper and the inputs."""

import hashlib
import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from replication.commands import trace as trace_command
from replication.commands.trace import Item, chain, find
from replication.judging.claim import Claim
from replication.origin.recorded import Crate
from replication.workflow.provenance import Job

ROOT = Path(__file__).parents[3]
CLAIM = Claim(
    id="peak_is_low",
    where="p. 3, Eq. (24)",
    statement="The peak is low.",
    function="topheavy.structures.size_ratio",
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
STEP = Job(
    "peaks",
    "Snakefile:7",
    made=0.0,
    scripts=("src/steps/peaks.py",),
    inputs=("data/record.AT2",),
    outputs=("results/tables/peaks.csv", "results/findings/peaks.json"),
    findings=("results/findings/peaks.json",),
    params={"case": {"points": 3}},
)
FIGURE = Job(
    "figure",
    made=0.0,
    scripts=("figures/peaks.py",),
    inputs=("results/tables/peaks.csv",),
    outputs=("figures/peaks.svg",),
)
JOBS = [FIGURE, STEP]


@pytest.fixture
def tree(tmp_path, plant):
    """Files of a finished run."""
    files = {
        "src/steps/peaks.py": "from topheavy import RockingFrame\n",
        "figures/peaks.py": "import math\n",
        "data/record.AT2": "0.1\n",
        "results/tables/peaks.csv": "1\n",
        "results/findings/peaks.json": json.dumps(
            {
                "low": {"holds": True},
                "height": {"value": 0.5, "error": 1e-9, "unit": "m"},
                "pull_0.2": {"value": 0.1, "error": 1e-9, "unit": "g"},
            }
        ),
        "figures/peaks.svg": "<svg/>\n",
    }
    return plant(tmp_path, files)


@pytest.fixture
def told(tree):
    """What is printed for a name."""

    def lines(name, jobs=JOBS):
        return "\n".join(chain(find(name, jobs, LEDGER, tree), jobs, tree))

    return lines


def digest(text: str) -> str:
    return f"sha256 {hashlib.sha256(text.encode()).hexdigest()[:16]}"


def test_chain_of_a_figure_goes_back_to_the_inputs_in_order(told):
    text = told("figures/peaks.svg")
    steps = [
        f"figures/peaks.svg  {digest('<svg/>' + chr(10))}",
        "rule      figure",
        "script    figures/peaks.py",
        "input     results/tables/peaks.csv  from rule peaks",
        "rule      peaks, Snakefile:7",
        "script    src/steps/peaks.py",
        "function  topheavy.RockingFrame  src/topheavy/structures.py:",
        'config    case: {"points": 3}',
        "input     data/record.AT2",
    ]
    places = [text.index(step) for step in steps]
    assert places == sorted(places)
    assert "(23)–(25)" in text


def test_chain_of_a_claim_begins_in_the_paper(told):
    text = told("peak_is_low")
    assert text.startswith("claim peak_is_low: The peak is low.\n  paper     p. 3, Eq. (24)\n")
    assert "function  topheavy.structures.size_ratio  src/topheavy/structures.py:" in text
    assert "verdict   peak_is_low: confirmed (holds)" in text
    assert "data/record.AT2" in text


def test_claim_of_an_equation_names_its_row_and_the_functions_that_cite_it(claims):
    claim = next(claim for claim in claims if claim.id == "eq25")
    lines = [*chain(Item(None, claims=(claim,)), ())]
    places = [
        (line, *line.split()[-1].split(":")) for line in lines if ".yaml:" in line or "cit" in line
    ]
    assert "src/topheavy/structures.py" in {path for _, path, _ in places}
    for line, path, number in places:
        body = (ROOT / path).read_text(encoding="utf-8").splitlines()[int(number) - 1 :]
        if line.startswith("  ledger  "):
            assert body[0] == "- id: eq25"
        else:
            assert line.startswith("  cited by  ")
            assert body[0].lstrip().startswith("def ")
            assert "(25)" in " ".join(body[:80])


def test_claim_that_is_not_tested_ends_with_why(told):
    assert told("photograph").endswith("photograph: not tested (Not to be computed.)")


@pytest.mark.parametrize(
    ("name", "begins"),
    [
        ("peaks.height", 'height = {"value": 0.5, "error": 1e-09, "unit": "m"}'),
        ("findings/peaks.json:height", 'height = {"value": 0.5'),
        ("peaks.height.value", 'height = {"value": 0.5'),
        ("peaks.json:height.error", 'height = {"value": 0.5'),
        ("peaks.pull_0.2", 'pull_0.2 = {"value": 0.1'),
        ("peaks.json:pull_0.2.value", 'pull_0.2 = {"value": 0.1'),
        ("peaks.low", "claim peak_is_low"),
        ("peaks.csv", "results/tables/peaks.csv  sha256 "),
        ("tables/peaks.csv", "results/tables/peaks.csv  sha256 "),
    ],
)
def test_item_is_found_by_its_rule_its_file_or_the_end_of_its_path(told, name, begins):
    text = told(name)
    assert text.startswith(begins)
    assert ("claim" in text) == (name == "peaks.low")  # which it judges
    assert "data/record.AT2" in text


def test_input_that_changed_since_the_run_is_marked(told):
    def text_of(record):
        recorded = {"data/record.AT2": hashlib.sha256(record).hexdigest()}
        return told("peaks.csv", [FIGURE, replace(STEP, checksums=recorded)])

    assert "CHANGED" not in text_of(b"0.1\n")
    assert "of all 1 inputs; 1 of them are recorded, and as in the run" in text_of(b"0.1\n")
    text = text_of(b"0.2\n")
    assert f"CHANGED   data/record.AT2  {digest('0.1' + chr(10))}; it was" in text
    assert "of all 1 inputs; 0 of them" in text


def test_checksums_of_many_inputs_take_one_line_and_their_sum_tells_of_each(told, tree):
    inputs = tuple(f"src/steps/part_{n}.py" for n in range(20))
    for path in inputs:
        (tree / path).write_text("")
    jobs = [FIGURE, replace(STEP, inputs=inputs)]
    lines = told("peaks.csv", jobs).splitlines()
    assert sum("sha256" in line for line in lines) == len(STEP.outputs) + 1
    (tree / inputs[7]).write_text("1\n")
    assert told("peaks.csv", jobs).splitlines()[-1] != lines[-1]


def test_missing_input_is_named(told, tree):
    (tree / "data/record.AT2").unlink()
    assert "  MISSING   data/record.AT2" in told("peaks.csv")


def test_modules_beside_the_script_come_before_inputs_and_those_of_the_library_do_not(
    told, tree, plant
):
    modules = ("src/steps/beside.py", "src/topheavy/pulses.py", "src/replication/workbench.py")
    plant(tree, dict.fromkeys(modules, "from topheavy import Pulse\n"))
    inputs = (*modules, "data/record.AT2")
    text = told("peaks.csv", [FIGURE, replace(STEP, inputs=inputs)])
    kinds = [line.split()[0] for line in text.splitlines() if line.startswith("  ")]
    assert " ".join(kinds) == "rule script module function function config input sha256"
    assert "  function  topheavy.Pulse" in text


def test_shards_of_a_rule_share_a_line_and_a_block(told, tree):
    shards = [
        Job("shard", made=0.0, scripts=("src/steps/peaks.py",), outputs=(f"results/{n}.csv",))
        for n in range(8)
    ]
    paths = tuple(path for job in shards for path in job.outputs)
    text = told("peaks.csv", [FIGURE, replace(STEP, inputs=paths), *shards])
    assert "  input     results/0.csv and 7 more  from rule shard" in text
    assert text.count("  rule      shard") == 1
    stale = [*shards[:5], replace(shards[5], pending=True), *shards[6:]]
    text = told("peaks.csv", [FIGURE, replace(STEP, inputs=paths), *stale])
    assert text.count("  rule      shard") == 2
    assert "OUT OF DATE" in text


def test_crate_has_the_checksums_where_snakemake_has_no_record(tree):
    archived = [FIGURE, replace(STEP, made=None)]
    for text, changed in (("0.1\n", False), ("0.2\n", True)):
        sums = {"data/record.AT2": hashlib.sha256(text.encode()).hexdigest()}
        crate = Crate(sums, {"results/tables/peaks.csv": "peaks"}, (), "")
        item = find("peaks.csv", archived, (), tree)
        told = "\n".join(chain(item, archived, tree, crate))
        assert "made in the run that results/ro-crate-metadata.json lists" in told
        assert ("CHANGED   data" in told) == changed


def test_what_snakemake_would_run_again_is_out_of_date(told):
    assert "up to date" in told("peaks.csv")
    assert "OUT OF DATE" in told("peaks.csv", [FIGURE, replace(STEP, pending=True)])
    assert "not made yet" in told("peaks.csv", [FIGURE, replace(STEP, made=None)])


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
    other = Job("other", outputs=("results/other/peaks.csv",))
    with pytest.raises(ValueError, match=r"results/other/peaks\.csv, results/tables/peaks\.csv"):
        told("peaks.csv", [*JOBS, other])


def test_job_is_found_by_its_findings_and_not_by_the_name_of_its_rule(told):
    jobs = [FIGURE, replace(STEP, rule="engine")]
    assert "verdict   peak_is_low: confirmed" in told("peak_is_low", jobs)
    assert told("peaks.low", jobs).startswith("claim peak_is_low")


def test_every_output_claim_and_finding_is_traced_before_and_after_a_run(
    tmp_path, monkeypatch, jobs, claims
):
    ignored = shutil.ignore_patterns("*.svg", "*.nb?")
    for name in ("src", "studies", "figures"):
        shutil.copytree(ROOT / name, tmp_path / name, ignore=ignored)
    monkeypatch.chdir(tmp_path)
    lines_of, once = trace_command._job_lines, {}

    def kept(job, *given):
        if id(job) not in once:
            once[id(job)] = [*lines_of(job, *given)]
        return once[id(job)]

    monkeypatch.setattr(trace_command, "_job_lines", kept)  # of a job, the same in each chain

    def trace(name):
        return "\n".join(chain(find(name, jobs, claims), jobs))

    for path in (path for job in jobs for path in job.outputs):
        lines = trace(path)
        assert f"{path}  not there\n" in lines
        assert "\n  rule  " in lines
    for claim in claims:
        lines = trace(claim.id)
        assert lines.startswith(f"claim {claim.id}: ")
        assert ("\n  rule  " if claim.finding else f": {claim.expected} (") in lines
    judged = [claim for claim in claims if claim.finding]
    truth, number = {"holds": True}, {"value": 1.0, "error": 0.0}
    for path in (Path(path) for job in jobs for path in job.findings):
        own = (claim for claim in judged if claim.rule == path.stem)
        found = {claim.finding: truth if claim.tolerance is None else number for claim in own}
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(found), encoding="utf-8")
    once.clear()  # which of a run are others
    for claim in judged:
        for name in (claim.id, f"{claim.rule}.{claim.finding}"):
            lines = trace(name)
            assert f"  verdict   {claim.id}: " in lines
            assert f"/{claim.rule}.json  sha256" in lines


def test_finding_of_a_run_still_to_come_says_so(told, tree):
    shutil.rmtree(tree / "results")
    with pytest.raises(ValueError, match="is not made yet; expected a finished run"):
        told("peaks.height")
    assert "results/tables/peaks.csv  not there" in told("peaks.csv")
