"""What the machine's rules run: comparison, verdicts and notebooks."""

import ast
import json
import math
from contextlib import nullcontext
from dataclasses import replace
from pathlib import Path

import nbformat
import pandas as pd
import pytest

from replication.judging.claim import Claim, JudgedClaim
from replication.judging.ledger import with_verdict
from replication.rules import compare
from replication.rules import notebook as step
from replication.rules.compare import departures
from replication.rules.verdict import main
from replication.workbench import truth

TABLE = pd.DataFrame(
    {
        "mass_ratio": [0.0, 1.0, math.inf],
        "peak": [0.1, 0.2, math.nan],
        "impacts": [0, 2, 1],
        "holds": [False, False, True],
        "name": ["a", "b", "c"],
    }
)
BOUNDS = {"relative": 1e-6, "absolute": 1e-9}
LOOSE = {"relative": 0.02, "absolute": 0.01, "counts": 1}


def changed(column: str, row: int, value) -> pd.DataFrame:
    table = TABLE.astype({column: object}) if isinstance(value, str) else TABLE.copy()
    table.loc[row, column] = value
    return table


@pytest.mark.parametrize("sign", [1, -1])
def test_difference_is_relative_with_an_absolute_floor(sign):
    def departs(value, **bounds):
        return [*departures(changed("peak", 1, value), TABLE, bounds)]

    assert departs(0.2 + sign * 1e-3, relative=4.9e-3, absolute=0.0) == ["peak"]
    assert departs(0.2 + sign * 1e-3, relative=5.1e-3, absolute=0.0) == []
    assert departs(0.2 + sign * 1e-3, relative=0.0, absolute=1.1e-3) == []
    assert departs(0.2 + sign * 1e-3, relative=0.0, absolute=0.9e-3) == ["peak"]


@pytest.mark.parametrize(("value", "departs"), [(3, []), (4, ["impacts"])])
def test_counts_of_samples_may_differ_by_a_few(value, departs):
    assert list(departures(changed("impacts", 1, value), TABLE, LOOSE)) == departs
    assert list(departures(changed("impacts", 1, value), TABLE, BOUNDS)) == ["impacts"]


@pytest.mark.parametrize(
    ("column", "row", "value"),
    [
        ("peak", 2, 0.3),  # a number where there was none
        ("peak", 0, math.nan),
        ("peak", 0, math.inf),
        ("mass_ratio", 2, 5.0),
        ("mass_ratio", 2, -math.inf),
        ("holds", 0, True),
        ("name", 1, "x"),
        ("peak", 1, "much"),
    ],
)
def test_what_has_no_distance_departs(column, row, value):
    assert list(departures(changed(column, row, value), TABLE, LOOSE)) == [column]


@pytest.mark.parametrize(
    ("other", "departs"),
    [
        (TABLE.iloc[:2], list(TABLE)),
        (TABLE.drop(columns="name"), ["name (only published)"]),
        (TABLE.assign(top=1), ["top (only here)"]),
    ],
)
def test_tables_of_another_form_depart(other, departs):
    assert list(departures(other, TABLE, LOOSE)) == departs


@pytest.fixture
def run(plant, tmp_path, monkeypatch):
    """A run of two jobs of which the second reads the first, and what is published of both."""
    monkeypatch.chdir(tmp_path)
    found = json.dumps({"lowest": {"value": 0.3, "error": 0.0, "of": [1, 2]}, "called": []})
    files = {"tables/one": TABLE.to_csv(index=False), "tables/two": TABLE.to_csv(index=False)}
    files = {f"{name}.csv": text for name, text in files.items()} | {"findings/two.json": found}
    plant(tmp_path, {f"results/{name}": text for name, text in files.items()})
    there = {
        "results/tables/one.csv": "tests/reference/one.csv",
        "results/tables/two.csv": "tests/reference/studies/two.csv",
        "results/findings/two.json": "tests/reference/findings/two.json",
    }
    plant(tmp_path, {there[f"results/{name}"]: text for name, text in files.items()})
    jobs = {"one": "a", "two": "b"}
    origins = {path: jobs if "two" in path else {"one": "a"} for path in there}
    return lambda published, bounds=BOUNDS | {"sampled": LOOSE}: [
        (row["verdict"], row["departs"]) for row in compare.main(there, origins, published, bounds)
    ]


AGREES = ("agrees", "")


def test_only_what_depends_on_a_change_is_not_compared(run):
    assert run({"one": "a", "two": "b"}) == run(None) == [AGREES] * 3
    two = ("not compared: parameters or inputs differ of two", "")
    assert run({"one": "a", "two": "c"}) == run({"one": "a"}) == [AGREES, two, two]
    assert [verdict[-6:] for verdict, _ in run({"one": "c", "two": "b"})] == ["of one"] * 3


