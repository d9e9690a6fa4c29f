"""What README and other files state beside a run: numbers behind links, DOI, version, licences."""

import re
import tomllib
import unicodedata
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from html import unescape
from pathlib import Path
from typing import Any
from urllib.parse import unquote

from audit import ABSTRACT, NUMBER, not_covered
from replication.config import read_yaml
from topheavy import read_record

LICENCES = {  # texts below the line of the holder, and their SHA-256
    "LICENSE": "37dbbcd58d8e438706b6b0ebd64c7e1f19223e1adccaa438b90e8cf937a53eab",
    "docs/LICENSE-CC-BY": "a5349a209822149c2b06a142dd88e3630c4765310260fc9d09928cac75552be9",
}
HEADLINES = {  # words of README and abstract, with the claim and the verdict on which they rest
    "Until the first impact, yes, for every": ("heavier_rotates_less_until_an_impact", "confirmed"),
    "without an impact, it so overturns|without an impact, so it does the lighter": (
        "heavier_rotates_less_until_an_impact",
        "confirmed",
    ),
    "After an impact, usually": ("heavier_is_more_stable_by_the_probability", "qualified"),
    "Not always": ("heavier_can_overturn_alone", "confirmed"),
    "contacts stay pressed|contacts neither slide nor part": ("contacts_stay_pressed", "confirmed"),
}
DOI = re.compile(r"10\.\d{4}/[^\s\"}]*\.\d{7}")


def misstated(results: Mapping[str, Any], claims: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Yield each statement that is not what findings, claims, records or other files say."""
    readme = Path("README.md").read_text("utf-8")
    yield from links(readme, results)
    yield from miscounted(claims, readme)
    yield from headlines(claims, "README.md", readme)
    yield from records(Path("data/records"))
    citation = read_yaml("CITATION.cff")
    project = tomllib.loads(Path("pyproject.toml").read_text("utf-8"))["project"]
    for key, known in (("version", project["version"]), ("license", project["license"])):
        if citation[key] not in known.split(" AND "):
            yield f"CITATION.cff: {key} {citation[key]}; pyproject.toml has {known}"
    doi = citation["references"][0]["doi"]
    for path in ("README.md", "paper/references.bib"):
        if doi not in DOI.findall(unquote(Path(path).read_text("utf-8"))):
            yield f"{path}: the DOI of the paper is not there; CITATION.cff has {doi}"
    for path, digest in LICENCES.items():
        text = Path(path).read_text("utf-8").partition("The topheavy developers\n")[2]
        if sha256(text.encode()).hexdigest() != digest:
            yield f"{path}: another text of the licence: git checkout {path}"


def miscounted(claims: Sequence[Mapping[str, Any]], text: str) -> Iterator[str]:
    """Yield the sentence with the counts of verdicts on the paper's claims, if a text lacks it."""
    count = Counter(claim["verdict"] for claim in claims if claim["part"] == "paper")
    sentence = (
        f"[{count.total()} claims](docs/verdicts.md) {count['confirmed']} are confirmed, "
        f"{count['qualified']} hold on a condition, {count['supported']} is supported, "
        f"{count['by definition']} holds by definition, {count['not tested']} were not tested."
    )
    if sentence not in text:
        yield f"README.md has other counts of verdicts than the claims: {sentence}"


def headlines(claims: Sequence[Mapping[str, Any]], place: str, text: str) -> Iterator[str]:
    """Yield each of the headlines that a text lacks, or has against the verdict on its claim."""
    verdicts = {claim["id"]: claim["verdict"] for claim in claims}
    plain = " ".join(text.replace("*", "").split())
    for words, (claim, verdict) in HEADLINES.items():
        if bool(re.search(words, plain)) != (verdicts[claim] == verdict):
            yield f"{place}: '{words}' has to be there exactly if {claim} is {verdict}"


def unsaid(html: str, claims: Sequence[Mapping[str, Any]]) -> Iterator[str]:
    """Yield headlines and sentences of src/audit.py that the abstract lacks, and other numbers."""
    abstract = re.search('(?s)<div class="abstract".*?</div>', html)[0]
    plain = unicodedata.normalize("NFKC", unescape(re.sub("<[^>]*>", "", abstract)))
    text = " ".join(plain.split())
    yield from headlines(claims, "paper/report.typ", text)
    for sentence in ABSTRACT.values():
        if not re.search(sentence.replace("#", NUMBER), text):
            yield f"paper/report.typ: the abstract does not say what src/audit.py has: {sentence}"
    for number in not_covered(text.partition("Are they?")[2], ABSTRACT.values()):
        yield f"paper/report.typ: {number} of the abstract is in no sentence of src/audit.py"


def links(text: str, results: Mapping[str, Any]) -> Iterator[str]:
    """Yield each link to docs/numbers.md that leads to no result, or to another than it shows."""
    for shown, anchor in re.findall(r"\[([^]]*)\]\(docs/numbers\.md#([^)]*)\)", text):
        rule, _, name = anchor.partition(".")
        if name not in results.get(rule, {}):
            yield f"README.md: [{shown}] leads to {anchor}, which is no result: docs/numbers.md"
            continue
        known = [*_numbers(results[rule][name])]
        for number in re.findall(r"\d+(?:\.\d+)?", shown):
            digits = len(number.partition(".")[2])
            if number not in {f"{abs(k * x):.{digits}f}" for x in known for k in (1, 100)}:
                yield f"README.md: [{shown}] leads to {anchor}, which has no {number}"


def _numbers(content: Any) -> Iterator[float]:
    """Yield the numbers of a finding and of its parts."""
    if isinstance(content, dict | list | tuple):
        for part in content.values() if isinstance(content, dict) else content:
            yield from _numbers(part)
    elif isinstance(content, int | float):
        yield content


def records(folder: Path) -> Iterator[str]:
    """Yield each record whose row in README is missing, or has other numbers."""
    text = (folder / "README.md").read_text("utf-8")
    for path in sorted(folder.glob("*.AT2")):
        record = read_record(path)
        peak = f"{record.peak_acceleration:.3f}"
        end = f" | {len(record.acceleration)} | {record.time_step:g} | {peak} | "
        if not re.search(rf"^\| {re.escape(path.name)} \|.*{re.escape(end)}", text, re.MULTILINE):
            yield f"{folder}/README.md: no row of {path.name} with{end}".rstrip(" |")
