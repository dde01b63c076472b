"""No statement of the server reads a whole table that grows: what the databases say about each one's plan.

The server does here what it does anywhere: starts with a game that waits, plays, ends, lists with every filter,
streams, runs an event, looks at clocks and at old answers. A page without a filter may follow an index in its order,
for its LIMIT ends that. On PostgreSQL sequential scans, and sorting pages, are dear, as they are on full tables: a
statement that still makes one, or follows a whole index, has no index to use.
"""

import contextlib
import json
import re
import socket
import sqlite3
import threading
import time
from collections.abc import Iterator
from typing import Any

import httpx2
import psycopg
import pytest
import uvicorn
from sqlalchemy import Engine, event, func, select
from support.cup import Cup
from support.streams import until, watching

from server.app import create_app, prepare
from server.services.accounts import house_bots
from server.services.accounts.house_bots import HouseBot
from server.services.accounts.house_processes import accept_waiting
from server.services.matches import match_list
from server.services.play.clock import standstill
from server.services.runtime.context import Context
from server.settings import Settings, organiser_digest
from server.store.database import Database
from server.store.tables import answers, metadata
from server.store.upgrade import upgrade

WITHIN = 60.0
SMALL = {"heartbeats", "house", "signing_keys"}
"""Tables with a row for each process, bot or key."""
GROWING = {table.name for table in metadata.sorted_tables} - SMALL
A_PART_OF_A_NAME = re.compile(r"lower\((agents|tournaments)\.name\) LIKE|\((agents|tournaments)\.name ILIKE")
"""Names are searched for a part: no index has parts, and there are only as many names as agents and events."""

Statements = dict[str, Any]
"""What was sent to the database, with the parameters it was sent with last."""


class Serving:
    """A server in this process, so that what it sends to its database is seen."""

    def __init__(self, url: str, token: str) -> None:
        digest = organiser_digest(token)
        app = create_app(
            Settings(database=url, organiser_digest=digest, answer_seconds=0.5, timer_period=0.1, house_places=1)
        )
        self.context: Context = app.state.context
        prepare(self.context)
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        self._server = uvicorn.Server(uvicorn.Config(app, port=port, log_config=None, lifespan="on"))
        self._thread = threading.Thread(target=self._server.run)
        self._thread.start()
        while not self._server.started:
            assert self._thread.is_alive()
            time.sleep(0.02)
        self.http = httpx2.Client(base_url=f"http://127.0.0.1:{port}", timeout=600)
        standstill.release(self.context)

    def request(self, method: str, path: str, token: str | None = None, **options: Any) -> httpx2.Response:
        if token is not None:
            options["headers"] = {"Authorization": f"Bearer {token}"} | dict(options.get("headers", {}))
        return self.http.request(method, path, **options)

    def close(self) -> None:
        self.http.close()
        self._server.should_exit = True
        self._thread.join(WITHIN)
        assert not self._thread.is_alive()


@pytest.fixture(scope="module")
def statements(
    new_database: Any, table_at: Any, player_at: Any, organiser_at: Any, script: Any
) -> tuple[str, Statements]:
    """A database, and everything that a server sends to it while it does all that it can do."""
    url, sent = new_database(), Statements()
    token = organiser_at(None).token

    def note(connection: Any, cursor: Any, statement: str, parameters: Any, context: Any, many: bool) -> None:
        sent[statement] = parameters[0] if many else parameters

    new = Database(url)
    upgrade(new)
    new.dispose()
    event.listen(Engine, "before_cursor_execute", note)
    try:
        with contextlib.closing(Serving(url, token)) as server:
            organiser, waits = organiser_at(server), table_at(server)
            play(table_at(server, games=2, noise={"level": 1.0, "told": False}, clock={"seconds": 600.0}), script)
            run_an_event(Cup(organiser, lambda: player_at(server), noise={"told": False}))
            challenge(server.context, organiser, player_at)
            run_out_of_time(server, table_at)
            read_lists(server, organiser, waits)
            for _ in range(match_list.MOST_NAMED):
                player_at(server)
            read_lists(server, organiser, waits)
            answers_are_deleted(server.context)
            waits.mover()
        with contextlib.closing(Serving(url, token)) as server, server.context.writing() as writing:
            standstill.make_up(writing, server.context.time.now())
    finally:
        event.remove(Engine, "before_cursor_execute", note)
    return url, sent


