"""Which server processes are at work on a database.

A process that dies, however it dies, is gone at once: what says that it is there is held by the operating system or by
its connection to the database.
"""

import os
from typing import Final, Protocol

from sqlalchemy import Connection, Engine, text
from sqlalchemy.exc import DBAPIError

from server.errors import SettingsError
from server.store import files, outages
from server.store.sqlite import path_of

SERVING: Final = 0x706F6F6C
"""The key of the advisory lock that every server process shares ("pool")."""
SHARE: Final = "SELECT pg_advisory_lock_shared(:key)"


class Membership(Protocol):
    """A process's place among those at work."""

    def enter(self) -> None:
        """Take the place; a second time does nothing. Raises `SettingsError` when the database is another's."""

    def settle(self) -> None:
        """Let others in: what only the first process does is done."""

    def renew(self) -> None:
        """Take the place again if it was lost with the connection; raises `Unavailable` when it cannot be had."""

    @property
    def is_alone(self) -> bool:
        """Whether no other process was there when this one entered."""

    def leave(self) -> None:
        """Give the place back."""


class AloneMembership:
    """One server process an SQLite file: a lock on the file itself, which ends with the process."""

    is_alone: Final = True

    def __init__(self, url: str) -> None:
        self._path = path_of(url)
        self._file: int | None = None

    def enter(self) -> None:
        """Take the lock, or say who has it."""
        if self._file is not None:
            return
        self._file = files.lock(self._path)
        if self._file is None:
            raise SettingsError(
                f"the database {self._path} is served by another process ({files.holder(self._path)}): "
                "must be one server process per SQLite file; several need a postgresql:// database"
            )

    def settle(self) -> None:
        """Nobody else comes in."""

    def renew(self) -> None:
        """The lock is this process's until it ends."""

    def leave(self) -> None:
        """Let go of the lock, when every connection is closed: with the file SQLite's own locks are given back."""
        if self._file is not None:
            os.close(self._file)
            self._file = None


class SharedMembership:
    """Any number of processes: a lock shared on one connection each.

    Who comes first holds it alone until it has settled; meanwhile others wait in `enter`.
    """

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._connection: Connection | None = None
        self.is_alone = False

    def enter(self) -> None:
        """Take the lock: alone if nobody has it, else shared."""
        if self._connection is not None:
            return
        with outages.told():
            self._connect()
            self.is_alone = bool(self._ask("SELECT pg_try_advisory_lock(:key)"))
            if not self.is_alone:
                self._ask(SHARE)

    def settle(self) -> None:
        """Share the lock that was held alone."""
        if self.is_alone:
            self._ask(SHARE)
            self._ask("SELECT pg_advisory_unlock(:key)")

    def renew(self) -> None:
        """Share the lock again when its connection is gone; who starts meanwhile alone is waited for."""
        with outages.told():
            if self._is_connected():
                return
            try:
                self._connect()
                self._ask(SHARE)
            except DBAPIError:
                self.leave()
                raise

    def leave(self) -> None:
        """End the session, and with it every lock."""
        if self._connection is not None:
            self._connection.invalidate()
            self._connection.close()
            self._connection = None

    def _is_connected(self) -> bool:
        """Whether the session that holds the lock is still there."""
        if self._connection is None:
            return False
        try:
            self._connection.exec_driver_sql("SELECT 1")
        except DBAPIError:
            self.leave()
        return self._connection is not None

    def _connect(self) -> None:
        self._connection = self._engine.connect().execution_options(isolation_level="AUTOCOMMIT")
        self._connection.exec_driver_sql("SET lock_timeout = 0")  # who is first may take long: it migrates

    def _ask(self, statement: str) -> object:
        assert self._connection is not None
        return self._connection.execute(text(statement), {"key": SERVING}).scalar()
