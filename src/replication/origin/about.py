"""What the RO-Crate of a run says of the whole: title, date, authors, licences, the paper.

All of it is in CITATION.cff and pyproject.toml.
"""

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from replication.origin.entities import Entity, refs, without_blanks


def root(citation: Mapping[str, Any], project: Mapping[str, Any]) -> Entity:
    """Return what the root says of itself: title, version, date, and where it is published."""
    if "date-released" not in citation:
        raise ValueError("CITATION.cff has no date-released; expected the date of the version")
    published = {"identifier": citation.get("doi", ""), "url": citation.get("repository-code", "")}
    return without_blanks(
        {
            "name": citation["title"],
            "description": project["description"],
            "version": project["version"],
            "datePublished": str(citation["date-released"]),
            "keywords": ", ".join(citation.get("keywords", [])),
            **published,
        }
    )


def name_of(author: Mapping[str, str]) -> str:
    """Return the name of an author of a CITATION.cff, who is a person or an organization."""
    name = f"{author.get('given-names', '')} {author.get('family-names', '')}".strip()
    return author.get("name", name)


def people(authors: Iterable[Mapping[str, str]]) -> Iterator[Entity]:
    """Yield each author of a CITATION.cff."""
    for author in authors:
        name = name_of(author)
        yield {
            "@id": author.get("orcid", f"#author/{name.replace(' ', '_')}"),
            "@type": "Person" if "family-names" in author else "Organization",
            "name": name,
        }


def licences(citation: Mapping[str, Any]) -> list[Entity]:
    """Return each licence of a CITATION.cff, which has one or a list, by its SPDX name."""
    names = citation["license"]
    return [
        {"@id": f"https://spdx.org/licenses/{name}", "@type": "CreativeWork", "name": name}
        for name in ([names] if isinstance(names, str) else names)
    ]


def article(reference: Mapping[str, Any]) -> tuple[list[Entity], Entity]:
    """Return the authors of the paper that is replicated, and the paper."""
    authors = list(people(reference["authors"]))
    return authors, {
        "@id": f"https://doi.org/{reference['doi']}" if "doi" in reference else "#paper",
        "@type": "ScholarlyArticle",
        "name": reference["title"],
        "author": refs(authors),
    }
