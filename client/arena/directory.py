"""An event's directory: its terms, its journal, a record for every game, what the agents wrote."""

import fcntl
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from client.arena.journal import Journal
from client.errors import PooliadError

TERMS, JOURNAL, LOCK = "event.json", "journal.jsonl", "running.lock"


class EventError(PooliadError):
    """An event that cannot be run as it stands; the message says why and what to do."""


class EventDirectory:
    """Where an event is kept.

    Args:
        path: of the directory.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    @classmethod
    def create(cls, path: Path, terms: dict[str, Any]) -> "EventDirectory":
        """A new directory for an event with these terms.

        Raises:
            EventError: there is an event already, or another process is making one.
        """
        directory = cls(path)
        for each in (path, directory.games, directory.logs):
            each.mkdir(parents=True, exist_ok=True)
        with directory.alone():
            if (path / TERMS).exists():
                raise EventError(f"{path} holds an event already: go on with `pooliad tournament resume {path}`")
            directory.keep_terms(terms)
        return directory

    @classmethod
    def open(cls, path: Path) -> "EventDirectory":
        """The directory of an event that was begun.

        Raises:
            EventError: there is none.
        """
        if not (path / TERMS).is_file():
            raise EventError(f"{path} holds no event: {TERMS} is missing")
        return cls(path)

    @property
    def journal(self) -> Journal:
        """The journal, read from its beginning."""
        return Journal(self.path / JOURNAL)

    @property
    def games(self) -> Path:
        """Where the records are."""
        return self.path / "games"

    @property
    def logs(self) -> Path:
        """Where the agents' standard error goes."""
        return self.path / "logs"

    def keep_terms(self, terms: dict[str, Any]) -> None:
        """Write the terms; the seed is a secret while the event goes on."""
        write_whole(self.path / TERMS, (json.dumps(terms, indent=2) + "\n").encode(), mode=0o600)

    def terms(self) -> Any:
        """What was kept last."""
        try:
            return json.loads((self.path / TERMS).read_text(encoding="utf-8"))
        except ValueError as error:
            raise EventError(f"{self.path / TERMS} is not JSON: {error}") from None

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Be the only one who runs this event, for as long as the block lasts.

        Raises:
            EventError: another process runs it.
        """
        with (self.path / LOCK).open("w") as file:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise EventError(f"{self.path} is being run by another process") from None
            yield


def file_name(name: str) -> str:
    """A file's name for an entrant."""
    return "".join(letter if letter.isalnum() or letter in "-_." else "_" for letter in name)


def write_whole(path: Path, data: bytes, mode: int = 0o644) -> None:
    """Write a file that is there whole or not at all, whatever interrupts."""
    partial = path.with_name(f"{path.name}.{os.getpid()}.new")
    try:
        with partial.open("wb") as file:
            partial.chmod(mode)
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
    flush_folder(path.parent)


def flush_folder(folder: Path) -> None:
    """Have the names in a folder on the disk."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
