"""Events as lists, single answers and standings show them. Secrets stay until the event is over."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any, Final

from pydantic_core import from_json
from sqlalchemy import Connection, Row, Text, cast, select

from protocol import (
    EntriesPage,
    EntryView,
    NumberedEntry,
    OutcomeView,
    RatingView,
    SequentialTestView,
    StandingsView,
    StandingView,
    TournamentGame,
    TournamentSummary,
    TournamentView,
)
from protocol.values import trusted
from referee.game import Outcome
from server.services.matches.secrecy import is_event_over
from server.services.runtime.context import Context
from server.services.runtime.time import date_time
from server.services.tournaments import progress
from server.services.tournaments.tournament_cache import TournamentState
from server.store.tables import tournament_games, tournaments
from tournament import GameResult, Pair
from tournament.ledger import Ledger

SUMMED: Final = (
    *(column for column in tournaments.c if column.name not in ("agents", "terms")),
    cast(tournaments.c.terms, Text).label("terms"),
)
"""What `summary` needs; the terms are still the text that they are stored as."""

Key = tuple[str, int, int]
"""Pair, leg and attempt of a game."""


def view(context: Context, connection: Connection, row: Row[Any]) -> TournamentView:
    """An event with its games and decisions."""
    return view_of(connection, row, progress.course(context, connection, row))


def view_of(connection: Connection, row: Row[Any], course: TournamentState) -> TournamentView:
    """The same when it is known how the event stands."""
    ledger = course.ledger
    spec, over = ledger.event.spec, is_event_over(connection, row)
    return TournamentView(
        **_summary(row),
        terms=spec.revealed() if over else spec.published(),
        agents=row.agents,
        played=tuple(_games(connection, row, ledger, spec.noise.told or over)),
        log=tuple(_entry(each) for each in progress.decisions(connection, row.id)),
    )


def entries_page(rows: Sequence[Row[Any]], limit: int, lots: str | None) -> EntriesPage:
    """Entries as a page; one more than the page holds says that there are more."""
    given = tuple(NumberedEntry(number=each.sequence, **_noted(each)) for each in rows[:limit])
    more = str(given[-1].number) if len(rows) > limit else None
    return EntriesPage(entries=given, next_cursor=more, lots=lots)


def summary(row: Row[Any]) -> TournamentSummary:
    """An event in a list, from `SUMMED`. The row was validated when it was written."""
    return trusted(TournamentSummary, **_summary(row))


def standings_view(context: Context, connection: Connection, row: Row[Any]) -> StandingsView:
    """How the entrants stand; nobody is rated where the dice could be foreseen."""
    course = progress.course(context, connection, row)
    test = course.ledger.event.test
    ratings = () if course.ledger.event.spec.foreseeable else course.ratings
    return StandingsView(
        tournament=row.id,
        status=row.status,
        standings=tuple(StandingView(**line.to_dict(), agent=row.agents[line.name]) for line in course.standings),
        ratings=tuple(
            RatingView(**{key: getattr(rating, key) for key in RatingView.model_fields}) for rating in ratings
        ),
        test=None if test is None else SequentialTestView(**asdict(test)),
    )


def _summary(row: Row[Any]) -> dict[str, Any]:
    terms = from_json(row.terms) if isinstance(row.terms, str) else row.terms
    return {
        "id": row.id,
        "name": row.name,
        "status": row.status,
        "format": terms["format"],
        "foreseeable": terms.get("lots") is None,
        "entrants": tuple(entrant["name"] for entrant in terms["entrants"]),
        "games": row.games,
        "due": row.due,
        "created_at": date_time(row.created_at),
        "started_at": None if row.started_at is None else date_time(row.started_at),
        "ended_at": None if row.ended_at is None else date_time(row.ended_at),
    }


def _entry(entry: Row[Any]) -> EntryView:
    return EntryView(**_noted(entry))


def _noted(entry: Row[Any]) -> dict[str, Any]:
    return {"at": date_time(entry.created_at), "kind": entry.kind, "by": entry.by, "fields": entry.fields}


def _games(connection: Connection, row: Row[Any], ledger: Ledger, told: bool) -> list[TournamentGame]:
    """Every game that was begun or forfeit, in the order of pairs."""
    ours = select(tournament_games).where(tournament_games.c.tournament_id == row.id)
    made: dict[Key, str] = {(one.pair, one.leg, one.attempt): one.match_id for one in connection.execute(ours)}
    results: dict[Key, GameResult] = {(one.pair, one.leg, one.attempt): one for one in ledger.event.results}
    pairs = {pair.id: pair for pair in ledger.event.plan.pairs}
    known = [key for key in made.keys() | results.keys() if key[0] in pairs]
    return [
        _game(pairs[key[0]], key, made.get(key), results.get(key), told)
        for key in sorted(known, key=lambda key: (pairs[key[0]].number, *key[1:]))
    ]


def _game(pair: Pair, key: Key, match: str | None, result: GameResult | None, told: bool) -> TournamentGame:
    _, leg, attempt = key
    outcome = None if result is None else OutcomeView.of(Outcome(result.winner, result.reason, result.rule))
    return TournamentGame(
        pair=pair.id,
        leg=leg,
        attempt=attempt,
        round=pair.round,
        players=pair.players,
        breaker=pair.breaker(leg),
        noise=pair.noise if told else None,
        match=match,
        status=_status(result),
        outcome=outcome,
        simulated=None if result is None else result.simulated,
    )


def _status(result: GameResult | None) -> Any:
    if result is None:
        return "running"
    if result.void:
        return "void"
    return "finished" if result.counts else "aborted"
