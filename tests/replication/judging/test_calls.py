"""What a step calls of the library, and the equations that it cites."""

import re
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

from replication.judging.calls import library, noted
from replication.judging.citations import cite, equations_in, library_names
from replication.workbench import run, truth

SOURCE = """
import functools
from dataclasses import dataclass


def plain(first, /, second=2, *rest, third=3, **more):
    return first, second, rest, third, more


def never():
    pass


def outer():
    return plain(1)


def findings():
    return plain(1)

def _hidden():
    return 0


@functools.cache
def cached():
    return 1


@dataclass(frozen=True)
class Thing:
    size: float = 1.0
    rule: object = plain

    @property
    def double(self):
        return 2 * self.size

    @classmethod
    def made(cls):
        return cls(3.0)

    def method(self):
        return self.size
"""


@pytest.fixture
def module():
    found = ModuleType("things")
    exec(SOURCE, vars(found))
    for member in vars(found).values():
        if getattr(member, "__module__", None) == "builtins" and callable(member):
            member.__module__ = "things"
    return found


def calls(module, act) -> set[str]:
    with noted([("a.things", module)]) as called:
        act(module)
    return called


@pytest.mark.parametrize(
    ("act", "names"),
    [
        (lambda m: None, set()),
        (lambda m: m.plain(1), {"plain"}),
        (lambda m: m.outer(), {"outer", "plain"}),
        (lambda m: m.findings(), {"plain"}),
        (lambda m: m._hidden(), set()),
        (lambda m: m.cached(), {"cached"}),
        (lambda m: m.Thing(), {"Thing"}),
        (lambda m: m.Thing().double, {"Thing", "Thing.double"}),
        (lambda m: m.Thing.made(), {"Thing", "Thing.made"}),
        (lambda m: m.Thing().method(), {"Thing", "Thing.method"}),
        (lambda m: m.Thing().rule(1), {"Thing", "plain"}),
    ],
)
def test_what_is_called_is_noted_and_nothing_else(module, act, names):
    assert calls(module, act) == {f"a.things.{name}" for name in names}


def test_arguments_arrive_and_functions_are_as_before_afterwards(module):
    code, keywords = module.plain.__code__, module.plain.__kwdefaults__
    before = module.plain  # a reference of earlier is noted, too
    assert calls(module, lambda m: before(1)) == {"a.things.plain"}
    with noted([("a.things", module)]):
        assert module.plain.__code__ is not code
        assert module.plain(1, 5, 6, third=7, x=8) == (1, 5, (6,), 7, {"x": 8})
        assert module.plain.__code__ is code  # the second call costs nothing
        assert module.plain(1) == (1, 2, (), 3, {})
    assert module.never.__code__.co_name == "never"
    assert module.never.__kwdefaults__ is None
    assert module.plain.__kwdefaults__ == keywords
    with pytest.raises(ZeroDivisionError), noted([("a.things", module)]):
        raise ZeroDivisionError
    assert module.plain.__code__ is code


def test_library_yields_what_a_rule_declares_and_no_step():
    declared = ["src/topheavy/bodies/structures.py", "src/steps/heavier.py", "config/config.yaml"]
    assert {name for name, _ in library(declared)} == {"topheavy.bodies.structures"}


def job(folder, outputs) -> SimpleNamespace:
    return SimpleNamespace(
        log=[str(folder / "log")],
        input=["src/topheavy/bodies/structures.py"],
        output=[str(folder / name) for name in outputs],
        rule="rule",
    )


def test_finding_with_the_reserved_name_is_refused(tmp_path):
    with pytest.raises(ValueError, match="a finding is called 'called'"):
        run(job(tmp_path, ["f.json"]), lambda job: {"called": truth(True)})


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
