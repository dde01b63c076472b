"""Errors of tournaments: terms or results that cannot be.

::

    TournamentError (physics.errors.FieldError)
    ├── InvalidSpec     the terms of an event
    └── InvalidResult   a game's result, or one that does not belong to the event
"""

from physics.errors import FieldError


class TournamentError(FieldError):
    """Bad input to a tournament."""


class InvalidSpec(TournamentError):
    """The terms of an event are not complete, contradict each other, or are of a wrong type."""


class InvalidResult(TournamentError):
    """Not a game's result, or not one of this event."""
