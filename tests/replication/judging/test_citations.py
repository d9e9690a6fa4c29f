"""The trail of equations between the ledger and the code, in both directions."""

import re
from pathlib import Path

from replication.judging.citations import cite, equations_in, library_names

ROOT = Path(__file__).parents[3]
CODE = sorted((ROOT / "src" / "topheavy").rglob("*.py"))
NUMBERED = re.compile(r"\b[Ee]q(?:s|n|ns|uations?)?\b\.?\s*\(?\d+\)?")


def test_every_equation_cited_in_the_code_is_a_row_of_the_ledger(claims):
    rows = {claim.equation for claim in claims if claim.equation}
    cited = {
        f"{path.relative_to(ROOT)}: Eq. ({number})"
        for path in CODE
        for number in equations_in(path.read_text(encoding="utf-8")) - rows
    }
    assert cited == set()


def test_the_code_cites_in_one_way():
    others = [
        f"{path.relative_to(ROOT)}: {found}"
        for path in CODE
        for found in NUMBERED.findall(path.read_text(encoding="utf-8"))
        if not re.fullmatch(r"Eqs?\.\s+\(\d+\)", found)
    ]
    assert others == []


def test_every_equation_of_the_ledger_is_cited_by_the_code_that_it_names(claims):
    missing = [
        f"{claim.id}: {claim.function} does not cite Eq. ({claim.equation})"
        for claim in claims
        if claim.equation and claim.equation not in cite(claim.function, ROOT).own
    ]
    assert missing == []


def test_what_is_said_to_compute_a_claim_exists(claims):
    functions = {claim.function for claim in claims if claim.function}
    assert len(functions) > 20
    for path in functions:
        file, line = cite(path, ROOT).place.split(":")
        assert (ROOT / file).is_file(), path
        assert int(line) > 0


def test_script_takes_functions_and_classes_from_the_library(tmp_path):
    script = tmp_path / "step.py"
    script.write_text(
        "import math\nfrom topheavy import Column, simulate\n"
        "from replication.judging.verdicts import VERDICTS\n"
    )
    assert library_names(script) == ["topheavy.Column", "topheavy.simulate"]
