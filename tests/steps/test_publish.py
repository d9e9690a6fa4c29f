"""The published table of verdicts."""

import re

import pytest
from publish import main, verdict_table

ROW = {
    "id": "trilith_size",
    "where": "p. 3",
    "statement": "the size of the column",
    "printed": 0.415,
    "computed": 0.4148493702538308,
    "unit": "m",
    "verdict": "confirmed",
    "remark": "",
}


def cells(**changes) -> list[str]:
    """The cells of the row that a claim becomes."""
    last = verdict_table([ROW | changes]).splitlines()[-1]
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", last)[1:-1]]


def test_claim_becomes_a_row_under_the_heads_of_its_columns():
    lines = verdict_table([ROW]).splitlines()
    heads = [cell.strip() for cell in lines[-3].split("|")[1:-1]]
    shown = dict(zip(heads, cells(), strict=True))
    assert shown["claim"] == "`trilith_size`"
    assert shown["printed"] == "0.415 m"
    assert shown["computed"] == "0.414849 m"
    assert shown["verdict"] == "confirmed"
    assert shown["remark"] == ""
    assert set(lines[-2]) == {"|", "-"}


def test_every_claim_has_its_row_in_order():
    lines = verdict_table([ROW | {"id": name} for name in ("b", "a", "c")]).splitlines()
    assert [line.split("`")[1] for line in lines[-3:]] == ["b", "a", "c"]


@pytest.mark.parametrize(
    ("computed", "unit", "shown"),
    [
        (True, "", "holds"),
        (False, "", "does not hold"),
        (None, "", ""),
        (None, "m", ""),
        (1.5, "", "1.5"),
        (3, "g", "3 g"),
        (0, "", "0"),
        ("more", "", "more"),
    ],
)
def test_value_is_shown_as_what_it_is(computed, unit, shown):
    assert cells(computed=computed, unit=unit)[4] == shown


@pytest.mark.parametrize("column", ["statement", "remark", "where"])
def test_bar_in_the_text_does_not_end_the_cell(column):
    assert len(cells(**{column: "max|θ| grows"})) == 7
    assert r"max\|θ\| grows" in cells(**{column: "max|θ| grows"})


def test_table_ends_with_one_newline():
    assert verdict_table([ROW]).endswith("|\n")
    assert not verdict_table([ROW]).endswith("\n\n")


def test_number_without_a_unit_leaves_no_gap():
    assert "| 0.415 | 0.414849 |" in verdict_table([ROW | {"unit": ""}])


def test_results_of_another_config_are_not_published(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for folder, points in (("results", 3), ("config", 11)):
        (tmp_path / folder).mkdir()
        text = f"spectra: {{points: {points}}}\nsolver: {{tightened: 1.0e-12}}\n"
        (tmp_path / folder / "config.yaml").write_text(text, encoding="utf-8")
    (tmp_path / "results" / "claims.json").write_text("[]", encoding="utf-8")
    with pytest.raises(SystemExit, match="another config, which differs in spectra; expected"):
        main()
    assert not (tmp_path / "docs").exists()
