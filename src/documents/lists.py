"""The lists behind the documents, in Markdown: every number with its source, and every claim.

docs/numbers.md and docs/verdicts.md lead to files of the repository. On the pages of the site, made
from the same rows, they lead to lines of scripts and to the sentences that print a number.
"""

import ast
import csv
import re
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from documents.quotes import Quote
from replication.digits import decimals
from replication.verdicts import counted

NUMBERS = """# Numbers and their sources

Every result of the run, by its rule, with the estimated error of its arithmetic. Then the cells of
tables and the inputs that article and supplement print. The lines below a result are parts of it.
"""
CLAIMS = """# Claims and verdicts

Claims that are not plainly confirmed come first, with their condition and a remark. The verdicts:

- **confirmed**: true; a number agrees within the rounding of its print.
- **qualified**: true on a condition that is stated and tested.
- **supported**: true in simulations, where only a measurement could confirm it.
- **refuted**: none of the three above.
- **by definition**: it cannot be false.
- **not tested**: with the reason.

We worked from a transcription of the paper. *Our copy differs* where a sign, letter, bracket,
radical or number in it contradicts the paper's own premises. There we judge the evident meaning.
The last list has these places, to be compared with the print. The counts call these claims
confirmed in a mended form.
"""
TITLES = {"paper": "The paper's claims", "ours": "Claims of our own"}
ORDER = ["refuted", "qualified", "supported", "not tested", "by definition", "confirmed"]
HEAD = "| claim | verdict | from |\n|---|---|---|"


class Docs:
    """Where links lead from the folder docs."""

    numbers, claims = "numbers.md", "verdicts.md"

    def file(self, path: str, line: int = 0) -> str:
        """Return a link to a file; of the repository without a line, which a comment would move."""
        return f"[{path}](../{path})"

    def table(self, name: str) -> str:
        """Return a link to a table, published or of the run."""
        return f"[{name}](../tests/reference/{name}.csv)"

    def figure(self, name: str) -> str:
        """Return a link to what draws a figure, or to the figure in its document."""
        return self.file(f"figures/{name}.py")

    def verdict(self, verdict: str) -> str:
        """Return a verdict in bold."""
        return f"**{verdict}**"

    def line(self, script: str, name: str, function: str = "findings") -> str:
        """Return a link to the line of a result, on the site."""
        return ""

    def quotes(self, anchor: str) -> list[str]:
        """Return the sentences that print a number, with links to it, on the site."""
        return []


class Site(Docs):
    """Where links lead from the folder of the site."""

    numbers, claims = "numbers.html", "claims.html"

    def __init__(self, pages: Mapping[str, Iterable[Quote]], figures: Mapping[str, str]) -> None:
        self.figures = figures  # the page of each
        self.lines: dict[str, list[str]] = {}
        for page, quotes in pages.items():
            for count, quote in enumerate(quotes):
                words = re.sub(r"([\\`*_\[\]])", r"\\\1", escape(quote.sentence, quote=False))
                link = f"[{quote.place or 'Abstract'}]({page}#n{count})"
                self.lines.setdefault(quote.target, []).append(f"{link}: {words}")

    def file(self, path: str, line: int = 0) -> str:
        title, page = path.replace("__", r"\_\_"), f"source/{path}.html"  # no emphasis
        return f"[{title}, line {line}]({page}#L{line})" if line else f"[{title}]({page})"

    def table(self, name: str) -> str:
        return f"[{name}](tables/{name}.csv)"

    def figure(self, name: str) -> str:
        if name not in self.figures:  # its document is not made
            return super().figure(name)
        return f"[figure: {name}]({self.figures[name]}#fig-{name})"

    def verdict(self, verdict: str) -> str:  # which the buttons above the claims tell apart
        return f'<b class="verdict{ORDER.index(verdict)}">{verdict}</b>'

    def line(self, script: str, name: str, function: str = "findings") -> str:
        return f". By {self.file(script, line_of(script, name, function))}"

    def quotes(self, anchor: str) -> list[str]:
        return list(dict.fromkeys(self.lines.get(f"{self.numbers}#{anchor}", [])))


