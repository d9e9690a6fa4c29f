"""Check structures and records of this paper beyond their schema."""

from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from replication.configuration import check_config, is_number, mapping_in
from replication.suggestions import hint

RECORDS = "data/records"
VERTICAL = "_UP"
"""How the name of a vertical component ends."""

UNORDERED = ("printed_masses", "accelerations", "samples")
"""Lists of numbers that need not ascend."""


def check_inputs(
    config: Mapping[str, Any],
    path: str,
    schema: str,
    records: str = RECORDS,
    structures: Mapping[str, Any] | None = None,
) -> None:
    """Refuse a config that breaks its schema, or whose entries do not fit together.

    `structures` are further structures that the config may name.

    Raises
    ------
    ValueError
        With one line for each fault: the file, the place, the value, and what was expected.
    """
    checks = (
        partial(structures_fit, others=structures or {}),
        partial(records_exist, folder=records),
    )
    check_config(config, path, schema, checks, UNORDERED)


def structures_fit(config: Mapping[str, Any], others: Mapping[str, Any]) -> Iterator[str]:
    """Yield the errors in structures, and in names of structures."""
    own = mapping_in(config, "structures")
    structures = {**others, **own}
    for name in own:
        b, h = (mapping_in(own, name).get(key) for key in ("half_width", "half_height"))
        if is_number(b) and is_number(h) and b >= h > 0:
            yield (
                f"structures.{name} has the half width {b} and the half height {h}, in m; "
                "expected columns more slender than 45°, which keep rocking for every γ"
            )
    for section in config:
        name = mapping_in(config, section).get("structure")
        if isinstance(name, str) and name not in structures:
            yield f"{section}.structure is {name!r}, not in structures; {hint(name, structures)}"
        for name in mapping_in(mapping_in(config, section), "frames"):
            if name not in structures:
                yield f"{section}.frames has {name!r}, not in structures; {hint(name, structures)}"


def record_files(folder: str = RECORDS) -> dict[str, str]:
    """Return the files of all records, AT2 and CSV, by name.

    Raises
    ------
    ValueError
        When two files have the same name, since a config could mean either.
    """
    endings = (".at2", ".csv")
    files: dict[str, str] = {}
    for path in sorted(Path(folder).iterdir()):
        if path.suffix.lower() not in endings:
            continue
        if path.stem in files:
            raise ValueError(
                f"{files[path.stem]} and {path.as_posix()} are both the record {path.stem!r}; "
                "expected one file of each name: rename or remove one"
            )
        files[path.stem] = path.as_posix()
    return files


def horizontal(names: Iterable[str]) -> list[str]:
    """Return the records that are no vertical component, whose names end in VERTICAL."""
    return [name for name in names if not name.endswith(VERTICAL)]


def record_paths(records: str | Mapping[str, Any], files: Mapping[str, str]) -> list[str]:
    """Return the files of the records of a section of a config.

    Parameters
    ----------
    records
        "horizontal" for every horizontal component that there is, or a mapping with the names
        `only`, and the reason `because`: results under "no record" or "every record" cannot leave
        one out silently.
    files
        As `record_files` returns them.
    """
    names = horizontal(files) if isinstance(records, str) else records["only"]
    return [files[name] for name in names]


def records_exist(config: Mapping[str, Any], folder: str = RECORDS) -> Iterator[str]:
    """Yield what is wrong with the records that a config names.

    They exist; and those of a list `only` are some, and not all, of the horizontal components.
    """
    for section in config:
        names = {"record.file": mapping_in(mapping_in(config, section), "record").get("file")}
        only = mapping_in(mapping_in(config, section), "records").get("only")
        only = only if isinstance(only, list) else []
        names |= {f"records.only.{place}": name for place, name in enumerate(only)}
        for place, name in names.items():
            there = record_files(folder)
            if isinstance(name, str) and name not in there:
                yield (
                    f"{section}.{place} is {name!r}, for which there is no {folder}/{name}.AT2 "
                    f"or .csv; {hint(name, there)}"
                )
            elif isinstance(name, str) and place != "record.file" and not horizontal([name]):
                yield (
                    f"{section}.{place} is {name!r}, a vertical component; "
                    "expected a horizontal one"
                )
        if only and set(horizontal(record_files(folder))) <= set(map(str, only)):
            yield (
                f"{section}.records.only names every horizontal component in {folder}; "
                "expected some of them, or `records: horizontal`"
            )
