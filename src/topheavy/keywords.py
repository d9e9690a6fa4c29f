"""Errors that name the right keyword where a wrong one was guessed."""

import difflib
import functools
import inspect
from collections.abc import Callable
from typing import Any, TypeVar

Named = TypeVar("Named", bound=Callable[..., Any])

SYNONYMS = {
    **dict.fromkeys(("gamma", "ratio"), "mass_ratio"),
    **dict.fromkeys(("record", "pulse", "motion", "ground_motion"), "excitation"),
    **dict.fromkeys(("dt", "step"), "time_step"),
    "omega": "angular_frequency",
    "resolution": "floor, the narrowest interval that the search cannot miss",
    "ax": "axes",
    **dict.fromkeys(("b", "h"), "half_width and half_height"),
}
"""What the library calls what others call otherwise."""

WHOLE = "Column.of_dimensions(width=…, height=…) takes whole dimensions"
MASSES = "RockingFrame.of_masses(column, cap_mass=…, column_mass=…) takes masses"
LOSS = "structure.block(restitution=…) has another √r, and is accepted like the structure"
ELSEWHERE = {
    **dict.fromkeys(("width", "height"), WHOLE),
    **dict.fromkeys(("cap_mass", "column_mass", "mass"), MASSES),
    **dict.fromkeys(("restitution", "r", "eta"), LOSS),
    "period": "angular_frequency is 2π over it, in rad/s",
    "frequency": "angular_frequency is 2π times it, in rad/s",
    **dict.fromkeys(("scale", "factor"), "excitation.scaled(factor) scales a pulse or record"),
    **dict.fromkeys(("pga", "pgv"), "record.scaled_to(pga=…) or (pgv=…) scales a record"),
}
"""What has a way of its own."""


def hinted(named: Named) -> Named:
    """Let a function, or the construction of a class, say what a wrong keyword should be.

    Raises
    ------
    TypeError
        When it is called: naming the keyword, and the one that was meant or all that there are.
    """
    begun: Callable[..., Any] = vars(named)["__init__"] if isinstance(named, type) else named
    names = [name for name in inspect.signature(begun).parameters if name != "self"]

    @functools.wraps(begun)
    def checked(*args: Any, **keywords: Any) -> Any:
        for name in keywords:
            if name not in names:
                raise TypeError(f"{named.__name__} has no argument {name!r}; {_meant(name, names)}")
        return begun(*args, **keywords)

    if isinstance(named, type):
        setattr(named, "__init__", checked)  # noqa: B010 (mypy refuses the assignment)
        return named
    return checked  # type: ignore[return-value]


def _meant(name: str, names: list[str]) -> str:
    synonym = SYNONYMS.get(name, "")
    if synonym and synonym.replace(",", "").split()[0] in names:
        return f"it is called {synonym}"
    if name in ELSEWHERE:
        return ELSEWHERE[name]
    close = difflib.get_close_matches(name.lower(), names, n=1)
    return f"did you mean {close[0]!r}?" if close else f"expected {', '.join(names)}"
