"""Matches and games as lists and single answers show them."""

from typing import Any, Final

from sqlalchemy import Connection, Row, Select, select

from protocol import ClockTerms, GameSummary, MatchView, OutcomeView, Position, RackView
from referee.game import Outcome
from referee.play.clock import SECOND_NS
from server.services.matches.secrecy import Holder, withheld
from server.services.play.agent_messages import winner_of
from server.services.play.live_game import RUNNING, noise_view, player_names, score_of
from server.services.runtime.time import date_time
from server.store.rows import GameRow
from server.store.tables import games

_SUMMED: Final[Select[Any]] = select(
    *(games.c.id, games.c.match_id, games.c.number, games.c.status, games.c.breaker, games.c.commitment),
    *(games.c.noise_seed, games.c.state, games.c.started_at, games.c.ended_at),
).order_by(games.c.number)
"""What a summary needs of a game's row: the lines of its record, which are much longer, are not read for a list."""


def view(connection: Connection, match: Row[Any]) -> MatchView:
    """A match with its games."""
    score = score_of(connection, match.id)
    played = connection.execute(_SUMMED.where(games.c.match_id == match.id))
    until = withheld(connection, match)
    return MatchView(
        id=match.id,
        status=match.status,
        agents=(match.seat_0, match.seat_1),
        players=player_names(connection, match),
        games=match.games,
        rules=match.rules,
        table=match.table,
        noise=noise_view(match, until),
        clock=ClockTerms(seconds=match.allowance / SECOND_NS, simulations=match.simulations),
        challenger=None if match.challenger is None else int(match.challenger == match.seat_1),
        commitment=match.commitment,
        client_seeds=(match.client_seed_0, match.client_seed_1),
        client_seed_seconds=match.opening / SECOND_NS,
        racks=RackView(shared=match.rack_seed is not None, paired=match.paired_racks),
        first_breaker=match.first_breaker,
        score=score,
        winner=winner_of(match.status, score),
        played=tuple(GameSummary(**summary(row, until)) for row in played),
        start=None if match.start is None else Position.model_validate(match.start),
        rated=match.rated,
        foreseeable=match.foreseeable,
        created_at=date_time(match.created_at),
    )


def summary(row: GameRow | Row[Any], until: Holder | None) -> dict[str, Any]:
    """The fields of a `GameSummary`; the noise seed is there once the game is over, unless noise is `withheld`."""
    outcome = row.state["outcome"]
    return {
        "id": row.id,
        "match": row.match_id,
        "number": row.number,
        "status": row.status,
        "breaker": row.breaker,
        "commitment": row.commitment,
        "noise_seed": None if row.status == RUNNING or until is not None else row.noise_seed,
        "strokes": row.state["stroke"],
        "outcome": None if outcome is None else OutcomeView.of(Outcome.from_dict(outcome)),
        "started_at": date_time(row.started_at),
        "finished_at": None if row.ended_at is None else date_time(row.ended_at),
    }
