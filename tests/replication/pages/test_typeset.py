"""The files that the report reads are found, and one that is not declared stops the compiler."""

import pytest

from replication.pages.typeset import compiled, figure_numbers, reads, refuse_unshown


@pytest.fixture
def tree(tmp_path, plant, monkeypatch):
    files = {
        "paper/report.typ": '#import "format.typ": *\n#include "/studies/one/section.typ"\n'
        '#let mass = found("mass_ratio")\n#table-of("heavier").len()\n#mass.a\n'
        "#for name in sys.inputs.keys() [#name]\n",
        "paper/format.typ": '#let found(rule) = json("/results/findings/" + rule + ".json")\n'
        '#let table-of(name) = csv("/results/tables/" + name + ".csv")\n',
        "studies/one/section.typ": '#let asked = yaml("config.yaml")\nOne: #asked.n\n',
        "studies/one/config.yaml": "n: 1\n",
        "results/findings/mass_ratio.json": '{"a": 1}\n',
        "results/tables/heavier.csv": "x\n1\n",
        "results/tables/other.csv": "x\n1\n",
    }
    monkeypatch.chdir(plant(tmp_path, files))
    return tmp_path


def test_sources_data_tables_and_findings_are_found(tree):
    assert reads("paper/report.typ") == [
        "paper/format.typ",
        "paper/report.typ",
        "results/findings/mass_ratio.json",
        "results/tables/heavier.csv",
        "studies/one/config.yaml",
        "studies/one/section.typ",
    ]


@pytest.mark.parametrize("missing", ["results/tables/heavier.csv", "studies/one/config.yaml"])
def test_file_that_is_read_and_not_declared_stops_the_compiler(tree, missing):
    declared = reads("paper/report.typ")
    assert compiled("paper/report.typ", declared, {}).startswith(b"%PDF")
    declared.remove(missing)
    with pytest.raises(ValueError, match="not found"):
        compiled("paper/report.typ", declared, {})


def test_figure_that_no_document_shows_is_refused(tree):
    figures = ["figures/vase", "figures/size", "studies/one/figures/size"]
    report, section = tree / "paper/report.typ", tree / "studies/one/section.typ"
    report.write_text('#found("size")\n#picture(\n("vase", "tower"), called: "both", [Vase.])\n')
    section.write_text('#picture("size", wide: false, [Size.])\n#picture("vase", [Vase again.])\n')
    sources = ["paper/report.typ", "studies/one/section.typ"]
    refuse_unshown(figures, [*sources, "results/claims.json"])
    section.write_text("none\n")
    with pytest.raises(ValueError, match="no document shows") as error:
        refuse_unshown(figures, sources)
    said = str(error.value).splitlines()
    assert [line.split(".py")[0] for line in said] == figures[1:]


def test_fault_of_a_source_has_its_file_and_line(tree):
    (tree / "studies/one/section.typ").write_text("One.\n\n#none.a\n")
    with pytest.raises(ValueError, match=r"(?s)fields on type none.* studies/one/section\.typ:3:"):
        compiled("paper/report.typ", reads("paper/report.typ"), {})


def test_figures_of_article_and_supplement_are_numbered_by_picture(tree, plant):
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>'
    plant(tree, dict.fromkeys(("a.svg", "b.svg", "c.svg"), svg))
    shown = '#figure(image("/{}.svg"), caption: [])\n#figure(table([1]), caption: [])\n'
    for name, pictures in (("report", "bc"), ("supplement", "a")):
        plant(tree, {f"paper/{name}.typ": "".join(map(shown.format, pictures))})
    assert figure_numbers({}) == {"b.svg": "1", "c.svg": "2", "a.svg": "S1"}
