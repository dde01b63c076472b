"""SQLite: in WAL mode, flushed at every commit; one server process."""

import sqlite3
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial
from typing import Any, Final

from sqlalchemy import Connection, Engine, create_engine, event, exc

from server.store import stored_json
from server.store.files import create_private

POOL_SIZE = 8
POOL_OVERFLOW = 56
"""Together more than the 40 threads that serve requests, so that nobody waits for a connection."""
PRAGMAS: Final = {"synchronous": "FULL", "foreign_keys": "ON", "wal_autocheckpoint": 4000}
"""The log goes into the file when it has so many pages, 16 MB: each page that many strokes wrote goes there once."""
WRITING = {"pooliad_writes": True}
"""Options of a connection that takes the writer's place with its first statement."""

_OURS = "SELECT count(*) = 0 OR sum(name = 'moves') > 0 FROM sqlite_master"


def engine(url: str, wait: float) -> Engine:
    """The connections of a file; a writer waits so many seconds for another *process* that writes."""
    made = create_engine(url, pool_size=POOL_SIZE, max_overflow=POOL_OVERFLOW, **stored_json.BY)
    event.listen(made, "do_connect", lambda *_: create_private(path_of(url)))
    event.listen(made, "connect", partial(_set_pragmas, wait))
    event.listen(made, "begin", _begin)
    return made


def path_of(url: str) -> str:
    """The file of a URL."""
    return url.removeprefix("sqlite:///")


def _set_pragmas(wait: float, connection: Any, _record: object) -> None:
    connection.isolation_level = None  # the driver's own BEGIN comes too late for a compare-and-set
    for name, value in {"busy_timeout": int(1000 * wait), **PRAGMAS}.items():
        connection.execute(f"PRAGMA {name} = {value}").close()
    (is_ours,) = connection.execute(_OURS).fetchone()
    if is_ours:  # the mode is written into the file, and the file of another program is left as it is
        connection.execute("PRAGMA journal_mode = WAL").close()


@contextmanager
def savepoint(connection: Connection) -> Iterator[Callable[[], object]]:
    """Part of a transaction: what it wrote is taken back, and nothing else, by a call of what this gives.

    An exception leaves it to the whole transaction to be taken back.
    """
    execute(connection, "SAVEPOINT part")
    yield lambda: execute(connection, "ROLLBACK TO part")
    execute(connection, "RELEASE part")


def execute(connection: Connection, statement: str, parameters: Sequence[Any] = ()) -> sqlite3.Cursor:
    """The driver's own cursor: the library takes ten times as long to hand a statement on as the driver to answer it.

    What fails is raised as the library would.
    """
    driver: Any = connection.connection.dbapi_connection
    try:
        cursor: sqlite3.Cursor = driver.execute(statement, parameters)
    except sqlite3.Error as error:
        raise exc.DBAPIError.instance(statement, None, error, sqlite3.Error) from error
    return cursor


def _begin(connection: Connection) -> None:
    writes = connection.get_execution_options().get("pooliad_writes", False)
    execute(connection, "BEGIN IMMEDIATE" if writes else "BEGIN")