def test_a_main_table_has_the_strict_bounds_and_the_rest_those_of_samples(run):
    for name in ("one", "two"):
        changed("peak", 1, 0.201).to_csv(f"results/tables/{name}.csv", index=False)
    assert run(None) == [("differs", "peak"), AGREES, AGREES]
    changed("peak", 1, 0.301).to_csv("results/tables/two.csv", index=False)
    assert run(None)[1:] == [("differs", "peak"), AGREES]
    assert run(None, BOUNDS)[1:] == [("differs", "peak"), AGREES]


@pytest.mark.parametrize(("error", "departs"), [("0.0149", ""), ("0.03", "lowest.error")])
def test_error_is_compared_by_its_two_published_digits(run, tmp_path, error, departs):
    here, there = (tmp_path / f"{top}/findings/two.json" for top in ("results", "tests/reference"))
    there.write_text(there.read_text().replace("0.0", "0.015"))
    here.write_text(here.read_text().replace("0.0", error))
    assert run(None)[2][1] == run(None, BOUNDS)[2][1] == departs


def test_job_that_tested_nothing_is_not_compared(run, tmp_path):
    (tmp_path / "results/findings/two.json").write_text('{"not_tested": "no engine"}')
    assert run(None) == [AGREES, *[("not compared: no engine", "")] * 2]


UNTESTED = with_verdict(Claim(id="", where="p. 1", statement="", expected="not tested"), {})


def claim(name: str, verdict: str, expected: str, not_tested: str = "") -> JudgedClaim:
    return replace(UNTESTED, id=name, verdict=verdict, expected=expected, not_tested=not_tested)


def compared(**verdicts: str) -> pd.DataFrame:
    return pd.DataFrame(
        {
            "result": [f"results/tables/{name}.csv" for name in verdicts],
            "published": [f"tests/reference/{name}.csv" for name in verdicts],
            "verdict": list(verdicts.values()),
            "departs": ["peak" if verdict == "differs" else "" for verdict in verdicts.values()],
        }
    )


AS_EXPECTED = [
    claim("eq_1", "confirmed", "confirmed"),
    claim("eq_9", "misprint", "misprint"),
    replace(claim("ours", "refuted", "refuted"), study="pendulums"),
    claim("photograph", "not tested", "not tested"),
]


def test_every_claim_that_came_out_otherwise_is_a_fault_either_way():
    worse, better = claim("a", "refuted", "confirmed"), claim("b", "qualified", "refuted")
    number = replace(worse, id="c", printed=1.25, computed=1.5, unit="s")
    untested = claim("d", "not tested", "confirmed")  # for no reason
    line, faults = main([*AS_EXPECTED, worse, better, number, untested], compared(), {})
    assert faults == [
        "claim a is refuted; expected confirmed",
        "claim b is qualified; expected refuted",
        "claim c is refuted; expected confirmed (printed 1.25, computed 1.5 s)",
        "claim d is not tested; expected confirmed",
    ]
    assert line.startswith("paper: 1 confirmed, 1 qualified, 0 slips, 1 misprint, 2 refuted, ")


def test_claim_of_a_study_that_came_out_otherwise_is_a_fault():
    other = replace(claim("a", "refuted", "confirmed"), study="own")
    assert main([other], compared(), {})[1] == ["claim a is refuted; expected confirmed"]


def test_claim_that_lacks_an_optional_package_is_told_and_is_no_fault():
    lacking = [claim(name, "not tested", "confirmed", "no engine") for name in ("a", "b")]
    line, faults = main([*AS_EXPECTED, *lacking], compared(peaks="agrees"), {})
    assert faults == []
    told, paper, _ = line.splitlines()
    assert told == "2 claims not tested here: no engine"
    assert paper.endswith("3 not tested")


def test_only_a_table_that_differs_is_a_fault():
    tables = compared(first="agrees", second="differs", third="not compared: other config")
    lines, (fault,) = main(AS_EXPECTED, tables, {})
    assert "results/tables/second.csv differs from tests/reference/second.csv in peak" in fault
    assert lines.startswith("1 of 3 published results not compared: other config: tables/third.csv")


def test_check_of_ours_that_fails_is_a_fault_with_its_evidence():
    checks = {"routes.agree": truth(True), "routes.same": truth(False, worst=0.25)}
    _, faults = main(AS_EXPECTED, compared(), checks)
    assert faults == ["our own check routes.same does not hold: worst = 0.25"]


