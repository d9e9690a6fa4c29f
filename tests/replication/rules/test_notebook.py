"""The notebooks in git are stripped and use the library; executed ones are the same bytes."""

import ast
from contextlib import nullcontext
from pathlib import Path

import nbformat
import pytest

from replication.rules import notebook as step

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
