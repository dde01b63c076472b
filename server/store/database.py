"""Connections and transactions, on SQLite or PostgreSQL.

Reads see one snapshot. On SQLite a write holds the only writer's place from its first line; on PostgreSQL writes of
different matches go on at once, and whoever changes a match locks its row first (`server.store.locks`).
"""

import contextlib
import contextvars
import secrets
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from typing import Final, TypeVar

from sqlalchemy import Connection, Engine, delete, insert

from server.errors import ServerError
from server.store import files, outages, postgresql, sqlite
from server.store.group_commit import GroupCommit
from server.store.outages import Overtaken
from server.store.process_lock import AloneMembership, Membership, SharedMembership
from server.store.tables import answers

T = TypeVar("T")

ROOM: Final = 1024 * 1024
"""Bytes: more than strokes write but for the longest, ten times what a break does with its line and its answer."""


class Database:
    """One database by its URL.

    Args:
        url: where it is.
        wait: seconds for an SQLite file that another process has locked.
        group_commit: whether transactions of SQLite that may share a commit do so; PostgreSQL sees to that itself.

    Attributes:
        is_shared: whether several server processes may work on it at once.
        membership: which of them are there.
        writes_fail: set by a write that the database did not take, cleared by `try_writing`.
    """

    def __init__(self, url: str, wait: float = outages.WAIT_SECONDS, *, group_commit: bool = False) -> None:
        self.url = url
        self.is_shared = postgresql.is_ours(url)
        self._engine = postgresql.engine(url) if self.is_shared else sqlite.engine(url, wait)
        self._reader = self._engine.execution_options(**postgresql.READING) if self.is_shared else self._engine
        self._writer = self._engine if self.is_shared else self._engine.execution_options(**sqlite.WRITING)
        self._place: AbstractContextManager[None] = contextlib.nullcontext() if self.is_shared else _WritersPlace()
        self._group = GroupCommit(self._place, self._transaction) if group_commit and not self.is_shared else None
        self.writes_fail = threading.Event()
        self.membership: Membership = SharedMembership(self._engine) if self.is_shared else AloneMembership(url)

    @contextmanager
    def reading(self) -> Iterator[Connection]:
        """A connection for a consistent look; writing through it is an error of the program.

        Raises `Unavailable` when the database does not answer, as everything here does.
        """
        with outages.told(), _connected(self._reader) as connection:
            connection.begin()
            yield connection

    @contextmanager
    def writing(self) -> Iterator[Connection]:
        """A transaction that commits at the end of the block and rolls back when it raises.

        On SQLite, threads of this process queue on a lock rather than on the library's sleeping retries.
        """
        with self._place, self._transaction() as connection:
            yield connection

    def carry_out(self, work: Callable[[Connection], T]) -> T:
        """What `work` makes of a transaction that commits when it returns, and is taken back when it raises.

        With `group_commit` others' work may be in the same transaction, before it and after it: what it reads of what
        others write may be uncommitted, and it may be called again. Raises `Unavailable` as `writing` does.
        """
        if self._group is not None:
            return self._group.carry_out(work)
        with self.writing() as connection:
            return work(connection)

    @property
    def shares_commits(self) -> bool:
        """Whether `carry_out_together` is to be had."""
        return self._group is not None

    def carry_out_together(
        self, works: Sequence[tuple[Callable[[Connection], T], contextvars.Context]]
    ) -> list[Callable[[], T]]:
        """`carry_out` for what one thread has collected, each in its own context. What is returned tells what became of
        each: its result, or what it raised. Only with `group_commit`, on SQLite.
        """
        assert self._group is not None
        return self._group.carry_out_together(works)

    @contextmanager
    def _transaction(self) -> Iterator[Connection]:
        """In the writer's place."""
        with outages.told(self.writes_fail.set), _connected(self._writer) as connection, connection.begin():
            yield connection

    def has_room(self) -> bool:
        """Whether the database's disk has room for a stroke; PostgreSQL's may be another machine's: not asked."""
        try:
            return self.is_shared or files.free_bytes(sqlite.path_of(self.url)) >= ROOM
        except OSError:
            return False

    def try_writing(self) -> None:
        """Write, and take back, as much as a large stroke: small writes get through where no stroke does.

        Raises `Unavailable` when the database does not take it.
        """
        probe = {"caller": "probe", "route": "probe", "key": secrets.token_hex(8)}
        row = {"request_digest": "", "status": 0, "headers": {}, "body": secrets.token_bytes(ROOM), "created_at": 0}
        with self.writing() as connection:
            connection.execute(insert(answers).values(probe | row))
        with self.writing() as connection:
            connection.execute(delete(answers).filter_by(**probe))
        self.writes_fail.clear()

    def exposure(self) -> str | None:
        """What to say when others than the owner may read the files of the database; None when they may not."""
        return None if self.is_shared else files.exposure(sqlite.path_of(self.url))

    def clock(self) -> int:
        """The time by the database's own clock, ns since 1970; for several processes that share it."""
        with outages.told(), self._engine.connect() as connection:
            return int(connection.exec_driver_sql(postgresql.CLOCK).scalar_one())

    def dispose(self) -> None:
        """Close every connection, then give the place back."""
        self._engine.dispose()
        self.membership.leave()


@contextmanager
def _connected(engine: Engine) -> Iterator[Connection]:
    """A connection of the pool; after a fault it does not go back there.

    A result half read lives as long as the fault's traceback, and on SQLite it holds the snapshot it was read from:
    whoever wrote through that connection next would be told at once that the database is locked.
    """
    with engine.connect() as connection:
        try:
            yield connection
        except (ServerError, Overtaken):
            raise
        except BaseException:
            connection.invalidate()
            raise


class _WritersPlace:
    """A lock on which nobody waits for ever: behind a writer that is stuck everybody is told so."""

    def __init__(self) -> None:
        self._lock = threading.Lock()

    def __enter__(self) -> None:
        if not self._lock.acquire(timeout=outages.QUEUE_SECONDS):
            raise outages.unavailable()

    def __exit__(self, *_: object) -> None:
        self._lock.release()
