"""PostgreSQL, by psycopg 3: several server processes on one database."""

from typing import Any, Final

from sqlalchemy import Engine, create_engine
from sqlalchemy.engine import make_url

SCHEME = "postgresql://"
POOL_SIZE = 8
POOL_OVERFLOW = 12
"""Together 20 connections a process: four processes fit into the 100 that a fresh PostgreSQL allows. Threads that
find none free wait for one; none ever holds two."""
READING: Final[dict[str, Any]] = {"isolation_level": "REPEATABLE READ", "postgresql_readonly": True}
"""Options of connections whose statements all see the same moment."""

CLOCK: Final = "SELECT (extract(epoch FROM clock_timestamp()) * 1000000000)::bigint"
"""Nanoseconds since 1970, when the statement runs and not when its transaction began."""


def is_ours(url: str) -> bool:
    """Whether the URL names a PostgreSQL database."""
    return url.startswith(SCHEME)


def engine(url: str) -> Engine:
    """The connections of a database, READ COMMITTED: a statement after a lock sees what was written before it."""
    address = make_url(url).set(drivername="postgresql+psycopg")
    return create_engine(address, pool_size=POOL_SIZE, max_overflow=POOL_OVERFLOW, isolation_level="READ COMMITTED")


def driver_url(url: str) -> str:
    """The same address for psycopg without SQLAlchemy."""
    return make_url(url).set(drivername="postgresql").render_as_string(hide_password=False)
