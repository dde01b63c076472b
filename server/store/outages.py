"""A database that does not answer (lost, locked for long, full) is told apart from a fault of the program."""

import logging
import sqlite3
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final

from sqlalchemy import exc

from server.errors import Unavailable

log = logging.getLogger("pooliad.server.store")

WAIT_SECONDS: Final = 5.0
"""How long a writer waits for another process that has the file locked, unless told."""
QUEUE_SECONDS: Final = 30.0
"""How long anything waits behind others of ours, for a connection, a lock or the writer's place: a machine that is
merely slow is no outage.
"""

_PASSING: Final = frozenset(
    {
        sqlite3.SQLITE_BUSY,
        sqlite3.SQLITE_LOCKED,
        sqlite3.SQLITE_IOERR,
        sqlite3.SQLITE_FULL,
        sqlite3.SQLITE_CANTOPEN,
        sqlite3.SQLITE_PROTOCOL,
    }
)
_PRIMARY: Final = 0xFF
"""The bits of SQLite's code that say what kind of failure it is (https://sqlite.org/rescode.html)."""


class Overtaken(Exception):
    """Somebody else was faster: the transaction is rolled back, to be tried again. No fault."""


def nothing() -> None:
    """Nobody is to be told."""


@contextmanager
def told(outage: Callable[[], None] = nothing) -> Iterator[None]:
    """Raise `Unavailable` where the database does not answer, after a call of `outage`; why is for the log alone."""
    try:
        yield
    except (exc.DBAPIError, exc.TimeoutError) as error:
        if not _is_outage(error):
            raise
        outage()
        log.warning("the database does not answer: %s", error.orig if isinstance(error, exc.DBAPIError) else error)
        raise unavailable() from error


def unavailable() -> Unavailable:
    """What callers are told, whatever the reason: a commit may have been the last thing that was heard of."""
    return Unavailable("the database does not answer; send the same request again, with the same Idempotency-Key")


def _is_outage(error: exc.DBAPIError | exc.TimeoutError) -> bool:
    """PostgreSQL's operational errors are about its operation; SQLite's include mistakes in a statement."""
    if isinstance(error, exc.TimeoutError) or error.connection_invalidated:
        return True
    if isinstance(error.orig, sqlite3.Error):
        return getattr(error.orig, "sqlite_errorcode", 0) & _PRIMARY in _PASSING
    return isinstance(error, exc.OperationalError)
