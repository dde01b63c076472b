"""What stays a secret when a game is over, and until when.

An event's seed: until all its matches are over. Untold noise: until match and event are, for whoever has the record or
the noise seed of a finished game knows the level at which the others are still played.
"""

from collections.abc import Sequence
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
    return all_withheld(connection, (match,), over=over)[match.id]


def all_withheld(
    connection: Connection, rows: Sequence[Row[Any]], *, over: bool | None = None
) -> dict[str, Holder | None]:
    """The same of several matches, by id."""
    kept: dict[str, Holder | None] = dict.fromkeys(match.id for match in rows if match.noise_told)
    untold = [match for match in rows if not match.noise_told]
    ended = [match.id for match in untold if (match.status not in MATCH_OPEN if over is None else over)]
    kept |= dict.fromkeys((match.id for match in untold if match.id not in ended), "match")
    kept |= dict.fromkeys(ended)
    return kept | dict.fromkeys(_of_open_events(connection, ended), "tournament")


def _of_open_events(connection: Connection, match_ids: Sequence[str]) -> list[str]:
    """Those of the matches that belong to an event which is not over."""
    if not match_ids:
        return []
    ours = select(tournament_games.c.match_id, tournament_games.c.tournament_id)
    found = connection.execute(ours.where(tournament_games.c.match_id.in_(match_ids))).all()
    events = select(tournaments).where(tournaments.c.id.in_({row.tournament_id for row in found}))
    still_open = {event.id for event in connection.execute(events).all() if not is_event_over(connection, event)}
    return [row.match_id for row in found if row.tournament_id in still_open]


def is_event_over(connection: Connection, event: Row[Any]) -> bool:
    """Whether nothing of an event is played any more: one that ended may have a match that is not called off yet."""
    if event.status in EVENT_OPEN:
        return False
    both = tournament_games.join(matches, matches.c.id == tournament_games.c.match_id)
    left = (tournament_games.c.tournament_id == event.id) & matches.c.status.in_(ON_THE_TABLE)
    return connection.execute(select(matches.c.id).select_from(both).where(left).limit(1)).first() is None
