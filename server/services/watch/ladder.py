"""The ladder: ratings of agents from the newest rated games."""

from typing import Final

from sqlalchemy import Connection, select

from protocol import Ladder, RungView
from referee.game import EndReason
from referee.play.clock import SECOND_NS
from server.services.runtime.context import Context
from server.services.watch.ladder_cache import KeptLadder
from server.services.watch.spectator_events import agents_here
from server.store.tables import agents, games, matches
from tournament.results import GameResult
from tournament.statistics.ladder import ladder

MOST_GAMES: Final = 2000
"""Games that count: the newest."""
MOST_RUNGS: Final = 200
GOOD_FOR: Final = 10 * SECOND_NS
"""Nanoseconds for which a ladder is given again: 2,000 games take some seconds to compute."""


def read(context: Context) -> Ladder:
    """The ladder, up to some seconds old, and who is there now."""
    kept = context.ladder
    with context.database.reading() as connection:
        if context.time.now() >= kept.until and kept.lock.acquire(blocking=kept.until == 0):
            try:
                _renew(context, kept, connection)
            finally:
                kept.lock.release()
        shown = kept.rungs[:MOST_RUNGS]
        here = agents_here(context, connection)
        rows = connection.execute(select(agents).where(agents.c.id.in_([one.name for one in shown]))).all()
    known = {row.id: row for row in rows}
    rungs = [
        RungView(
            agent=one.name,
            name=known[one.name].name,
            house=known[one.name].house,
            rank=rank,
            mu=one.mu,
            sigma=one.sigma,
            ordinal=one.ordinal,
            games=one.games,
            present=one.name in here,
        )
        for rank, one in enumerate(shown, 1)
    ]
    return Ladder(rungs=tuple(rungs), games=kept.games)


def _renew(context: Context, kept: KeptLadder, connection: Connection) -> None:
    if context.time.now() < kept.until:
        return
    played = _newest(connection)
    kept.rungs, kept.games = ladder(played), len(played)
    kept.until = context.time.now() + GOOD_FOR


def _newest(connection: Connection) -> list[GameResult]:
    """The newest rated games with a result, the oldest of them first; players by their ids."""
    reason = games.c.state["outcome"]["reason"].as_string()
    query = (
        select(games.c.match_id, games.c.number, games.c.breaker, games.c.winner, matches.c.seat_0, matches.c.seat_1)
        .add_columns(reason.label("reason"))
        .join(matches, games.c.match_id == matches.c.id)
        .where(matches.c.rated, games.c.status == "finished", reason != EndReason.ABORTED.value)
        .order_by(games.c.ended_at.desc(), games.c.id.desc())
        .limit(MOST_GAMES)
    )
    rows = connection.execute(query).all()
    return [
        GameResult(
            pair=row.match_id,
            leg=row.number % 2,
            players=(row.seat_0, row.seat_1),
            breaker=row.breaker,
            winner=row.winner,
            reason=EndReason(row.reason),
        )
        for row in reversed(rows)
    ]
