"""The first difference between what a record says and what really follows from its seeds and actions."""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

Path = tuple[str | int, ...]

_MISSING = "(missing)"
_BALL_MAPS = ("before", "final", "state")
"""Fields whose keys are ball numbers."""


@dataclass(frozen=True, slots=True)
class Difference:
    """Where a record departs from the truth.

    Attributes:
        line: of the record, from 1.
        stroke: index of the stroke; None in the header, in a decision and at the end.
        event: ordinal of the event; None outside the events.
        ball: whose field it is; None if no ball's.
        field: dotted path within the line.
        recorded: what the record says. derived: what follows.
    """

    line: int
    stroke: int | None
    event: int | None
    ball: int | None
    field: str
    recorded: Any
    derived: Any

    def __str__(self) -> str:
        named = (("stroke", self.stroke), ("event", self.event), ("ball", self.ball))
        places = [f"{name} {value}" for name, value in named if value is not None]
        where = ", ".join([f"line {self.line}", *places, self.field])
        return f"{where}: the record says {self.recorded!r}, but {self.derived!r} follows"


def first_difference(
    recorded: Mapping[str, Any], derived: Mapping[str, Any], line: int, stroke: int | None = None
) -> Difference | None:
    """The first place, in the derived object's order, where the two differ; None if they agree exactly.

    Numbers are compared by value without tolerance, so 3 and 3.0 agree and nothing else does.
    """
    found = _differ(recorded, derived, ())
    if found is None:
        return None
    path, left, right = found
    return Difference(line, stroke, _event(path), _ball(path, recorded, derived), _dotted(path), left, right)


def _differ(recorded: Any, derived: Any, path: Path) -> tuple[Path, Any, Any] | None:
    """The path to the first difference with both values."""
    if isinstance(recorded, dict) and isinstance(derived, dict):
        keys = [*derived, *(key for key in recorded if key not in derived)]
        pairs = [(key, recorded.get(key, _MISSING), derived.get(key, _MISSING)) for key in keys]
        return _first(pairs, path)
    if isinstance(recorded, list) and isinstance(derived, list):
        longest = max(len(recorded), len(derived))
        padded = [[*values, *[_MISSING] * (longest - len(values))] for values in (recorded, derived)]
        return _first([(i, left, right) for i, (left, right) in enumerate(zip(*padded, strict=True))], path)
    same_kind = isinstance(recorded, bool) == isinstance(derived, bool)
    return None if same_kind and recorded == derived else (path, recorded, derived)


def _first(pairs: list[tuple[Any, Any, Any]], path: Path) -> tuple[Path, Any, Any] | None:
    for key, left, right in pairs:
        if found := _differ(left, right, (*path, key)):
            return found
    return None


def _event(path: Path) -> int | None:
    return int(path[1]) if len(path) > 1 and path[0] == "events" else None


def _ball(path: Path, recorded: Mapping[str, Any], derived: Mapping[str, Any]) -> int | None:
    """The ball a path leads to: a key among positions, or the ball of an event or of a state in it."""
    for step, key in pairwise(path):
        if step in _BALL_MAPS and isinstance(key, str) and key.isdecimal():
            return int(key)
    if _event(path) is None:
        return None
    for values in (derived, recorded):
        ball = _ball_of_event(values, path)
        if ball is not None:
            return ball
    return None


def _ball_of_event(values: Mapping[str, Any], path: Path) -> int | None:
    """The number under ``ball`` nearest above the path's end."""
    found = None
    node: Any = values
    for step in path:
        try:
            node = node[step]
        except (KeyError, IndexError, TypeError):
            break
        if isinstance(node, dict) and isinstance(node.get("ball"), int):
            found = node["ball"]
    return found


def _dotted(path: Path) -> str:
    text = "".join(f"[{step}]" if isinstance(step, int) else f".{step}" for step in path)
    return text.lstrip(".") or "(whole line)"
