"""The course of an event: entries are noted, matches begin, their results become entries, until nothing is due.

Everything here that writes runs in the transaction of whatever caused it.
"""

from typing import Any, Final, get_args

from sqlalchemy import ColumnElement, Connection, Row, insert, select, update

from protocol import ClockTerms, MatchRequest, NoiseTerms, TournamentStatus
from protocol.matches import RackTerms
from referee.play.clock import MOST_SECONDS
from referee.record import read_record
from server.errors import NotFound
from server.services.matches.matches import insert_match
from server.services.matches.player_seeds import begin_or_wait
from server.services.matches.secrecy import EVENT_OPEN, ON_THE_TABLE
from server.services.play import history
from server.services.runtime.context import Context, Writing
from server.services.tournaments.tournament_cache import TournamentState
from server.store.locks import only_one
from server.store.rows import GameRow
from server.store.tables import games, matches, tournament_entries, tournament_games, tournaments
from tournament import Due, Spec, Tournament
from tournament.from_record import called_off, result_of
from tournament.ledger import Act, Ledger
from tournament.seeds import match_seed

STATUSES: Final[tuple[str, ...]] = get_args(TournamentStatus)
OPEN: Final = EVENT_OPEN
SEED_SECONDS: Final = 5.0
"""How long a match of an event waits for the seeds of its players."""
RESULT: Final = "game"
"""The kind of a result's entry."""
SERVER: Final = "server"
"""Who notes results."""


def find(connection: Connection, tournament_id: str) -> Row[Any]:
    """The event with this id; raises `NotFound`."""
    row = connection.execute(select(tournaments).where(tournaments.c.id == tournament_id)).one_or_none()
    if row is None:
        raise NotFound(f"there is no tournament {tournament_id}")
    return row


def hold(connection: Connection, tournament_id: str) -> Row[Any]:
    """The same, to be written by this transaction alone."""
    only_one(connection, f"tournament {tournament_id}")
    return find(connection, tournament_id)


def course(context: Context, connection: Connection, row: Row[Any]) -> TournamentState:
    """How the event stands, for who only reads."""
    found = _course(context.courses.get(row.id), connection, row)
    context.courses.keep({row.id: found})
    return found


def course_here(writing: Writing, row: Row[Any]) -> TournamentState:
    """How the event stands in this transaction, which holds it."""
    known = writing.courses.get(row.id) or writing.context.courses.get(row.id)
    writing.courses[row.id] = _course(known, writing.connection, row)
    return writing.courses[row.id]


def decisions(connection: Connection, tournament_id: str) -> list[Row[Any]]:
    """What was noted but results, in order."""
    return _entries(connection, tournament_id, tournament_entries.c.kind != RESULT)


def entries_after(connection: Connection, tournament_id: str, sequence: int, limit: int) -> list[Row[Any]]:
    """Results and decisions after the entry with this number, in order, ``limit`` at most."""
    return _entries(connection, tournament_id, tournament_entries.c.sequence > sequence, limit)


def note(writing: Writing, row: Row[Any], kind: str, by: str, fields: dict[str, Any]) -> None:
    """Add an entry."""
    before = course_here(writing, row)
    values = {"tournament_id": row.id, "kind": kind, "by": by, "fields": fields, "created_at": writing.now}
    made = writing.connection.execute(insert(tournament_entries).values(values)).inserted_primary_key
    assert made is not None
    writing.courses[row.id] = TournamentState(made[0], before.ledger.after([Act(kind, fields)]))


def go_on(writing: Writing, row: Row[Any]) -> Row[Any]:
    """Give out what is due and bring the event's row up to date; the row as it is then."""
    ledger = course_here(writing, row).ledger
    status = ledger.state if ledger.begun or ledger.over else "created"
    counts = {"games": len(ledger.event.counted), "due": len(ledger.event.due)}
    values: dict[str, Any] = {"status": status, **counts}
    if status == "running":
        values["started_at"] = row.started_at or writing.now
        _give_out(writing, row, ledger)
    elif status not in OPEN:
        values["ended_at"] = writing.now
    writing.connection.execute(update(tournaments).where(tournaments.c.id == row.id).values(values))
    return find(writing.connection, row.id)


def match_over(writing: Writing, match_id: str) -> None:
    """Note a match's result if it is a game of an event, and go on with that."""
    this = tournament_games.c.match_id == match_id
    mine = writing.connection.execute(select(tournament_games).where(this)).one_or_none()
    if mine is None:
        return
    row = hold(writing.connection, mine.tournament_id)
    if row.status not in OPEN:
        return
    pairs = course_here(writing, row).ledger.event.plan.pairs
    pair = next((pair for pair in pairs if pair.id == mine.pair), None)  # None: it has left the plan meanwhile
    if pair is not None:
        result = _result(writing.connection, match_id, Due(pair, mine.leg, mine.attempt))
        note(writing, row, RESULT, SERVER, {"result": result})
    go_on(writing, row)


