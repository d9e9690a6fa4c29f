"""What is still to be filled in is listed, and refused in a release."""

import pytest

from replication.pages.blanks import blanks, main


@pytest.fixture
def tree(tmp_path, plant):
    report = {"report.typ": "= One\nauthors: BLANK: your names\n", "report.pdf": b"\0BLANK: \xff"}
    plant(tmp_path / "paper", report)
    return plant(tmp_path, {"README.md": "A blank line.\n"})


def test_mark_is_listed_with_its_place(tree, capsys):
    assert blanks(tree) == ["paper/report.typ:2:BLANK: your names"]
    main(tree)
    assert "1 lines are to be filled in" in capsys.readouterr().err


@pytest.mark.parametrize(("asked", "refused"), [("1", True), ("0", False), ("", False)])
def test_release_refuses_marks(tree, monkeypatch, asked, refused):
    monkeypatch.setenv("RELEASE", asked)
    if refused:
        with pytest.raises(SystemExit, match="RELEASE=1"):
            main(tree)
    else:
        main(tree)
    (tree / "paper" / "report.typ").write_text("= One\n")
    main(tree)
