"""Put the page to play with together from src/explorer/: one file that needs no network.

The outcomes that its named cases promise are computed here with the library.
"""

import hashlib
import json
import math
import re
from base64 import b64encode
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from replication.config import read_yaml
from replication.step import run
from topheavy import (
    Column,
    FixedMassColumn,
    MonolithicPortal,
    Pulse,
    Record,
    RockingFrame,
    read_record,
    simulate,
)
from topheavy.bodies.structures import RockingBlock
from topheavy.ground.shapes import FINITE_SHAPES, SHAPES

STYLES = ("uplot/uPlot.min.css", "style.css")
UPLOT = "uplot/uPlot.iife.min.js"
ENGINE = ("structures.js", "motions.js", "records.js", "solver.js", "worker.js")
"""The scripts that the page's worker runs, too."""
SCRIPTS = ("state.js", "scene.js", "charts.js", "controls.js", "page.js")

DEFAULTS = {"r": None, "cap": "free", "eq": "exact", "x": 1.0, "start": "smooth"}
"""Of the fields that a named case may leave out, as in state.js."""

TITLES = {"el_centro_1940_NS": "El Centro 1940, north–south"}


def blocks(state: Mapping[str, Any]) -> dict[str, RockingBlock]:
    """Return column, vase and frame of a state as the page's controls hold it."""
    state = DEFAULTS | state
    column = Column.of_dimensions(width=state["width"], height=state["height"])
    frame = (
        MonolithicPortal(column, state["g"], state["L"])
        if state["cap"] == "fixed"
        else RockingFrame(column, state["g"])
    )
    structures = {"column": column, "vase": FixedMassColumn(column, state["g"]), "frame": frame}
    rocking = {name: structure.block(state["r"]) for name, structure in structures.items()}
    if state["eq"] == "linearised":
        return {name: block.linear() for name, block in rocking.items()}
    return rocking


def motion(state: Mapping[str, Any], records: Mapping[str, Record]) -> Pulse | Record:
    """Return the ground motion of a state; a steady sine starts with a displacement + sin ωt."""
    if state["shape"] == "record":
        return records[state["record"]].scaled((DEFAULTS | state)["x"])
    sign = -1.0 if state["shape"] == "harmonic" else 1.0
    return Pulse(state["shape"], sign * state["a"], period=state["T"])


def options(state: Mapping[str, Any], block: RockingBlock) -> dict[str, float]:
    """Return the duration of a steady sine, and the velocity of a block after its abrupt start."""
    if state["shape"] != "harmonic":
        return {}
    if (DEFAULTS | state)["start"] == "smooth":
        return {"duration": state["D"]}
    lever = 1.0 if block.linearised else math.cos(block.slenderness)
    table = state["a"] * state["T"] / (2.0 * math.pi)  # its velocity over g
    return {"duration": state["D"], "velocity": -(block.frequency_parameter**2) * lever * table}


def outcomes(state: Mapping[str, Any], records: Mapping[str, Record]) -> list[str]:
    """Return the outcomes of column, vase and frame, in the words of the page."""
    words = {"overturned": "overturns", "no uplift": "no uplift"}
    shaken = motion(state, records)
    ends = [
        simulate(block, shaken, samples=2, **options(state, block)).outcome
        for block in blocks(state).values()
    ]
    return [words.get(end, "survives") for end in ends]


def checked_cases(cases: list[dict], records: Mapping[str, Record]) -> list[dict]:
    """Return the named cases without their outcomes.

    Raises
    ------
    ValueError
        When the library computes other outcomes than a case promises.
    """
    for case in cases:
        computed = outcomes(case["state"], records)
        if computed != case["outcomes"]:
            raise ValueError(
                f"src/explorer/cases.yaml: {case['title']!r} promises {case['outcomes']} for "
                f"column, vase and frame; the library computes {computed}: correct one of the two"
            )
    return [{key: case[key] for key in ("title", "note", "state")} for case in cases]


def titles(motions: str) -> dict[str, str]:
    """Return what the page calls each pulse shape of the library, those that end first.

    `motions` is the text of motions.js.

    Raises
    ------
    ValueError
        When it has a wave that is no shape of the library, or lacks one.
    """
    waves = set(re.findall(r'^  "([\w-]+)": \{', motions, re.MULTILINE))
    if odd := waves.symmetric_difference(SHAPES):
        raise ValueError(
            f"src/explorer/motions.js and ground/shapes.py differ by {', '.join(sorted(odd))}; "
            "expected a wave for every shape, and a shape for every wave"
        )
    return {name: SHAPES[name].title for name in dict.fromkeys((*FINITE_SHAPES, *SHAPES))}


def page(folder: Path, records: Mapping[str, Record]) -> str:
    """Return the whole page as a text, the same each time."""

    def read(name: str) -> str:
        text = (folder / name).read_text(encoding="utf-8")
        if "</script" in text and name.endswith(".js"):
            raise ValueError(f"{folder / name} has a closing script tag, which would end it early")
        return text

    data = {
        "shapes": titles(read("motions.js")),
        "cases": checked_cases(read_yaml(folder / "cases.yaml"), records),
        "records": [
            {
                "name": name,
                "title": TITLES.get(name, name),
                "step": record.time_step,
                "samples": record.acceleration.tolist(),
                "peak": record.peak_acceleration,
            }
            for name, record in records.items()
        ],
    }
    parts = {
        "styles": "\n".join(map(read, STYLES)),
        "uplot": f"/*\n{read('uplot/LICENSE')}*/\n{read(UPLOT)}",
        "engine": "\n".join(f'<script class="engine">{read(name)}</script>' for name in ENGINE),
        "scripts": "\n".join(f"<script>{read(name)}</script>" for name in SCRIPTS),
        "data": json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c"),
    }
    text = read("page.html")
    for name, part in parts.items():
        if text.count(f"{{{{ {name} }}}}") != 1:
            raise ValueError(f"{folder / 'page.html'}: expected one place for {name}")
        text = text.replace(f"{{{{ {name} }}}}", part)
    return text.replace("{{ policy }}", policy(text))


def policy(text: str) -> str:
    """Return the policy of a page: what is in it may run, by its hash, and nothing else."""

    def hashes(*opening: str) -> str:
        parts = (part for tag in opening for part in text.split(tag)[1:])
        ends = [part.split("</script>")[0].split("</style>")[0].encode() for part in parts]
        digests = (b64encode(hashlib.sha256(part).digest()).decode() for part in ends)
        return " ".join(f"'sha256-{digest}'" for digest in digests)

    scripts, styles = hashes("<script>", '<script class="engine">'), hashes("<style>")
    return (
        f"default-src 'none'; script-src {scripts} blob:; worker-src blob:; "
        f"style-src {styles}; img-src data:; base-uri 'none'; form-action 'none'"
    )


def compute(record: str) -> dict[str, str]:
    """Return the page with the record that it offers."""
    return {"page": page(Path("src/explorer"), {Path(record).stem: read_record(record)})}


if __name__ == "__main__":
    run(snakemake, compute)
