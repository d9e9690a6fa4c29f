"""Check structures and records of this paper beyond their schema."""

from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from replication.inputs.configuration import check_config, is_number, mapping_in
from replication.inputs.suggestions import hint

RECORDS = "data/records"
UNORDERED = ("printed_masses", "accelerations")
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


def records_exist(config: Mapping[str, Any], folder: str = RECORDS) -> Iterator[str]:
    """Yield the records that a config names and that do not exist."""
    for section in config:
        names = {"record.file": mapping_in(mapping_in(config, section), "record").get("file")}
        several = mapping_in(config, section).get("records")
        if isinstance(several, list):
            names |= {f"records.{place}": name for place, name in enumerate(several)}
        for place, name in names.items():
            there = record_files(folder)
            if isinstance(name, str) and name not in there:
                yield (
                    f"{section}.{place} is {name!r}, for which there is no {folder}/{name}.AT2 "
                    f"or .csv; {hint(name, there)}"
                )
