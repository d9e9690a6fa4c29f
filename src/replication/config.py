"""Read YAML and configs: types of their keys, and what is said of a mistake."""

import re
from difflib import get_close_matches
from itertools import pairwise
from pathlib import Path
from typing import Annotated, Any, Literal, TypeVar

import yaml
from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Field,
    ValidationError,
    ValidationInfo,
    create_model,
    model_validator,
)

Entry = TypeVar("Entry")


def _rising(numbers: list) -> list:
    if any(high <= low for low, high in pairwise(numbers)):
        raise ValueError("expected numbers that rise")
    return numbers


def _structure(name: str, about: ValidationInfo) -> str:
    if name not in (names := [*map(str, about.context or ())]):
        raise ValueError(f"expected a name of `structures`: {', '.join(names)}")
    return name


Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(gt=0, strict=True, allow_inf_nan=False)]
NotNegative = Annotated[float, Field(ge=0, strict=True, allow_inf_nan=False)]
MassRatio = Annotated[float, Field(ge=0, strict=True)]  # γ; .inf is a frame with γ → ∞
Fraction = Annotated[float, Field(gt=0, le=1, strict=True)]
Tolerance = Annotated[float, Field(gt=0, le=0.01, strict=True)]
Duration = Annotated[float, Field(gt=0, le=1000, strict=True)]  # s
Count = Annotated[int, Field(ge=1, le=10_000, strict=True)]
Seed = Annotated[int, Field(ge=0, strict=True)]
Degrees = Annotated[float, Field(ge=1, le=60, strict=True)]  # at least 1: no radians
Shape = Literal[
    "one-sine", "one-cosine", "half-sine", "constant", "ricker-symmetric", "ricker-antisymmetric"
]
StructureName = Annotated[str, AfterValidator(_structure)]
Items = Annotated[list[Entry], Field(min_length=1)]
Pair = Annotated[list[Positive], Field(min_length=2, max_length=2)]
Range = Annotated[list[Entry], Field(min_length=2, max_length=2), AfterValidator(_rising)]


class Section(BaseModel):
    """A part of a config: a key that is not named in its model is an error."""

    model_config = ConfigDict(extra="forbid")


def section(base: type[Section] = Section, /, **types: Any) -> Any:
    """Return the model of a section from the types of its entries."""
    return create_model("Section", __base__=base, **{name: (of, ...) for name, of in types.items()})


class Span(Section):
    """A range."""

    lowest: Positive
    highest: Positive

    @model_validator(mode="after")
    def ordered(self) -> "Span":
        if self.highest <= self.lowest:
            raise ValueError(
                f"highest is {self.highest:g}; expected more than lowest, {self.lowest:g}"
            )
        return self


class Grid(Span):
    """A range with so many points."""

    points: Annotated[int, Field(ge=2, le=1000, strict=True)]


class PulseOf(Section):
    """A pulse: acceleration amplitude in g, period 2π/ω in s."""

    shape: Shape
    amplitude: Positive
    period: Positive


VERTICAL = re.compile(
    r"([-_. ](UP|DN|DOWN|DWN|UD|V|VRT|VER|VERT|Z)|[BEHS][HLN]Z)\.(AT2|CSV)$", re.IGNORECASE
)
"""How the name of a vertical component ends, by the habits of PEER, ESM, K-NET and others."""


def components(folder: str) -> tuple[list[str], list[str]]:
    """Return the records in a folder that count as horizontal, and those that are vertical."""
    names = sorted(map(str, Path(folder).iterdir()))
    records = [name for name in names if name.lower().endswith((".at2", ".csv"))]
    vertical = [name for name in records if VERTICAL.search(name)]
    return [name for name in records if name not in vertical], vertical


class _Once(yaml.SafeLoader):
    """A loader that refuses a doubled key."""

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        keys = [key.value for key, _ in node.value]
        for key in keys:
            if keys.count(key) > 1:
                line = max(k.start_mark.line for k, _ in node.value if k.value == key) + 1
                raise SystemExit(f"{node.start_mark.name}:{line}: the key '{key}' is there twice")
        return super().construct_mapping(node, deep)


def read_yaml(path: str | Path) -> Any:
    """Return the content of a YAML file; a doubled key or another mistake ends the program."""
    try:
        with Path(path).open(encoding="utf-8") as file:
            return yaml.load(file, _Once)
    except FileNotFoundError:
        raise SystemExit(f"there is no file {path}") from None
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise SystemExit(f"{path}: {' '.join(str(error).split())}") from None


def read_config(path: str, model: type[Section], content: Any = None) -> dict[str, Any]:
    """Return a checked config; a mistake ends the program with file, key, value and expectation."""
    content = read_yaml(path) if content is None else content
    names = content.get("structures") if isinstance(content, dict) else ()
    try:
        return model.model_validate(content, context=names).model_dump()
    except ValidationError as errors:
        raise SystemExit(
            "\n".join(f"{path}: {_message(e, model)}" for e in errors.errors())
        ) from None


def _message(error: Any, model: type[Section]) -> str:
    key = ".".join(str(part) for part in error["loc"])
    if error["type"] == "extra_forbidden":
        near = get_close_matches(str(error["loc"][-1]), names_of(model), n=1)
        return f"unknown key '{key}'" + (f"; did you mean '{near[0]}'?" if near else "; remove it")
    if error["type"] == "invalid_key":
        where, _, name = key.rpartition(".")
        return f"{where} has the key {name}; expected a name. A number has a point: 3.00, not 3,00"
    if error["type"] == "missing":
        return f"the key '{key}' is missing"
    entry, expected = error["input"], error["msg"].removeprefix("Value error, ")
    if not key:  # of the sections together
        return expected
    comma = ""
    if (
        isinstance(entry, str)
        and entry.replace(",", "", 1).replace(".", "", 1).strip("+-").isdigit()
    ):
        comma = ": a decimal point, and no quotes" if "," in entry else ": without quotes"
    return f"{key} is {entry!r}; {expected[0].lower()}{expected[1:]}{comma}"


def names_of(model: type[BaseModel]) -> list[str]:
    """Return the keys of a model and of the models inside it."""
    names = []
    for name, field in model.model_fields.items():
        names.append(name)
        inner = [field.annotation, *getattr(field.annotation, "__args__", ())]
        for each in inner:
            if isinstance(each, type) and issubclass(each, BaseModel):
                names += names_of(each)
    return names