class Run(NamedTuple):
    """What the lists are made from."""

    claims: list[dict[str, Any]]
    captions: Mapping[str, Mapping[str, Any]]
    rules: Mapping[str, Any] = {}
    """Script, tables and parameters of each (results/rules.json)."""
    findings: Mapping[str, Mapping[str, Any]] = {}
    config: Mapping[str, Any] = {}
    quotes: Iterable[Quote] = ()
    tables: Path = Path("results/tables")


# Numbers ------------------------------------------------------------------------------------------


def numbers(run: Run, to: Docs) -> str:
    """Return the list of numbers."""
    text = [NUMBERS, f"Rules: {', '.join(f'[{rule}](#rule-{rule})' for rule in run.findings)}.\n"]
    for rule, results in run.findings.items():
        about = run.rules[rule]
        tables = [to.table(Path(path).stem) for path in [*about["tables"], *about["reads"]]]
        text += [
            f'<a id="rule-{rule}"></a>\n\n## {rule}\n',
            f"{to.file(about['script'])} draws these from {', '.join(tables)}. Again: "
            f"`snakemake --cores 2 --force results/findings/{rule}.json`\n",
        ]
        for name, result in results.items():
            place = to.line(about["script"], name)
            more = place + _judges(run, rule, name, to)
            text += _entry(f"{rule}.{name}", name, _shown(result), more, to)
            for part, content in result.items():
                if part not in ("value", "error", "unit", "holds", "condition", "holds_when"):
                    text += _entry(f"{rule}.{name}.{part}", part, _number(content), place, to, "  ")
        text.append("")
    return "\n".join([*text, *_cells(run, to), "", *_inputs(run, to)]) + "\n"


def _entry(anchor: str, name: str, value: str, more: str, to: Docs, indent: str = "") -> list[str]:
    words = name.replace("_", " ")
    return [
        f'{indent}- <a id="{anchor}"></a>**{words}**: {value}{more}',
        *(f"{indent}  - {line}" for line in to.quotes(anchor)),
    ]


def _shown(result: Mapping[str, Any]) -> str:
    """Return the value of a finding with its error, or whether it holds."""
    if "value" in result:
        error = f" ± {result['error']:.2g} (numerical error)" if result["error"] else ""
        unit = f" {result['unit']}" if result["unit"] else ""
        return decimals(result["value"], result["error"]) + error + unit
    words = {True: "holds", False: "does not hold"}
    if "condition" not in result:
        return words[result["holds"]]
    return f"{words[result['holds']]}; {words[result['holds_when']]} if {result['condition']}"


def _number(content: Any) -> str:
    if isinstance(content, list | tuple):
        return ", ".join(map(_number, content)) or "none"
    if isinstance(content, float):
        return f"{content:.6g}"
    return str(content).replace("|", "&#124;")


def _judges(run: Run, rule: str, name: str, to: Docs) -> str:
    """Return the claims that a finding judges."""
    judged = [
        f"[{row['id']}]({to.claims}#{row['id']}) ({row['verdict']})"
        for row in run.claims
        if (row["rule"], row["finding"]) == (rule, name)
    ]
    return f". Judges {', '.join(judged)}" if judged else ""


@cache
def nodes_of(script: str) -> list[ast.AST]:
    """Return the syntax of a script, which is parsed once for all its results."""
    return [*ast.walk(ast.parse(Path(script).read_text("utf-8")))]


def line_of(script: str, name: str, function: str) -> int:
    """Return the line where a script names a result, composes its name, or has the function."""
    places = {-1: 1}  # by how much of the name a line has
    for node in nodes_of(script):
        if isinstance(node, ast.FunctionDef) and node.name == function:
            places[0] = node.lineno
        elif isinstance(node, ast.JoinedStr):
            texts = [part.value if isinstance(part, ast.Constant) else "" for part in node.values]
            if re.fullmatch("".join(re.escape(text) or ".+" for text in texts), name):
                places.setdefault(len("".join(texts)), node.lineno)
        elif isinstance(node, ast.Constant | ast.keyword) and name == getattr(
            node, "value" if isinstance(node, ast.Constant) else "arg"
        ):
            places.setdefault(len(name), node.lineno)
    return places[max(places)]


