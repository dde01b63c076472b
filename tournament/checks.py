"""Checks that data from files and from the wire pass through: each returns the value or names what is wrong."""

from collections.abc import Collection, Mapping
from enum import StrEnum
from typing import Any, NoReturn, TypeVar

from tournament.errors import TournamentError

E = TypeVar("E", bound=StrEnum)

NAME_LENGTH = 64
"""Letters in the name of an entrant or an event: more would break every table it stands in."""


class Checker:
    """Checks that raise one kind of error.

    Args:
        error: what to raise.
    """

    def __init__(self, error: type[TournamentError]) -> None:
        self._error = error

    def fail(self, field: str, value: Any, allowed: str) -> NoReturn:
        """Raise the error."""
        raise self._error(field, value, allowed)

    def integer(self, field: str, value: Any, low: int, high: int) -> int:
        """An integer in [low, high]; True is none."""
        if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
            self.fail(field, value, f"an integer in [{low}, {high}]")
        return value

    def number(self, field: str, value: Any, low: float, high: float) -> float:
        """A finite number in [low, high]."""
        number = isinstance(value, int | float) and not isinstance(value, bool)
        if not number or not low <= value <= high:  # NaN is in no interval
            self.fail(field, value, f"a number in [{low:g}, {high:g}]")
        return float(value)

    def flag(self, field: str, value: Any) -> bool:
        """True or False."""
        if not isinstance(value, bool):
            self.fail(field, value, "true or false")
        return value

    def name(self, field: str, value: Any) -> str:
        """Visible text of 1 to 64 letters, no control characters, no space at its ends."""
        if not isinstance(value, str) or not 1 <= len(value) <= NAME_LENGTH:
            self.fail(field, value, f"a text of 1 to {NAME_LENGTH} letters")
        if not value.isprintable() or value != value.strip():
            self.fail(field, value, "printable letters, no space at the ends")
        return value

    def text(self, field: str, value: Any, longest: int) -> str:
        """Any text of at most ``longest`` letters."""
        if not isinstance(value, str) or len(value) > longest:
            self.fail(
                field, value if not isinstance(value, str) else f"{len(value)} letters", f"at most {longest} letters"
            )
        return value

    def member(self, kind: type[E], field: str, value: Any) -> E:
        """A member of an enumeration, or its value."""
        try:
            return kind(value)
        except ValueError:
            self.fail(field, value, f"one of {', '.join(kind)}")

    def items(self, field: str, value: Any, low: int, high: int) -> tuple[Any, ...]:
        """A list or tuple of so many things."""
        if not isinstance(value, list | tuple) or not low <= len(value) <= high:
            self.fail(field, value, f"a list of {low} to {high}")
        return tuple(value)

    def object(self, field: str, value: Any, known: Collection[str], needed: Collection[str] = ()) -> dict[str, Any]:
        """A mapping with the needed keys and no unknown one."""
        if not isinstance(value, Mapping):
            self.fail(field, value, "an object (a table)")
        unknown, missing = sorted(map(str, set(value) - set(known))), sorted(set(needed) - set(value))
        if unknown:
            self.fail(field, unknown, f"only the keys {', '.join(sorted(known))}")
        if missing:
            self.fail(field, sorted(map(str, value)), f"the keys {', '.join(missing)} as well")
        return dict(value)
