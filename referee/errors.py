"""Errors of the referee: misuse raises, a foul never does.

::

    RefereeError (physics.errors.FieldError)
    ├── InvalidAction   not a stroke or a decision, or one that this game does not await
    ├── InvalidGame     a game's data that cannot be
    └── BudgetSpent     no simulated shots left (referee.play.budget)
"""

from physics.errors import FieldError


class RefereeError(FieldError):
    """Bad input to the referee."""


class InvalidAction(RefereeError):
    """Not a well-formed action, or an action given to ``apply`` that the game does not await."""


class InvalidGame(RefereeError):
    """Game data (from a file, from the wire) that does not describe a game."""
