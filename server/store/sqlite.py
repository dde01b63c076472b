"""SQLite: in WAL mode, flushed at every commit; one server process."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event

from server.store.files import create_private

POOL_SIZE = 8
POOL_OVERFLOW = 56
"""Together more than the 40 threads that serve requests, so that nobody waits for a connection."""
WRITING = {"pooliad_writes": True}
"""Options of a connection that takes the writer's place with its first statement."""

_OURS = "SELECT count(*) = 0 OR sum(name = 'moves') > 0 FROM sqlite_master"


def engine(url: str, wait: float) -> Engine:
    """The connections of a file; a writer waits so many seconds for another *process* that writes."""
    made = create_engine(url, pool_size=POOL_SIZE, max_overflow=POOL_OVERFLOW)
    event.listen(made, "do_connect", lambda *_: create_private(path_of(url)))
    event.listen(made, "connect", partial(_set_pragmas, wait))
    event.listen(made, "begin", _begin)
    return made


def path_of(url: str) -> str:
    """The file of a URL."""
    return url.removeprefix("sqlite:///")


def _set_pragmas(wait: float, connection: Any, _record: object) -> None:
    connection.isolation_level = None  # the driver's own BEGIN comes too late for a compare-and-set
    for pragma in (f"busy_timeout = {1000 * wait:.0f}", "synchronous = FULL", "foreign_keys = ON"):
        connection.execute(f"PRAGMA {pragma}").close()
    (is_ours,) = connection.execute(_OURS).fetchone()
    if is_ours:  # the mode is written into the file, and the file of another program is left as it is
        connection.execute("PRAGMA journal_mode = WAL").close()


@contextmanager
def savepoint(connection: Connection) -> Iterator[Callable[[], None]]:
    """Part of a transaction: what it wrote is taken back, and nothing else, by a call of what this gives.

    An exception leaves it to the whole transaction to be taken back.
    """
    driver: Any = connection.connection.dbapi_connection
    driver.execute("SAVEPOINT part")
    yield lambda: driver.execute("ROLLBACK TO part")
    driver.execute("RELEASE part")


def _begin(connection: Connection) -> None:
    writes = connection.get_execution_options().get("pooliad_writes", False)
    driver: Any = connection.connection.dbapi_connection  # the library takes longer to begin than to do the rest
    driver.execute("BEGIN IMMEDIATE" if writes else "BEGIN")
