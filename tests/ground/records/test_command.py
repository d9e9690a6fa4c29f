"""`python -m topheavy.ground.records FILE`: what it prints, and how it fails."""

from pathlib import Path

import pytest

from tests.cases import RECORDS
from topheavy.ground.records.__main__ import main

HEADER = "Río, a day\nACCELERATION IN CM/SEC/SEC\n  4 20 MSEC NPTS, DT\n"


@pytest.fixture
def file(tmp_path) -> Path:
    path = tmp_path / "motion.AT2"
    path.write_text(f"{HEADER}0.0 98.1 -196.2 0.0\n", encoding="utf-8")
    return path


def test_record_in_g_is_not_converted(capsys):
    assert main([str(RECORDS / "el_centro_1940_NS.AT2")]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "units     g (line 3: The units are (g))"
    assert lines[4] == "PGA       0.3188 g"


@pytest.mark.parametrize("name", ["nowhere.AT2", "motion.txt", ".", "bad.csv"])
def test_file_that_is_refused_is_told_in_one_line(tmp_path, capsys, name):
    (tmp_path / "bad.csv").write_bytes(b"\xff\xfe\n")
    assert main([str(tmp_path / name)]) == 1
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("error: ")
    assert printed.err.count("\n") == 1
    assert str(tmp_path) in printed.err


def test_several_files_are_a_table(file, tmp_path, capsys):
    second = tmp_path / "b.csv"
    second.write_text("t (s);N (g);E (g)\n0;.1;.2\n1;.1;.3\n", encoding="utf-8")
    assert main([str(file), str(second), "--column", "E"]) == 1  # AT2 has no columns
    assert "which alone has columns" in capsys.readouterr().err
    second.write_text("t (s);N (g)\n0;.1\n1;.1\n", encoding="utf-8")
    assert main([str(file), str(second)]) == 0
    head, *rows = capsys.readouterr().out.splitlines()
    assert head.split("  ")[0] == "file"
    assert [row.split()[0] for row in rows] == ["motion.AT2", "b.csv"]
    assert rows[1].split()[-2:] == ["0.1", "0.981"]
