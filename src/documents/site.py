"""Make the pages of the site: article, supplement, lists, scripts, and finished pages, in a frame.

Typst compiles article and supplement to HTML from the sources of the PDFs. Each number in them is a
link to its source; one without a source stops the step.
"""

import json
import re
from base64 import b64encode
from hashlib import sha256
from html import escape
from itertools import chain, count
from pathlib import Path
from typing import Any
from unicodedata import normalize

import mistune

from documents import frame, lists
from documents.quotes import Quote
from documents.typeset import NoMeaning, checked, texts_of
from replication.config import read_yaml
from replication.job import log_to, write

PAGES = {  # at the head of each page, by what a reader wants
    "Read": {"index.html": "Article", "supplement.html": "Supplement", "report.pdf": "PDF"},
    "Check": {"claims.html": "Claims", "numbers.html": "Numbers", "sources.html": "Code"},
    "Try": {
        "explorer.html": "Play",
        "notebook_paper.html": "Paper’s results",
        "notebook_derivation.html": "Derivation",
        "notebook_play.html": "First steps",
        "functions.html": "Functions",
    },
}
ACCENTS = {0x302: "^", 0x307: "˙", 0x308: "¨"}
"""A combining accent has no width, so that browsers would set it beside its letter."""
SEARCH = """<p><label>Search the numbers <input type="search" id="search"></label></p>
<script>
document.getElementById("search").addEventListener("input", ({ target }) => {
  for (const entry of document.querySelectorAll("main > ul > li"))
    entry.hidden = !entry.textContent.toLowerCase().includes(target.value.toLowerCase())
})
</script>"""


def head(name: str) -> str:
    """Return the links at the head of a page; `name` is its path from the folder of the site."""
    up = "../" * name.count("/")
    groups = []
    for group, pages in PAGES.items():
        links = " ".join(
            f'<a href="{up}{page}"{" aria-current=page" * (page == name)}>{label}</a>'
            for page, label in pages.items()
        )
        groups.append(f"<span><b>{group}</b> {links}</span>")
    return f'<nav class="pages" aria-label="Pages">{" ".join(groups)}</nav>'


def framed(name: str, title: str, body: str, kind: str = "list") -> str:
    """Return a page in the frame of all pages."""
    style = f'<link rel="stylesheet" href="{"../" * name.count("/")}site.css">'
    return frame.framed(title, f"{head(name)}\n{body}", kind, style)


def headed(name: str, text: str, style: str) -> str:
    """Return a finished page, made elsewhere, with the links of all pages at its head."""
    digest = b64encode(sha256(style.encode()).digest()).decode()
    text = text.replace("; style-src ", f"; style-src 'sha256-{digest}' ", 1)  # its policy, if any
    text = text.replace("</head>", f"<style>{style}</style></head>", 1)
    return re.sub("<body[^>]*>", lambda tag: tag[0] + head(name), text, count=1)


def document(name: str, html: str) -> str:
    """Return the HTML of Typst in the frame, with an anchor for each number and sizes of pictures.

    A browser would break the line between an expression and the mark that follows it. A screen
    reader takes an expression as a whole: its link goes around it, and as a head it has a name.
    """
    title = re.search("<title>(.*?)</title>", html)[1]
    styles = "".join(re.findall("(?s)<style>(.*?)</style>", html))  # of MathML, by Typst
    body = re.search("(?s)<body>(.*)</body>", html)[1]
    numbers = count()

    def sized(source: re.Match) -> str:
        view = re.search(r'viewBox="0 0 (\S+) (\S+)"', Path(source[1]).read_text("utf-8"))
        return f'{source[0]} width="{view[1]}" height="{view[2]}"'

    body = re.sub('<a class="number"', lambda link: f'<a id="n{next(numbers)}"{link[0][2:]}', body)
    body = re.sub(r'src="(figures/\w+\.svg)"', sized, body)
    body = re.sub("<mo>.</mo>", lambda accent: accent[0].translate(ACCENTS), body)
    whole = r"\(?<math>(?:(?!</math>).)*</math>[).,;:]+"
    body = re.sub(whole, r'<span class="whole">\g<0></span>', body)
    number = '((?:(?!</?math>).)*)(<a id="n[^>]*>)([^<]*)</a>((?:(?!<a |</math>).)*)'
    body = re.sub(f"<math>{number}</math>", r"\2<math>\1<mn>\3</mn>\4</math></a>", body)
    body = re.sub("<th><math>((?:(?!</math>).)*)</math></th>", column_head, body)
    return framed(name, title, f"<style>{styles}</style>{body}", "article")


def column_head(cell: re.Match) -> str:
    """Return the head of a column that is an expression, with its letters as its name."""
    name = normalize("NFKC", re.sub("<[^>]*>", "", cell[1]))
    return f'<th><math aria-label="{name}">{cell[1]}</math></th>'