def stray_matches(context: Context, tournament_id: str) -> list[str]:
    """Running matches whose games are no longer due: of an event that was aborted, of an entrant who is out."""
    with context.database.reading() as connection:
        row = find(connection, tournament_id)
        ledger = course(context, connection, row).ledger
        due = set() if ledger.aborted else {(one.pair.id, one.leg, one.attempt) for one in ledger.event.due}
        running = running_games(connection, tournament_id)
    return [str(game.match_id) for game in running if (game.pair, game.leg, game.attempt) not in due]


def running_games(connection: Connection, tournament_id: str) -> list[Row[Any]]:
    """The games of the event whose matches are running, or wait for the seeds of their players."""
    both = tournament_games.join(matches, matches.c.id == tournament_games.c.match_id)
    ours = (tournament_games.c.tournament_id == tournament_id) & matches.c.status.in_(ON_THE_TABLE)
    columns = (*tournament_games.c, matches.c.seat_0, matches.c.seat_1)
    return list(connection.execute(select(*columns).select_from(both).where(ours)))


def _give_out(writing: Writing, row: Row[Any], ledger: Ledger) -> None:
    """Begin a match for every due game whose two players are both free, in the order of the event."""
    running = running_games(writing.connection, row.id)
    busy = {agent for game in running for agent in (game.seat_0, game.seat_1)}
    begun = {(game.pair, game.leg, game.attempt) for game in running}
    for due in ledger.event.due:
        players = [row.agents[name] for name in due.pair.players]
        if (due.pair.id, due.leg, due.attempt) not in begun and busy.isdisjoint(players):
            _begin(writing, row, ledger.event.spec, due)
            busy.update(players)


def _begin(writing: Writing, row: Row[Any], spec: Spec, due: Due) -> None:
    """The match of one game; an event may do without a wall clock, a match at a server has one.

    Its players add seeds of their own as in any match, unless the event has a chosen seed and is to repeat.
    """
    seed = match_seed(spec, due.pair, due.leg, due.attempt)
    first, second = (row.agents[name] for name in due.pair.players)
    assert seed.given_racks is not None
    request = MatchRequest(
        agents=(first, second),
        games=1,
        table=spec.table if isinstance(spec.table, str) else dict(spec.table),  # type: ignore[arg-type]
        noise=NoiseTerms.of(spec.noise.model(due.pair.noise)),
        clock=ClockTerms(seconds=spec.seconds or MOST_SECONDS, simulations=spec.simulated_shots),
        seed=seed.secret.hex(),
        racks=RackTerms(seed=seed.given_racks.hex()),
        first_breaker=due.breaker,
        client_seed_seconds=0.0 if spec.foreseeable else SEED_SECONDS,
    )
    match = insert_match(writing, request, challenger=None, foreseeable=spec.foreseeable)
    game = {"match_id": match.id, "tournament_id": row.id, "pair": due.pair.id, "leg": due.leg, "attempt": due.attempt}
    writing.connection.execute(insert(tournament_games).values(game))
    begin_or_wait(writing, match)
    writing.woken.update((first, second))


def _course(known: TournamentState | None, connection: Connection, row: Row[Any]) -> TournamentState:
    """What is known, and the entries since."""
    since = 0 if known is None else known.sequence
    ledger = Ledger(Tournament(Spec.from_dict(row.terms))) if known is None else known.ledger
    later = _entries(connection, row.id, tournament_entries.c.sequence > since)
    if known is not None and not later:
        return known
    sequence = later[-1].sequence if later else since
    return TournamentState(sequence, ledger.after(Act(each.kind, each.fields) for each in later))


def _entries(
    connection: Connection, tournament_id: str, condition: ColumnElement[bool], limit: int | None = None
) -> list[Row[Any]]:
    """What happened, in order."""
    ours = (tournament_entries.c.tournament_id == tournament_id) & condition
    query = select(tournament_entries).where(ours).order_by(tournament_entries.c.sequence).limit(limit)
    return list(connection.execute(query))


def _result(connection: Connection, match_id: str, due: Due) -> dict[str, Any]:
    """The result of a match's only game, from its record; without one where it was called off before it began."""
    row = connection.execute(select(games).where(games.c.match_id == match_id)).one_or_none()
    if row is None:
        return called_off(due).to_dict()
    game = GameRow.of(row)
    record = read_record(history.record_lines(connection, game))
    simulated = (game.simulated_0, game.simulated_1)
    return result_of(record, due, simulated, f"/v1/games/{game.id}/record").to_dict()