@pytest.fixture
def written(tmp_path):
    """Write a notebook of one cell, and return its path."""

    def write(code):
        cell = nbformat.v4.new_code_cell(code, id="small-01")
        nbformat.write(nbformat.v4.new_notebook(cells=[cell]), tmp_path / "small.ipynb")
        return tmp_path / "small.ipynb"

    return write


def test_executed_notebook_is_the_same_bytes_each_time(tmp_path, written):
    source = written("import time\nprint(6)\ntime.sleep(0.5)\nprint(7)")
    before = source.read_bytes()
    made = []
    for turn in ("first", "second"):
        executed, page = tmp_path / f"{turn}.ipynb", tmp_path / f"{turn}.html"
        step.main(source, executed, page)
        made.append((executed.read_bytes(), page.read_bytes()))
    assert made[0] == made[1]
    (output,) = nbformat.read(tmp_path / "first.ipynb", as_version=4).cells[0].outputs
    assert output.text == "6\n7\n"  # though the kernel sends them apart
    assert b"6\n7\n" in made[0][1]
    assert source.read_bytes() == before


def page_of(*cells):
    """The page of an executed notebook."""
    return step.render(nbformat.v4.new_notebook(cells=list(cells)), "small")


@pytest.mark.parametrize(
    ("latex", "expected"),
    [
        (r"\ddot{\theta} = \frac{3}{2}", "<mfrac><mrow><mn>3</mn>"),
        (r"\left[\begin{matrix}R\end{matrix}\right]", "<mtable><mtr><mtd><mi>R</mi>"),
    ],
)
def test_formula_of_an_output_is_mathml(latex, expected):
    data = {"text/latex": rf"$\displaystyle {latex}$", "text/plain": "x"}
    output = nbformat.v4.new_output("display_data", data=data)
    page = page_of(nbformat.v4.new_code_cell("x", id="small-01", outputs=[output]))
    assert expected in page
    assert "$" not in page.partition("<main>")[2]


def test_formulas_in_the_text_are_mathml_and_dollars_in_code_are_kept():
    text = "The mass $m_b$ and\n\n$$R = 1$$\n\nbut `$HOME`."
    page = page_of(nbformat.v4.new_markdown_cell(text, id="small-01")).partition("<main>")[2]
    assert "<msub><mi>m</mi><mi>b</mi></msub>" in page
    assert 'display="block"' in page
    assert "<code>$HOME</code>" in page
    assert page.count("$") == 1


def test_notebook_that_fails_stops_the_run(tmp_path, written):
    with pytest.raises(Exception, match="ZeroDivisionError"):
        step.main(written("1 / 0"), tmp_path / "executed.ipynb", tmp_path / "page.html")
    assert not (tmp_path / "executed.ipynb").exists()


@pytest.mark.parametrize(("metadata", "told"), [({}, False), ({"image/png": {"alt": "A"}}, True)])
def test_picture_without_an_alternative_text_is_refused(metadata, told):
    output = {"output_type": "display_data", "data": {"image/png": ""}, "metadata": metadata}
    cell = {"id": "play-06", "outputs": [output]}
    refusal = pytest.raises(ValueError, match=r"play\.ipynb: cell play-06 shows a picture without")
    with nullcontext() if told else refusal:
        step.refuse_undescribed(cell, Path("play.ipynb"))


NOTEBOOKS = sorted((Path(__file__).parents[3] / "notebooks").glob("*.ipynb"))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_is_stripped_and_numbered_and_uses_the_library(path):
    nbformat.validate(notebook := nbformat.read(path, as_version=nbformat.NO_CONVERT))
    cells = notebook.cells
    assert cells[0].cell_type == "markdown"
    assert [cell.id for cell in cells] == [f"{path.stem}-{n:02}" for n in range(1, len(cells) + 1)]
    for cell in cells:
        assert (cell.metadata, cell.get("outputs", [])) == ({}, [])
        assert cell.get("execution_count") is None
    # a version of Python would change with whoever opened it last
    assert "version" not in notebook.metadata.get("language_info", {})
    code = [ast.parse(cell.source) for cell in cells if "outputs" in cell]  # no magics, no shell
    nodes = [node for tree in code for node in ast.walk(tree)]
    definitions = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef, ast.Lambda)
    assert not [ast.unparse(node) for node in nodes if isinstance(node, definitions)]
    imported = {node.module for node in nodes if isinstance(node, ast.ImportFrom)}
    assert any(module.split(".")[0] == "topheavy" for module in imported)
