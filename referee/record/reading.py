"""Reading a record: from a file or from lines, to the header, the entries and the end."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from referee.errors import RefereeError
from referee.record.canonical import canonical, parse


class InvalidRecord(RefereeError):
    """A record that cannot be read; ``field`` names the line."""


@dataclass(frozen=True, slots=True)
class Record:
    """A record as it was read, nothing checked but its form.

    Attributes:
        header: the first line's object.
        entries: one object for each stroke or decision.
        end: the object of the line that reveals the secrets.
        seal: the last line's object.
        lines: all of them, as they came.
    """

    header: dict[str, Any]
    entries: tuple[dict[str, Any], ...]
    end: dict[str, Any]
    seal: dict[str, Any]
    lines: tuple[str, ...]

    @property
    def objects(self) -> tuple[dict[str, Any], ...]:
        """All lines' objects in order."""
        return (self.header, *self.entries, self.end, self.seal)


def read_record(source: str | os.PathLike[str] | Iterable[str]) -> Record:
    """Read a finished game's record.

    Args:
        source: path of a file, or the lines themselves.

    Raises:
        InvalidRecord: a line is not canonical JSON, or the lines are not a header, strokes, an end and a seal.
        OSError: the file cannot be read.
    """
    lines = _lines(Path(source)) if isinstance(source, str | os.PathLike) else tuple(source)
    objects = [_object(number, line) for number, line in enumerate(lines, 1)]
    if not objects:
        raise InvalidRecord("line 1", None, "a record starts with a header; this one is empty")
    expected = ["game", *["stroke"] * (len(objects) - 3), "end", "seal"]
    for number, (line, wanted) in enumerate(zip(objects, expected, strict=False), 1):
        if line.get("type") != wanted:
            allowed = f"must be {wanted!r}: a record is a header, strokes, an end and a seal"
            raise InvalidRecord(f"line {number}, type", line.get("type"), allowed)
    if len(objects) < 3:
        raise InvalidRecord(f"line {len(objects) + 1}", None, "the record ends before the game does: no end, no seal")
    _require_canonical(len(lines), lines[-1], objects[-1])
    return Record(objects[0], tuple(objects[1:-2]), objects[-2], objects[-1], lines)


def _require_canonical(number: int, line: str, value: dict[str, Any]) -> None:
    """The seal has one form; the bytes of every other line are pinned by the line after it."""
    if canonical(value) != line:
        raise InvalidRecord(f"line {number}", line[:60], "must be canonical JSON (RFC 8785), as every line is")


def _lines(path: Path) -> tuple[str, ...]:
    """The lines of a file, each of which ends with a line feed."""
    *lines, rest = _text(path).split("\n")
    if rest:
        raise InvalidRecord(f"line {len(lines) + 1}", rest[:60], "must end with a line feed, as every line does")
    return tuple(lines)


def _text(path: Path) -> str:
    try:
        return path.read_bytes().decode("utf-8")
    except UnicodeDecodeError as error:
        raise InvalidRecord("line 1", str(path), f"must be UTF-8 text: {error}") from None


def _object(number: int, line: str) -> dict[str, Any]:
    try:
        value = parse(line)
    except (ValueError, RecursionError) as error:
        raise InvalidRecord(f"line {number}", line[:60], f"must be JSON: {error}") from None
    if not isinstance(value, dict):
        raise InvalidRecord(f"line {number}", line[:60], "must be a JSON object")
    return value
