"""PostgreSQL, by psycopg 3: several server processes on one database."""

from typing import Any, Final

from sqlalchemy import Engine, create_engine, event
from sqlalchemy.engine import make_url

from server.store import stored_json
from server.store.outages import QUEUE_SECONDS

SCHEME = "postgresql://"
POOL_SIZE = 8
POOL_OVERFLOW = 12
"""Together 20 connections a process: four processes fit into the 100 that a fresh PostgreSQL allows. Threads that
find none free wait for one; none ever holds two."""
READING: Final[dict[str, Any]] = {"isolation_level": "REPEATABLE READ", "postgresql_readonly": True}
"""Options of connections whose statements all see the same moment."""

CLOCK: Final = "SELECT (extract(epoch FROM clock_timestamp()) * 1000000000)::bigint"
"""Nanoseconds since 1970, when the statement runs and not when its transaction began."""

ATTENTIVE: Final = {
    "connect_timeout": "5",
    "tcp_user_timeout": "5000",
    "keepalives_idle": "5",
    "keepalives_interval": "2",
    "keepalives_count": "3",
}
"""Parameters of libpq by which a machine that has vanished is noticed within seconds, not hours."""


def is_ours(url: str) -> bool:
    """Whether the URL names a PostgreSQL database."""
    return url.startswith(SCHEME)


def engine(url: str) -> Engine:
    """The connections of a database, READ COMMITTED: a statement after a lock sees what was written before it.

    Nobody waits for ever for a connection, or for a lock behind a transaction that is stuck.
    """
    made = create_engine(
        make_url(driver_url(url)).set(drivername="postgresql+psycopg"),
        pool_size=POOL_SIZE,
        max_overflow=POOL_OVERFLOW,
        pool_timeout=QUEUE_SECONDS,
        isolation_level="READ COMMITTED",
        **stored_json.BY,
    )
    event.listen(made, "connect", _bound_waits)
    return made


def driver_url(url: str) -> str:
    """The address for psycopg: attentive, unless it says otherwise itself."""
    address = make_url(url)
    told = {name: value for name, value in ATTENTIVE.items() if name not in address.query}
    return address.update_query_dict(told).set(drivername="postgresql").render_as_string(hide_password=False)


def _bound_waits(connection: Any, _record: object) -> None:
    connection.execute(f"SET lock_timeout = {int(1000 * QUEUE_SECONDS)}")
    connection.commit()