def _cells(run: Run, to: Docs) -> Iterator[str]:
    """Return each table that the documents quote, with the quoted cells."""
    quoted: dict[str, dict[str, tuple[str, str]]] = {}
    for quote in run.quotes:
        for source in quote.source.split(" and "):
            table, _, cell = source.partition(":")
            if table not in ("config", "claim", "claims") and "." not in table:
                quoted.setdefault(table, {})
                if cell:
                    anchor = re.sub("[^A-Za-z0-9_.:;=-]", "_", source)
                    quoted[table][anchor] = tuple(cell.split(":", 1))
    yield "## Tables\n"
    makers = {Path(path).stem: rule for rule in run.rules.values() for path in rule["tables"]}
    for table, cells in sorted(quoted.items()):
        text = (run.tables / f"{table}.csv").read_text("utf-8")
        rows = list(csv.DictReader(text.splitlines()))
        script = makers[table]["script"]
        place = to.line(script, table, "compute")
        origin = f"{len(rows)} rows of {to.table(table)}, by {to.file(script)}"
        yield from _entry(table, table, origin, place, to)
        for anchor, (column, keys) in cells.items():
            known = dict(key.split("=", 1) for key in keys.split(";"))
            (row,) = (row for row in rows if known.items() <= row.items())
            where = ", ".join(f"{key} {value}" for key, value in known.items())
            number = row[column]
            yield from _entry(anchor, f"{column}, {where}", number or "none", place, to, "  ")


def _inputs(run: Run, to: Docs) -> Iterator[str]:
    """Return each input that the documents quote, with its comment in the config."""
    path = "config/config.yaml"
    text = Path(path).read_text("utf-8")
    lines, root = text.splitlines(), yaml.compose(text)
    yield "## Inputs\n"
    sources = {source for quote in run.quotes for source in quote.source.split(" and ")}
    for source in sorted(source for source in sources if source.startswith("config:")):
        content: Any = run.config
        node, line = root, 0
        for key in source[7:].split("."):
            if isinstance(node, yaml.MappingNode):
                content = content[key]
                name, node = next(pair for pair in node.value if pair[0].value == key)
                line = name.start_mark.line
            else:
                content, node = content[int(key)], node.value[int(key)]
                line = node.start_mark.line
        comment = lines[line].partition(" # ")[2]
        about = f". {comment}" if comment else ""
        place = f". {to.file(path, line + 1)}"
        value = _number(content) if not isinstance(content, dict) else "a section"
        yield from _entry(source, source[7:], value, about + place, to)


# Claims -------------------------------------------------------------------------------------------


def claims(run: Run, to: Docs) -> str:
    """Return the list of claims: the paper's, ours, and the places where our copy differs."""
    text = [CLAIMS]
    for part in dict.fromkeys(row["part"] for row in run.claims):
        rows = [row for row in run.claims if row["part"] == part]
        text += [f"## {TITLES[part]}\n", f"{counted(rows)}.\n", HEAD]
        rows.sort(key=lambda row: (ORDER.index(row["verdict"]), not row["differs"]))
        text += [*(_claim(row, run, to) for row in rows), ""]
    text.append("## Places where our copy differs\n")
    for row in filter(lambda row: row["differs"], run.claims):
        text.append(f"- {row['where']} (`{row['id']}`), {row['differs']}. {row['remark']}")
    return "\n".join(text) + "\n"


def _claim(row: dict[str, Any], run: Run, to: Docs) -> str:
    """Return a claim as a row of a table."""
    statement = f'<a id="{row["id"]}"></a>{row["statement"]}'
    if row["shown"]:
        printed = f"{row['printed']} {row['unit']}".strip()
        statement += f" Printed: {printed}. Computed: {row['shown']}."
    statement += f" {row['where']} (`{row['id']}`)."
    if row["verdict"] != "confirmed" or row["differs"]:
        condition = f"True if {row['condition']}. " if row.get("condition") else ""
        statement += f"<br>{condition}{row['remark']}"
    figures = [name for name, caption in run.captions.items() if row["id"] in caption["claims"]]
    sources = [to.figure(name) for name in figures]
    if row["rule"]:
        finding = f"{row['rule']}.{row['finding']}"
        sources.insert(0, f"[{finding}]({to.numbers}#{finding})")
    cells = (
        statement,
        to.verdict(row["verdict"]) + (" (our copy differs)" if row["differs"] else ""),
        ", ".join(sources),
    )
    shown = (str(cell).replace("|", "&#124;").replace("\n", " ") for cell in cells)
    return f"| {' | '.join(shown)} |"
