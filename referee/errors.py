"""Errors of the referee: misuse raises, a foul never does.

::

    RefereeError (ValueError)
    ├── InvalidAction   not a stroke or a decision, or one that this game does not await
    ├── InvalidGame     a game's data that cannot be
    └── BudgetSpent     no simulated shots left (referee.play.budget)
"""

from typing import Any


class RefereeError(ValueError):
    """Bad input to the referee.

    Attributes:
        field: name of the offending part, e.g. ``"call.pocket"``.
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


class InvalidAction(RefereeError):
    """Not a well-formed action, or an action given to ``apply`` that the game does not await."""


class InvalidGame(RefereeError):
    """Game data (from a file, from the wire) that does not describe a game."""
