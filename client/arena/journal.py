"""The journal of an event: what was decided, in order, on disk before anybody relies on it.

JSON lines, appended only. Each is flushed to the disk; several processes may append. A line that an interruption
tore off is no line: readers pass over it, the next writer cuts it away.
"""

import fcntl
import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from client.errors import PooliadError

CHUNK = 4096
"""Bytes read at a time, backwards, in search of the last complete line."""


class DamagedJournal(PooliadError):
    """A complete line in the journal is no entry: somebody other than this program wrote it, or the disk is bad."""


@dataclass(frozen=True, slots=True)
class JournalEntry:
    """One line.

    Attributes:
        kind: what happened. at: when, UTC, ISO 8601. fields: the rest.
    """

    kind: str
    at: str
    fields: dict[str, Any]


class Journal:
    """An append-only file of entries.

    Args:
        path: of the file; made when the first entry is written.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._read = 0
        self._lines = 0

    def append(self, kind: str, **fields: Any) -> None:
        """Write an entry and flush it to the disk."""
        at = datetime.now(UTC).isoformat(timespec="milliseconds")
        line = json.dumps({"kind": kind, "at": at, **fields}, allow_nan=False).encode() + b"\n"
        with self._alone() as descriptor:
            _cut_torn_line(descriptor)
            os.lseek(descriptor, 0, os.SEEK_END)
            _write_all(descriptor, line)
            os.fsync(descriptor)

    def new(self) -> Iterator[JournalEntry]:
        """The complete entries since the last call, whoever wrote them.

        Raises:
            DamagedJournal: a complete line is no entry.
        """
        try:
            with self.path.open("rb") as file:
                file.seek(self._read)
                tail = file.read()
        except FileNotFoundError:
            return
        for line in tail.split(b"\n")[:-1]:
            self._read += len(line) + 1
            self._lines += 1
            yield self._entry(line)

    def _entry(self, line: bytes) -> JournalEntry:
        try:
            fields = json.loads(line)
            return JournalEntry(fields.pop("kind"), fields.pop("at"), fields)
        except (ValueError, KeyError, AttributeError, TypeError) as error:
            raise DamagedJournal(f"{self.path}, line {self._lines}: {line[:60]!r} is no entry: {error}") from None

    @contextmanager
    def _alone(self) -> Iterator[int]:
        """The file, locked against other writers."""
        descriptor = os.open(self.path, os.O_RDWR | os.O_CREAT, 0o644)
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX)
            yield descriptor
        finally:
            os.close(descriptor)


def _cut_torn_line(descriptor: int) -> None:
    """Shorten the file to its last complete line."""
    end = size = os.lseek(descriptor, 0, os.SEEK_END)
    while end > 0:
        start = max(0, end - CHUNK)
        found = os.pread(descriptor, end - start, start).rfind(b"\n")
        if found >= 0:
            end = start + found + 1
            break
        end = start
    if end < size:
        os.ftruncate(descriptor, end)


def _write_all(descriptor: int, data: bytes) -> None:
    while data:
        data = data[os.write(descriptor, data) :]
