"""Errors of tournaments: terms or results that cannot be.

::

    TournamentError (ValueError)
    ├── InvalidSpec     the terms of an event
    └── InvalidResult   a game's result, or one that does not belong to the event
"""

from typing import Any


class TournamentError(ValueError):
    """Bad input to a tournament.

    Attributes:
        field: name of the offending part, e.g. ``"noise.levels"``.
        value: what came.
        allowed: what is allowed, in words.
    """

    def __init__(self, field: str, value: Any, allowed: str) -> None:
        super().__init__(f"{field} = {value!r}: {allowed}")
        self.field = field
        self.value = value
        self.allowed = allowed

    def __reduce__(self) -> tuple[type, tuple[str, Any, str]]:
        """Pickle by the three arguments, so that the error crosses process borders."""
        return type(self), (self.field, self.value, self.allowed)


class InvalidSpec(TournamentError):
    """The terms of an event are not complete, contradict each other, or are of a wrong type."""


class InvalidResult(TournamentError):
    """Not a game's result, or not one of this event."""
