"""A database as it is after very many games: one game that a server played, written again and again by the database."""

import contextlib
import sqlite3
from pathlib import Path
from typing import Final

AGENTS: Final = 1_000
EVENTS: Final = 1_000
MOVES: Final = 15
"""Strokes of a game that are written again."""
LINE: Final = 200
"""Bytes of them: what is read by an index is as far away behind short lines as behind long ones."""
STEP: Final = 1_000_000_000
"""ns between two matches."""
EVERYTHING_BEFORE: Final = 1_600_000_000 * STEP


def fill(database: Path, count: int) -> None:
    """Write finished games into a database that already has one finished match; each gets its own match."""
    with contextlib.closing(sqlite3.connect(database)) as connection:
        connection.execute("PRAGMA synchronous = OFF")
        connection.execute(f"CREATE TEMP TABLE n AS WITH RECURSIVE {_series('n', count)} SELECT n FROM n")
        _copy(connection, "agents", f"n WHERE n < {AGENTS}", _agents())
        _copy(connection, "tokens", f"n WHERE n < {AGENTS}", _tokens())
        finished = "(SELECT id FROM matches WHERE status = 'finished' LIMIT 1)"
        _copy(connection, "matches", "n", _matches(), f"t.id = {finished}")
        _copy(connection, "games", "n", _games(), f"t.match_id = {finished}")
        game = f"(SELECT id FROM games WHERE match_id = {finished})"
        for table in ("moves", "charges"):
            number = "number" if table == "moves" else "move"
            _copy(connection, table, "n", _rows_of_games(table), f"t.game_id = {game} AND t.{number} < {MOVES}")
        _copy(connection, "notices", "n", {"sequence": "NULL", "agent_id": _agent("n"), "message": "'{}'"}, "TRUE", 2)
        _copy(connection, "answers", "n", _answers(), "t.route LIKE '%/shots'", MOVES)
        _events(connection)
        connection.commit()
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")


def _series(name: str, count: int) -> str:
    return f"{name}(n) AS (SELECT 0 UNION ALL SELECT n + 1 FROM {name} WHERE n + 1 < {count})"


def _copy(
    connection: sqlite3.Connection, table: str, times: str, changed: dict[str, str], which: str = "TRUE", most: int = -1
) -> None:
    """Write a table's rows that satisfy a condition once for every n, other than they are where told."""
    columns = [row[1] for row in connection.execute(f"PRAGMA table_info({table})")]
    assert changed.keys() <= set(columns), (table, changed)
    values = ", ".join(changed.get(column, f't."{column}"') for column in columns)
    few = most if most >= 0 else {"agents": 1, "tokens": 1}.get(table, -1)
    rows = f'(SELECT * FROM "{table}" AS t WHERE {which} LIMIT {few})'
    connection.execute(f'INSERT INTO "{table}" SELECT {values} FROM {rows} AS t, (SELECT n FROM {times})')


def _id(kind: str, number: str = "n") -> str:
    return f"printf('{kind}_%016x', {number})"


def _agent(number: str) -> str:
    return _id("agent", f"({number}) % {AGENTS}")


def _agents() -> dict[str, str]:
    name = "'player ' || n"
    return {"id": _id("agent"), "name": name, "skeleton": name, "created_at": f"{EVERYTHING_BEFORE} + n"}


def _tokens() -> dict[str, str]:
    return {"id": _id("token"), "digest": "printf('%064x', n)", "agent_id": _id("agent")}


def _matches() -> dict[str, str]:
    at = f"{EVERYTHING_BEFORE} + n * {STEP}"
    seats = {"seat_0": _agent("n"), "seat_1": _agent(f"n + 1 + n / {AGENTS} % {AGENTS - 1}")}
    return {"id": _id("match"), "created_at": at, "started_at": at, "ended_at": at, **seats}


def _games() -> dict[str, str]:
    return {"id": _id("game"), "match_id": _id("match")}


def _rows_of_games(table: str) -> dict[str, str]:
    short = {"packed": f"substr(t.packed, 1, {LINE})"} if table == "moves" else {}
    return {"sequence": "NULL", "game_id": _id("game"), **short}


def _answers() -> dict[str, str]:
    return {"caller": _agent("n"), "route": "'/v1/games/' || " + _id("game") + " || '/shots'", "body": "x'00'"}


def _events(connection: sqlite3.Connection) -> None:
    """Finished events of a game each, the match of every hundredth game."""
    rows = f"n WHERE n < {EVENTS}"
    at = f"{EVERYTHING_BEFORE} + n * {STEP}"
    changed = {"id": _id("tournament"), "name": "'event ' || n", "status": "'finished'", "created_at": at}
    _copy(connection, "tournaments", rows, changed, most=1)
    _copy(connection, "tournament_entries", rows, {"sequence": "NULL", "tournament_id": _id("tournament")}, most=1)
