"""Connections and transactions.

Reads see one snapshot; a write holds the only writer's place from its first line.
"""

import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from sqlalchemy import Connection, Engine, create_engine, event
from sqlalchemy.engine import make_url

BUSY_MILLISECONDS = 10_000
"""How long a writer waits for another *process* holding the database before it gives up."""
POOL_SIZE = 8
POOL_OVERFLOW = 56
"""Together more than the 40 threads that serve requests, so that nobody waits for a connection."""


class Database:
    """One database by its URL; SQLite runs in WAL mode, flushed at every commit."""

    def __init__(self, url: str) -> None:
        self.url = url
        self._engine = create_engine(make_url(url), pool_size=POOL_SIZE, max_overflow=POOL_OVERFLOW)
        self._writer = threading.Lock()
        _prepare_sqlite(self._engine)

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """A connection for a consistent look; writing through it is an error of the program."""
        with self._engine.connect() as connection:
            yield connection

    @contextmanager
    def writing(self) -> Iterator[Connection]:
        """A transaction that commits at the end of the block and rolls back when it raises.

        Threads of this process queue on a lock rather than on SQLite's sleeping retries.
        """
        with self._writer, self._engine.connect() as connection:
            writing = connection.execution_options(pooliad_writes=True)
            with writing.begin():
                yield writing

    def dispose(self) -> None:
        """Close every connection."""
        self._engine.dispose()


def _prepare_sqlite(engine: Engine) -> None:
    event.listen(engine, "connect", _set_pragmas)
    event.listen(engine, "begin", _begin)


def _set_pragmas(connection: Any, _record: object) -> None:
    connection.isolation_level = None  # the driver's own BEGIN comes too late for a compare-and-set
    for pragma in (
        f"busy_timeout = {BUSY_MILLISECONDS}",
        "journal_mode = WAL",
        "synchronous = FULL",
        "foreign_keys = ON",
    ):
        connection.execute(f"PRAGMA {pragma}").close()


def _begin(connection: Connection) -> None:
    writes = connection.get_execution_options().get("pooliad_writes", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
