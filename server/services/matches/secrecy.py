"""What stays a secret when a game is over, and until when.

An event's seed: until all its matches are over. Untold noise: until match and event are, for whoever has the record or
the noise seed of a finished game knows the level at which the others are still played.
"""

from typing import Any, Final, Literal

from sqlalchemy import Connection, Row, select

from server.store.tables import matches, tournament_games, tournaments

EVENT_OPEN: Final = ("created", "running", "paused")
MATCH_OPEN: Final = ("challenged", "opening", "running")
ON_THE_TABLE: Final = ("opening", "running")
"""Statuses of a match that is being played, or is about to be."""

Holder = Literal["match", "tournament"]
"""Whose end is waited for."""


def withheld(connection: Connection, match: Row[Any], *, over: bool | None = None) -> Holder | None:
    """Until whose end level, seeds and records of a match's noise are kept back; None: they are given.

    Args:
        connection: to the database.
        match: of `matches`.
        over: whether the match is over, where that is decided and not stored yet.
    """
    if match.noise_told:
        return None
    if not (match.status not in MATCH_OPEN if over is None else over):
        return "match"
    both = tournaments.join(tournament_games, tournament_games.c.tournament_id == tournaments.c.id)
    ours = select(tournaments).select_from(both).where(tournament_games.c.match_id == match.id)
    event = connection.execute(ours).one_or_none()
    return None if event is None or is_event_over(connection, event) else "tournament"


def is_event_over(connection: Connection, event: Row[Any]) -> bool:
    """Whether nothing of an event is played any more: one that ended may have a match that is not called off yet."""
    if event.status in EVENT_OPEN:
        return False
    both = tournament_games.join(matches, matches.c.id == tournament_games.c.match_id)
    left = (tournament_games.c.tournament_id == event.id) & matches.c.status.in_(ON_THE_TABLE)
    return connection.execute(select(matches.c.id).select_from(both).where(left).limit(1)).first() is None
