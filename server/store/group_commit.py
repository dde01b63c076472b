"""One flush to the disk for many transactions (group commit: Gray and Reuter, Transaction Processing, 1993, 9.4).

SQLite has one writer, and what a commit costs is the flush: while one is under way, everybody else who wants to write
waits. They are then carried out one after the other in one transaction, and nobody is answered before it is committed.
Each has a savepoint, so that a refusal takes back its own writes alone. A fault of any other kind takes back the whole
transaction, and each is carried out again by itself: what failed fails alone.
"""

import contextvars
import logging
import threading
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from typing import Any, Final, TypeVar

from sqlalchemy import Connection

from server.errors import ServerError, Unavailable
from server.store import outages, sqlite
from server.store.outages import Overtaken

log = logging.getLogger("pooliad.server.store")

MOST: Final = 64
"""Transactions that share a commit: readers of the write-ahead log, and a crash, meet no more than that at once."""

T = TypeVar("T")
Work = Callable[[Connection], Any]
Place = AbstractContextManager[None]
Transaction = Callable[[], AbstractContextManager[Connection]]


class GroupCommit:
    """Those who wait to write, and the one of them who writes for all.

    Args:
        place: the only writer's; whoever waits for it too long is told `Unavailable`.
        transaction: makes one that commits at the end of its block and rolls back when that raises. In the place.
    """

    def __init__(self, place: Place, transaction: Transaction) -> None:
        self._place = place
        self._transaction = transaction
        self._lock = threading.Lock()
        self._waiting: deque[_Member] = deque()
        self._is_led = False

    def carry_out(self, work: Callable[[Connection], T]) -> T:
        """What `work` returns or raises, its writes committed or taken back.

        It is called in any thread, and again where the transaction failed by another's fault: beside what it writes it
        must change nothing.
        """
        member = _Member(work)
        with self._lock:
            self._waiting.append(member)
            leads, self._is_led = not self._is_led, True
        if leads or member.is_to_lead():
            self._lead()
        result: T = member.result()
        return result

    def carry_out_together(self, works: Sequence[tuple[Work, contextvars.Context]]) -> list[Callable[[], Any]]:
        """The same for work that one thread has collected, each in its own context: what tells what became of each."""
        members = [_Member(work, context) for work, context in works]
        try:
            with self._place:
                for start in range(0, len(members), MOST):
                    self._write(members[start : start + MOST])
        except BaseException as error:
            _fail(members, error)
        return [member.result for member in members]

    def _lead(self) -> None:
        """Write for all who wait, then let the next one of those who came meanwhile lead."""
        members: list[_Member] = []
        try:
            with self._place:
                members = self._taken()
                self._write(members)
        except BaseException as error:
            members = members or self._taken()
            _fail(members, error)
        finally:
            self._hand_on()
            for member in members:
                member.settle()

    def _taken(self) -> "list[_Member]":
        with self._lock:
            return [self._waiting.popleft() for _ in range(min(MOST, len(self._waiting)))]

    def _hand_on(self) -> None:
        with self._lock:
            self._is_led = bool(self._waiting)
            if self._waiting:
                self._waiting[0].lead()

    def _write(self, members: "list[_Member]") -> None:
        if len(members) > 1:
            try:
                with self._transaction() as connection:
                    for member in members:
                        member.attempt(connection)
                return
            except Unavailable:
                raise  # each by itself would wait as long again
            except Exception:
                log.warning("a transaction of %d is taken back, and each is carried out by itself", len(members))
        for member in members:
            member.carry_out_alone(self._transaction)


def _fail(members: "list[_Member]", error: BaseException) -> None:
    """Nothing of what they wrote is known to be stored."""
    for member in members:
        member.fail(outages.unavailable() if isinstance(error, Unavailable) else error)


class _Member:
    """One of those who wait: its writes, and what became of them.

    Args:
        work: what it writes.
        context: its own, so that its log lines name its own request; None: the caller's.
    """

    def __init__(self, work: Work, context: contextvars.Context | None = None) -> None:
        self._work = work
        self._context = contextvars.copy_context() if context is None else context
        self._woken = threading.Event()
        self._leads = False
        self._result: Any = None
        self._error: BaseException | None = None

    def is_to_lead(self) -> bool:
        """Wait until there is a result, False, or until it is this one's turn to write for all."""
        self._woken.wait()
        return self._leads

    def lead(self) -> None:
        """Wake it, to write for all."""
        self._leads = True
        self._woken.set()

    def settle(self) -> None:
        """Wake it: there is a result."""
        self._woken.set()

    def fail(self, error: BaseException) -> None:
        """Nothing of it is stored."""
        self._result, self._error = None, error

    def attempt(self, connection: Connection) -> None:
        """Write, in a transaction with others; a refusal takes back what this one wrote."""
        self._error = None
        with sqlite.savepoint(connection) as take_back:
            try:
                self._result = self._context.run(self._work, connection)
            except (ServerError, Overtaken) as refusal:
                take_back()
                self.fail(refusal)

    def carry_out_alone(self, transaction: Transaction) -> None:
        """Write, in a transaction of its own."""
        self._error = None
        try:
            with transaction() as connection:
                self._result = self._context.run(self._work, connection)
        except BaseException as error:
            self.fail(error)

    def result(self) -> Any:
        """What the work returned; raises what it raised."""
        if self._error is not None:
            raise self._error
        return self._result
