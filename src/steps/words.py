"""Find words and phrases that paper/words.yaml, if there is one, advises against: `make lint`."""

import io
import re
import sys
import tokenize
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from replication.inputs.strict_yaml import read_yaml

LIST = Path("paper/words.yaml")
TEXTS = ("STRING", "FSTRING_MIDDLE")  # before Python 3.12 an f-string is one STRING
FIELD = re.compile(r"\{[^{}\n]*\}")
GAP = r"(?:\s|#)+"  # between two words: also a line break, with the mark of a comment


def pattern_of(phrase: str) -> re.Pattern[str]:
    """Return the pattern of a phrase of whole words, in lower case or with a capital first letter.

    `|` separates alternatives, and a phrase can continue on the next line of the text.
    """
    alternatives = []
    for alternative in phrase.split("|"):
        first, rest = alternative[0], alternative[1:]
        start = f"[{first}{first.upper()}]" if first.isalpha() else re.escape(first)
        alternatives.append(start + GAP.join(map(re.escape, rest.split(" "))))
    return re.compile(rf"(?<![\w-])(?:{'|'.join(alternatives)})(?![\w-])")


def files_of(words: Mapping[str, Any], root: Path = Path()) -> list[Path]:
    """Return the files that the list names and does not exclude.

    Raises
    ------
    ValueError
        When an entry of `files` or `except` matches no file.
    """
    named: dict[str, set[Path]] = {}
    for key in ("files", "except"):
        named[key] = set()
        for entry in words[key]:
            matches = {path for path in root.glob(entry) if path.is_file()}
            if not matches:
                raise ValueError(f"{LIST}: {key} has '{entry}', which matches no file; correct it")
            named[key] |= matches
    return sorted(named["files"] - named["except"])


def prose(code: str) -> str:
    """Return Python code with everything blank but comments and texts of several words."""
    lines = [" " * len(line) for line in code.splitlines()]
    for token in tokenize.generate_tokens(io.StringIO(code).readline):
        kind = tokenize.tok_name[token.type]
        if not (kind == "COMMENT" or (kind in TEXTS and " " in token.string)):
            continue
        row, column = token.start
        text = FIELD.sub(lambda field: " " * len(field[0]), token.string)
        for offset, part in enumerate(text.split("\n")):
            start = column if offset == 0 else 0
            line = lines[row - 1 + offset]
            lines[row - 1 + offset] = line[:start] + part + line[start + len(part) :]
    return "\n".join(lines)


def findings(text: str, phrases: Mapping[str, str]) -> Iterator[tuple[int, str, str]]:
    """Yield each phrase to avoid in a text: its line, the phrase as written, and the advice."""
    for phrase, better in phrases.items():
        for match in pattern_of(phrase).finditer(text):
            yield (
                text.count("\n", 0, match.start()) + 1,
                " ".join(match[0].replace("#", " ").split()),
                better,
            )


def phrases_of(root: Path = Path()) -> dict[str, str]:
    """Return the phrases to avoid, with the advice for each; none without a list."""
    return read_yaml(root / LIST)["phrases"] if (root / LIST).is_file() else {}


def main(root: Path = Path()) -> int:
    if not (phrases := phrases_of(root)):
        return 0
    words, found = read_yaml(root / LIST), 0
    for path in files_of(words, root):
        text = path.read_text(encoding="utf-8")
        text = prose(text) if path.suffix == ".py" else text
        for line, phrase, better in sorted(findings(text, phrases)):
            print(f"{path.relative_to(root)}:{line}: '{phrase}'; better: {better}")
            found += 1
    if found:
        print(f"{found} phrases to avoid ({LIST}); replace each, or explain an exception there")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
