"""What is still to be filled in is listed, and refused in a release."""

import pytest

from replication.pages.blanks import main


@pytest.fixture
def tree(tmp_path, plant):
    report = {"report.typ": "= One\nauthors: BLANK: your names\n", "report.pdf": b"\0BLANK: \xff"}
    plant(tmp_path / "paper", report)
    return plant(tmp_path, {"README.md": "A blank line.\n"})


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
