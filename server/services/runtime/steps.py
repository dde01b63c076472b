"""A request in steps: a look at the database, work without it, a transaction, and what follows when that is committed.

Some requests end with the look. In one go each step is a thread's; step by step, many requests make each together
(`server.services.runtime.batches`).
"""

from dataclasses import dataclass
from typing import Generic, TypeVar

from sqlalchemy import Connection

from server.services.runtime.context import Context, Writing

T = TypeVar("T")
S = TypeVar("S")


@dataclass(frozen=True, slots=True)
class Done(Generic[T]):
    """What came of a request that needs no more steps."""

    value: T


class Steps(Generic[T, S]):
    """One request; its steps are called in their order, and all again from the first where they did not come through.

    `T` is what comes of it, `S` what its transaction hands on.

    Args:
        context: the server's parts.
    """

    def __init__(self, context: Context) -> None:
        self.context = context

    def looked(self, connection: Connection) -> Done[T] | None:
        """Look at what is committed; None when there is more to be done."""
        raise NotImplementedError

    def prepare(self) -> None:
        """What takes no database."""

    @property
    def goes_alone(self) -> bool:
        """Whether its transaction may have no other request's writes; asked once it is prepared."""
        return False

    def store(self, writing: Writing) -> S:
        """Write; beside that, change nothing: it may be called again."""
        raise NotImplementedError

    def finished(self, stored: S) -> T:
        """What comes of it, now that it is committed."""
        raise NotImplementedError

    def carried_out(self) -> T:
        """All steps in one go, in this thread."""
        with self.context.database.reading() as connection:
            if (done := self.looked(connection)) is not None:
                return done.value
        self.prepare()
        return self.stored()

    def stored(self) -> T:
        """The last two steps in one go."""
        if not self.goes_alone:
            return self.finished(self.context.carry_out(self.store))
        with self.context.writing() as writing:
            stored = self.store(writing)
        return self.finished(stored)
