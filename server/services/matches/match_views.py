"""Matches and games as lists and single answers show them."""

import json
from collections.abc import Sequence
from functools import lru_cache
from itertools import groupby
from typing import Any, Final

from sqlalchemy import Connection, Row, Text, cast, select

from physics import Table
from protocol import ClockTerms, GameSummary, MatchView, OutcomeView, Position, RackView
from protocol.values import trusted
from referee.game import Outcome
from referee.play.clock import SECOND_NS
from server.services.matches.secrecy import Holder, all_withheld
from server.services.play.agent_messages import winner_of
from server.services.play.live_game import FINISHED, RUNNING, noise_view, points
from server.services.runtime.time import date_time
from server.store.prepared import PreparedForIds
from server.store.rows import GameRow
from server.store.tables import agents, games, matches

_SUMMED: Final = PreparedForIds(
    select(
        *(games.c.id, games.c.match_id, games.c.number, games.c.status, games.c.winner, games.c.breaker),
        *(games.c.commitment, games.c.noise_seed, games.c.started_at, games.c.ended_at),
        games.c.state["stroke"].as_integer().label("strokes"),
        games.c.state["outcome"].label("outcome"),
    ).order_by(games.c.match_id, games.c.number),
    games.c.match_id,
)
"""What a summary needs of a game's row: the balls, and the much longer lines of its record, are not read for a list."""
_LISTED: Final = PreparedForIds(
    select(*(column for column in matches.c if column.name != "table"), cast(matches.c.table, Text).label("table")),
    matches.c.id,
)
"""A match whose table is still the text that it is stored as: it was read before, with all its parameters."""
_NAMES: Final = PreparedForIds(select(agents.c.id, agents.c.name), agents.c.id)
TABLES: Final = 64
"""Tables that are remembered with all their parameters: most matches are played on a few."""


def view(connection: Connection, match: Row[Any]) -> MatchView:
    """A match with its games."""
    return views(connection, (match,))[0]


def rows(connection: Connection, ids: Sequence[str]) -> Sequence[Row[Any]]:
    """The matches with these ids, in their order, for `views`."""
    found = {row.id: row for row in _LISTED.all(connection, ids)}
    return [found[each] for each in ids]


def views(connection: Connection, shown: Sequence[Row[Any]]) -> tuple[MatchView, ...]:
    """Matches with their games, read together. The rows were validated when they were written."""
    found = _SUMMED.all(connection, [match.id for match in shown])
    played = {match_id: tuple(ours) for match_id, ours in groupby(found, lambda row: str(row.match_id))}
    names = _names(connection, shown)
    until = all_withheld(connection, shown)
    return tuple(_view(match, played.get(match.id, ()), names, until[match.id]) for match in shown)


def _view(match: Row[Any], played: Sequence[Row[Any]], names: dict[str, str], until: Holder | None) -> MatchView:
    score = points(game.winner for game in played if game.status == FINISHED)
    return trusted(
        MatchView,
        id=match.id,
        status=match.status,
        agents=(match.seat_0, match.seat_1),
        players=(names[match.seat_0], names[match.seat_1]),
        games=match.games,
        rules=match.rules,
        table=_table(match.table if isinstance(match.table, str) else json.dumps(match.table)),
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
        played=tuple(trusted(GameSummary, **_summary(game, game.strokes, game.outcome, until)) for game in played),
        start=None if match.start is None else Position.model_validate(match.start),
        rated=match.rated,
        foreseeable=match.foreseeable,
        created_at=date_time(match.created_at),
    )


def summary(row: GameRow, until: Holder | None) -> dict[str, Any]:
    """The fields of a `GameSummary`; the noise seed is there once the game is over, unless noise is `withheld`."""
    return _summary(row, row.state["stroke"], row.state["outcome"], until)


def _summary(
    row: GameRow | Row[Any], strokes: int, outcome: dict[str, Any] | None, until: Holder | None
) -> dict[str, Any]:
    return {
        "id": row.id,
        "match": row.match_id,
        "number": row.number,
        "status": row.status,
        "breaker": row.breaker,
        "commitment": row.commitment,
        "noise_seed": None if row.status == RUNNING or until is not None else row.noise_seed,
        "strokes": strokes,
        "outcome": None if outcome is None else OutcomeView.of(Outcome.from_dict(outcome)),
        "started_at": date_time(row.started_at),
        "finished_at": None if row.ended_at is None else date_time(row.ended_at),
    }


def _names(connection: Connection, shown: Sequence[Row[Any]]) -> dict[str, str]:
    """The names of the matches' agents, by id."""
    wanted = {seat for match in shown for seat in (match.seat_0, match.seat_1)}
    return {row.id: row.name for row in _NAMES.all(connection, sorted(wanted))}


@lru_cache(TABLES)
def _table(values: str) -> dict[str, str | bool | float]:
    """A stored table with every parameter: those that an earlier version did not know among them."""
    return Table.from_dict(json.loads(values)).to_dict()