def play(table: Any, script: Any) -> None:
    """Strokes that a spectator watches, one sent again, the ends of a game and of its match, what is read of them."""
    game = f"/v1/games/{table.game}"
    with watching(table.organiser.server, f"{game}/stream") as stream:
        table.play(3)
        until(stream, "stroke")
    with watching(table.organiser.server, f"{game}/stream", **{"Last-Event-ID": "1"}) as stream:
        until(stream, "clocks")
    while table.is_running:
        mover, view = table.mover()
        for _ in range(2):
            mover.post(f"/v1/games/{view['game']}/concede", key=f"end {view['game']}", version=view["version"])
    pictures = ("/position.svg", "/position.png", "/shots/1.svg")
    for path in ("", "/shots", "/shots?cursor=1", "/clock", "/record", *pictures):
        assert table.organiser.get(game + path).status_code == 200, path
    for player in table.players:
        while player.get("/v1/turns", wait=0).status_code == 200:
            pass


def run_an_event(cup: Cup) -> None:
    cup.act("start")
    cup.concede(cup.running()[0])
    cup.act("pause")
    cup.act("start")
    for path in ("", "/standings", "/entries", "/entries?cursor=1"):
        cup.read(path)
    cup.act("abort")


def challenge(context: Context, organiser: Any, player_at: Any) -> None:
    """A challenge of a player, and two of a house bot, one of which waits for its place."""
    bot = house_bots.enter(context, HouseBot("house", "random"))
    house_bots.take(context, bot, "this process")
    house_bots.renew(context, bot, "this process")
    first, second = player_at(organiser.server), player_at(organiser.server)
    for challenged in (second.id, bot):
        made = first.post("/v1/matches", {"agents": [first.id, challenged], "client_seed_seconds": 0.2}).json()
        if challenged == second.id:
            second.post(f"/v1/matches/{made['id']}/accept", {"client_seed": "5" * 64})
    second.post("/v1/matches", {"agents": [second.id, bot]})
    organiser.post(f"/v1/matches/{made['id']}/abort")
    accept_waiting(context)
    house_bots.release(context, "this process")
    second.post(f"/v1/agents/{second.id}/token")


def run_out_of_time(server: Serving, table_at: Any) -> None:
    table = table_at(server, clock={"seconds": 1.0})
    table.mover()
    end = time.monotonic() + WITHIN
    while table.is_running:
        assert time.monotonic() < end
        time.sleep(0.1)


def read_lists(server: Serving, organiser: Any, table: Any) -> None:
    """Every list, first page and second, with every filter."""
    agent, place = table.players[0].id, "1.x"
    of_matches = ["", f"agent={agent}", f"search={table.match['id']}", "search=player", f"agent={agent}&search=player"]
    for listed in (
        *(f"/v1/matches?{each}" for each in of_matches),
        *(f"/v1/matches?{each}&status=finished" for each in of_matches),
        *("/v1/tournaments?", "/v1/tournaments?status=finished", "/v1/tournaments?search=cup"),
        *("/v1/agents?", "/v1/agents?house=true", "/v1/agents?search=player", "/v1/tokens?"),
        *("/v1/keys?", "/v1/ladder?", "/v1/best-strokes?", "/metrics?", "/healthz?", "/readyz?", "/v1/agents/me?"),
    ):
        for page in ("", f"&cursor={place}"):
            assert server.request("GET", listed + page, organiser.token).status_code in (200, 403), listed


def answers_are_deleted(context: Context) -> None:
    """Wait until the answers to what was asked so far, of matches that are over or of none, are gone."""
    asked, end = context.time.now(), time.monotonic() + WITHIN
    old = select(func.count()).where(answers.c.created_at < asked, answers.c.route == "/v1/matches")
    while True:
        with context.database.reading() as connection:
            if connection.scalar(old) == 0:
                return
        assert time.monotonic() < end
        time.sleep(0.1)


def scans_of_sqlite(url: str, statement: str, parameters: Any) -> Iterator[str]:
    """Steps that read a whole table or index, in SQLite's words (https://sqlite.org/eqp.html)."""
    with contextlib.closing(sqlite3.connect(url.removeprefix("sqlite:///"))) as connection:
        rows = connection.execute(f"EXPLAIN QUERY PLAN {statement}", parameters).fetchall()
    for *_, step in rows:
        found = re.match(r"SCAN (\w+)(?: USING (?:COVERING )?INDEX (\w+))?", step)
        if found and aliased(found[1], statement) in GROWING and not (found[2] and is_a_page(statement)):
            yield step


