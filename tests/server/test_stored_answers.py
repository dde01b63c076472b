"""Stored answers (`Idempotency-Key`) are deleted once nobody can ask for them again, and not before."""

import time

from sqlalchemy import func, select

from server.services.runtime import retention
from server.services.runtime.context import Context
from server.settings import Settings
from server.store.database import Database
from server.store.tables import answers
from server.store.upgrade import upgrade

WITHIN = 60.0
"""Seconds; an answer may go after 0.5 s."""


def stored(server, like="%"):
    database = Database(server.database_url)
    with database.reading() as connection:
        found = connection.scalar(select(func.count()).select_from(answers).where(answers.c.route.like(like)))
    database.dispose()
    return found


def until_none(server, like="%"):
    end = time.monotonic() + WITHIN
    while found := stored(server, like):
        assert time.monotonic() < end, found
        time.sleep(0.1)


def test_answers_go_when_nobody_can_ask_for_them(own_server, table_at, break_shot):
    server = own_server(POOLIAD_ANSWER_SECONDS="0.5")
    table = table_at(server, clock={"seconds": 600.0})
    mover, view = table.mover()
    played = mover.act(view, break_shot, key="the break")
    assert played.status_code == 200
    until_none(server, "/v1/matches%")  # the organiser's: it is older than it need be
    assert stored(server, "/v1/games/%") == 1, "while the match is on its players may ask"
    assert mover.act(view, break_shot, key="the break").content == played.content
    table.organiser.post(f"/v1/matches/{table.match['id']}/abort")
    until_none(server)
    late = mover.act(view, break_shot, key="the break")
    assert (late.status_code, late.json()["code"]) == (409, "game_finished"), "and is not played again"


def test_no_answer_goes_before_its_time(own_server, table_at):
    """A day, as documented: what was just answered is answered again."""
    server = own_server()
    table = table_at(server)
    table.organiser.post(f"/v1/matches/{table.match['id']}/abort", key="abort")
    kept = stored(server)
    context = Context(Settings(), Database(server.database_url))
    assert retention.prune(context) == 0
    context.database.dispose()
    assert stored(server) == kept == 2


def test_they_go_in_batches_the_oldest_first(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'many.db'}")
    upgrade(database)
    context = Context(Settings(answer_seconds=10.0), database)
    now = context.time.now()
    ages = [*range(11, 11 + retention.BATCH + 20), *range(5)]
    rows = [
        {"caller": "c", "route": "/v1/x", "key": str(age), "request_digest": "", "status": 200, "headers": {}}
        | {"body": b"", "created_at": now - age * 1_000_000_000}
        for age in ages
    ]
    with database.writing() as connection:
        connection.execute(answers.insert(), rows)
    assert [retention.prune(context) for _ in range(3)] == [retention.BATCH, 20, 0]
    with database.reading() as connection:
        assert set(connection.scalars(select(answers.c.key))) == {str(age) for age in range(5)}
    database.dispose()
