"""The HTML report opens on the README's picture and on what was found."""

import shutil

from replication.judging.ledger import read_judged
from replication.pages import opening

ROOT = next(up for up in opening.Path(__file__).resolve().parents if (up / "Snakefile").is_file())


def test_report_opens_on_verdicts_and_on_the_claims_that_need_a_condition(tmp_path):
    published = ROOT / "tests" / "reference" / "claims.json"
    rows = read_judged(published)
    (tmp_path / "results").mkdir()
    shutil.copy(published, tmp_path / "results")
    (tmp_path / "CITATION.cff").write_text("title: A|B\nabstract: What it is.\n", encoding="utf-8")
    (tmp_path / "a.png").write_bytes(b"abc")
    shown = "![Build](https://a.b/c.svg)\n![A wave](a.png)\n"
    (tmp_path / "README.md").write_text(shown, encoding="utf-8")
    found = opening.opening(tmp_path)
    title, verdicts, *told = found
    assert title == r"\ A\|B"
    assert "What it is." in found[title][0]
    picture = [".. image:: data:image/png;base64,", "YWJj", f":alt: {opening.escaped('A wave')}"]
    assert found[title][1:] == ["\n     ".join(picture)]
    assert len(found[verdicts]) == len({row.study for row in rows})
    assert sum(map(len, map(found.get, told))) == sum(row.verdict in opening.TITLES for row in rows)