def scans_of_postgresql(url: str, statement: str, parameters: Any) -> Iterator[str]:
    """The same in PostgreSQL's (https://www.postgresql.org/docs/15/using-explain.html)."""
    with psycopg.connect(url, cursor_factory=psycopg.ClientCursor) as connection:
        connection.execute(f"SET enable_seqscan = off; SET enable_sort = {'off' if is_a_page(statement) else 'on'}")
        (plan,) = connection.execute(f"EXPLAIN (FORMAT JSON) {statement}", parameters).fetchone()[0]
    for node in nodes(plan["Plan"]):
        if node.get("Relation Name", "") not in SMALL and not is_a_search(node, statement):
            yield json.dumps({name: value for name, value in node.items() if name != "Plans"})


def is_a_search(node: dict[str, Any], statement: str) -> bool:
    """Whether a node of a plan looks rows up, or follows an index until a page is full."""
    kind = node["Node Type"]
    if kind == "Bitmap Heap Scan" or not kind.endswith("Scan"):  # whose child, an index's, has looked up
        return True
    follows = kind in ("Index Scan", "Index Only Scan") and is_a_page(statement) and "Filter" not in node
    return "Index Cond" in node or follows or kind == "Subquery Scan"


def nodes(plan: dict[str, Any]) -> Iterator[dict[str, Any]]:
    yield plan
    for child in plan.get("Plans", ()):
        yield from nodes(child)


def aliased(name: str, statement: str) -> str:
    """The table behind a name in a statement."""
    found = re.search(rf"(\w+) AS {name}\b", statement)
    return found[1] if found else name


def is_a_page(statement: str) -> bool:
    """Whether a statement asks for so many rows in an order, all of them welcome."""
    return "LIMIT" in statement and "WHERE" not in statement


def test_no_statement_reads_a_table_that_grows(statements, database_kind):
    url, sent = statements
    scans = scans_of_sqlite if database_kind == "sqlite" else scans_of_postgresql
    explained = [one for one in sent if re.match(r"\s*(SELECT|UPDATE|DELETE|WITH)", one) and "sqlite_master" not in one]
    explained = [one for one in explained if not re.search(r"pg_catalog|alembic_version|PRAGMA", one)]
    assert len(explained) > 80
    found = {one: steps for one in explained if (steps := list(scans(url, one, sent[one])))}
    unexpected = {one: steps for one, steps in found.items() if not A_PART_OF_A_NAME.search(one)}
    assert not unexpected, "\n".join(f"{one}\n  {steps}" for one, steps in unexpected.items())


def test_a_scan_is_seen(statements, database_kind):
    """What the test would say of statements as they were before their indices."""
    url, _ = statements
    scans = scans_of_sqlite if database_kind == "sqlite" else scans_of_postgresql
    for statement in (
        "SELECT id FROM games WHERE version = 7",
        "SELECT id FROM matches WHERE lower(commitment) = '' ORDER BY created_at DESC LIMIT 5",
        "SELECT count(*) FROM moves",
    ):
        assert list(scans(url, statement, None if database_kind == "postgresql" else ())), statement


@pytest.mark.parametrize("database_kind", ["sqlite"], indirect=True, scope="session")
def test_lists_are_read_in_their_order(statements):
    """Nothing is sorted but the pages of two seats, or of several players, that a page is put together of.

    SQLite says so in its plans; PostgreSQL sorts what little these tables hold, whatever indices there are.
    """
    url, sent = statements
    lists = [one for one in sent if re.search(r"ORDER BY (\w+\.)?created_at( DESC)?, (\w+\.)?id", one)]
    assert len(lists) > 30
    with contextlib.closing(sqlite3.connect(url.removeprefix("sqlite:///"))) as connection:
        for one in lists:
            steps = [row[3] for row in connection.execute(f"EXPLAIN QUERY PLAN {one}", sent[one])]
            sorts = [step for step in steps if "ORDER BY" in step]
            assert "UNION ALL" in one or "seat_0 = ? OR" in one or not sorts, (one, steps)