def listed(name: str, text: str, more: str = "") -> str:
    """Return a list in Markdown as a page, with more above it."""
    body = mistune.create_markdown(escape=False, plugins=["table"])(text)
    body = re.sub(r'<(li|tr)>(\s*<td>)?\s*<a id="([^"]*)"></a>', r'<\1 id="\3">\2', body)
    body = re.sub("(?s)<table>.*?</table>", r'<div class="scroll" tabindex="0">\g<0></div>', body)
    title = re.search("<h1>(.*?)</h1>", body)[1]
    return framed(name, title, f"<main>{body.replace('</h1>', '</h1>' + more, 1)}</main>")


def buttons(claims: list[dict[str, Any]]) -> str:
    """Return buttons that show the claims with one verdict, without a script."""
    rules, labels = [], ['<label><input type="radio" name="verdict" checked> all</label>']
    for number, verdict in enumerate(lists.ORDER):
        of_it = sum(row["verdict"] == verdict for row in claims)
        radio = f'<input type="radio" name="verdict" id="only{number}">'
        labels.append(f"<label>{radio} {verdict} ({of_it})</label>")
        others = f"tbody tr:not(:has(.verdict{number}))"
        rules.append(f"body:has(#only{number}:checked) {others} {{ display: none }}")
    return f'<style>{" ".join(rules)}</style><form class="filter">{" ".join(labels)}</form>'


def source_page(path: str) -> str:
    """Return a file of the repository as a page, with an anchor for each line."""
    name = f"source/{path}.html"
    lines = Path(path).read_text("utf-8").splitlines()
    body = "\n".join(
        f'<span id="L{n}"><a href="#L{n}">{n:4}</a> {escape(line)}</span>'
        for n, line in enumerate(lines, 1)
    )
    return framed(name, path, f"<main><h1>{path}</h1><pre>{body}</pre></main>", "code")


def documents(job: Any) -> tuple[dict[str, str], dict[str, list[Quote]]]:
    """Return article and supplement by the names of their pages, and the numbers of each."""
    texts = texts_of(job.params.config, job.input.captions)
    pages, quotes = {}, {}
    for source, name in (("report", "index.html"), ("supplement", "supplement.html")):
        try:
            numbers = checked(f"paper/{source}.typ", texts)
            pages[name], quotes[name] = document(name, numbers.html), numbers.quotes
        except NoMeaning as fault:  # its PDF is not made, either, and stops the run
            body = f"<main><h1>{source}</h1><p>{escape(str(fault))}</p></main>"
            pages[name], quotes[name] = framed(name, source, body), []
    return pages, quotes


def site(job: Any) -> dict[str, str | bytes]:
    """Return the pages and files of the site, and the lists of docs/, by their paths."""

    def read(path: str) -> Any:
        return json.loads(Path(path).read_text("utf-8"))

    pages, quotes = documents(job)
    rules, captions = read(job.input.rules), read_yaml(job.input.captions)
    findings = [name for name, about in rules.items() if about["findings"]]
    run = lists.Run(
        read(job.input.claims),
        captions,
        rules,
        {name: read(f"results/findings/{name}.json") for name in findings},
        job.params.config,
        [*chain.from_iterable(quotes.values())],
    )
    in_page = {name: page for name in captions for page in pages if f'fig-{name}"' in pages[page]}
    to, docs = lists.Site(quotes, in_page), lists.Docs()
    pages["numbers.html"] = listed("numbers.html", lists.numbers(run, to), SEARCH)
    pages["claims.html"] = listed("claims.html", lists.claims(run, to), buttons(run.claims))
    index = "\n".join(f"- {to.file(path)}" for path in job.input.scripts)
    pages["sources.html"] = listed("sources.html", f"# Sources of this run\n\n{index}\n")
    pages |= {f"source/{path}.html": source_page(path) for path in job.input.scripts}
    style = Path(job.input.head).read_text("utf-8")
    for path in map(Path, job.input.finished):
        name = ("notebook_" if path.parent.name == "notebooks" else "") + path.name
        pages[name] = headed(name, path.read_text("utf-8"), style)
    font = b64encode(Path(job.input.font).read_bytes()).decode()
    face = f'@font-face {{ font-family: "Topheavy Math"; src: url(data:font/woff;base64,{font}); }}'
    pages["site.css"] = f"{style}{face}\n{Path(job.input.style).read_text('utf-8')}"
    folders = {".svg": "figures/", ".gif": "figures/", ".csv": "tables/", ".pdf": ""}
    copies = [path for path in map(Path, job.input) if path.suffix in folders]
    files = {folders[path.suffix] + path.name: path.read_bytes() for path in copies}
    return {f"{job.output.site}/{name}": content for name, content in (pages | files).items()} | {
        job.output.numbers: lists.numbers(run, docs),
        job.output.verdicts: lists.claims(run, docs),
    }


if __name__ == "__main__":
    with log_to(snakemake.log[0]):
        contents = site(snakemake)
        for path in contents:
            Path(path).parent.mkdir(parents=True, exist_ok=True)
        write(snakemake, contents)
