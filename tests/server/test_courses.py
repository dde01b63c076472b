"""How a tournament stands is kept between requests, and never what was not committed."""

import itertools

import pytest
from sqlalchemy import insert
from support.events import result_of, spec_of

from server.services.runtime.context import Context
from server.services.tournaments import progress, tournament_views
from server.services.tournaments.tournament_cache import MOST_KEPT, TournamentCache, TournamentState
from server.settings import Settings
from server.store.database import Database
from server.store.tables import agents, tournaments
from server.store.upgrade import upgrade
from tournament import Tournament
from tournament.ledger import Ledger

SPEC = spec_of(2, pairs=3)


@pytest.fixture
def context(new_database):
    """A server's parts on a database with one tournament, ``cup``, that is paused."""
    database = Database(new_database())
    upgrade(database)
    made = Context(Settings(), database)
    row = {"id": "cup", "name": "cup", "status": "paused", "terms": SPEC.to_dict(), "games": 0, "due": 6}
    with made.writing() as writing:
        for name in SPEC.names:
            writing.connection.execute(insert(agents).values(id=name, name=name, house=False, created_at=0))
        row |= {"agents": {name: name for name in SPEC.names}, "created_at": 0}
        writing.connection.execute(insert(tournaments).values(row))
        progress.note(writing, progress.find(writing.connection, "cup"), "pause", "organiser", {})
    yield made
    database.dispose()


def note_result(writing, number):
    """Note that the first player won the n-th game."""
    due = Tournament(SPEC).due[number]
    result = result_of(due, due.pair.players.index("a"), record="x").to_dict()
    progress.note(
        writing, progress.hold(writing.connection, "cup"), progress.RESULT, progress.SERVER, {"result": result}
    )


def note_in_vain(context):
    with context.writing() as writing:
        note_result(writing, 1)
        raise RuntimeError


def wins(context):
    with context.database.reading() as connection:
        view = tournament_views.standings_view(context, connection, progress.find(connection, "cup"))
    return {line.name: line.wins for line in view.standings}


def test_what_is_committed_is_seen_at_once(context):
    for number in range(3):
        with context.writing() as writing:
            note_result(writing, number)
        assert wins(context)["a"] == number + 1


def test_what_was_rolled_back_never_was(context):
    """SQLite gives the number of a row that was rolled back to the next one."""
    with context.writing() as writing:
        note_result(writing, 0)
    known = context.courses.get("cup")
    with pytest.raises(RuntimeError):
        note_in_vain(context)
    assert context.courses.get("cup") is known
    assert wins(context) == {"a": 1, "b": 0}
    with context.writing() as writing:
        note_result(writing, 2)
    assert wins(context) == {"a": 2, "b": 0}
    with context.database.reading() as connection:
        fresh = Context(Settings(), context.database)
        row = progress.find(connection, "cup")
        assert progress.course(fresh, connection, row) == progress.course(context, connection, row)


def test_what_another_process_wrote_is_read(context):
    other = Context(Settings(), context.database)
    for number, each in zip(range(4), itertools.cycle((context, other)), strict=False):
        with each.writing() as writing:
            note_result(writing, number)
        assert wins(context)["a"] == wins(other)["a"] == number + 1


def test_nothing_is_computed_again_while_nothing_came(context):
    wins(context)
    known = context.courses.get("cup")
    wins(context)
    assert context.courses.get("cup") is known
    assert "standings" in known.__dict__


def test_a_later_course_is_not_replaced_by_an_earlier_one_and_few_are_kept():
    courses, ledger = TournamentCache(), Ledger(Tournament(SPEC))
    late, early = TournamentState(9, ledger), TournamentState(4, ledger)
    courses.keep({"cup": late})
    courses.keep({"cup": early})
    assert courses.get("cup") is late
    courses.keep({str(number): early for number in range(MOST_KEPT)})
    assert courses.get("cup") is None
    assert courses.get(str(MOST_KEPT - 1)) is early
