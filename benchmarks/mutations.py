"""Draw small changes of the code by a seed, and print which of them the tests catch.

python benchmarks/mutations.py src/steps/vase.py --seed 7 --count 40 --tests tests/steps

Each is another comparison, operator, sign, number or truth in the syntax tree of a file at HEAD.
One that survives shows a gap of the tests, or changes no result: read it. `not collected` is one
that stops an import.
"""

import argparse
import ast
import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from tests.faults.run import ROOT, Entry, report

OTHER = {"Lt": "LtE", "LtE": "Gt", "Gt": "GtE", "GtE": "Lt", "Eq": "NotEq", "NotEq": "Eq"}
OTHER |= {"In": "NotIn", "NotIn": "In", "Is": "IsNot", "IsNot": "Is", "And": "Or", "Or": "And"}
OTHER |= {"Add": "Sub", "Sub": "Add", "Mult": "Div", "Div": "Mult"}
NO_RESULT = (ast.Raise, ast.JoinedStr, ast.Import, ast.ImportFrom)
"""Messages and imports are not changed; nor are annotations."""


def main() -> int:
    """Print each mutation with its outcome; return how many survive."""
    parser = argparse.ArgumentParser()
    parser.add_argument("paths", nargs="+", help="files and folders of Python")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=40)
    parser.add_argument("--tests", nargs="+", default=["tests"])
    parser.add_argument("-j", type=int, default=1, dest="jobs", help="how many at a time")
    options = parser.parse_args()
    entries = mutations(options.paths, options.seed, options.count, options.tests)
    return report(entries, options.jobs, limit=600.0)


def mutations(paths: list[str], seed: int, count: int, tests: list[str]) -> list[Entry]:
    """Return mutations of the files below the paths at HEAD, in the order of their places."""
    files = [file for file in git("ls-files", "--", *paths).split() if file.endswith(".py")]
    texts = {file: git("show", f"HEAD:{file}") for file in files}
    sites = [(file, k) for file in files for k, _ in enumerate(changes(ast.parse(texts[file])))]
    chosen = sorted(random.Random(seed).sample(sites, min(count, len(sites))))
    return [mutated(file, texts[file], k) | {"tests": tests} for file, k in chosen]


def mutated(file: str, text: str, number: int) -> Entry:
    """Return one mutation of a file, which it replaces as a whole."""
    tree = ast.parse(text)
    node, change = changes(tree)[number]
    before = ast.unparse(node)
    change()
    name = f"{file}:{node.lineno}: {before} -> {ast.unparse(node)}"
    return {"name": name, "file": file, "old": text, "new": ast.unparse(tree) + "\n"}


def changes(tree: ast.AST) -> list[tuple[ast.AST, Callable[[], None]]]:
    """Return every part of a tree that can be changed, with its change."""
    sites: list[tuple[ast.AST, Callable[[], None]]] = []
    for node in within(tree):
        match node:
            case ast.Compare():
                for k, operator in enumerate(node.ops):
                    sites.append((node, partial(node.ops.__setitem__, k, other(operator))))
            case ast.BinOp() | ast.BoolOp() | ast.AugAssign() if type(node.op).__name__ in OTHER:
                sites.append((node, partial(setattr, node, "op", other(node.op))))
            case ast.UnaryOp(op=ast.USub()):
                sites.append((node, partial(setattr, node, "op", ast.UAdd())))
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                twice = ast.UnaryOp(ast.Not(), operand)
                sites.append((node, partial(setattr, node, "operand", twice)))
            case ast.Constant(value=bool() | int() | float() as number):
                sites.append((node, partial(setattr, node, "value", another(number))))
    return sites


def other(operator: ast.AST) -> ast.AST:
    return getattr(ast, OTHER[type(operator).__name__])()


def another(number: bool | int | float) -> bool | int | float:
    """Return the other truth, the next whole number, or a number that is a tenth larger."""
    if isinstance(number, bool):
        return not number
    return number + 1 if isinstance(number, int) else 1.1 * number or 0.1


def within(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the nodes below a node that can change a result."""
    for field, content in ast.iter_fields(node):
        for child in content if isinstance(content, list) else [content]:
            is_type = field in ("annotation", "returns")
            if isinstance(child, ast.AST) and not isinstance(child, NO_RESULT) and not is_type:
                yield child
                yield from within(child)


def git(*words: str) -> str:
    command = ["git", "-C", str(ROOT), *words]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


if __name__ == "__main__":
    sys.exit(bool(main()))
