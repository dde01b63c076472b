"""Reading a record: from a file or from lines, to the header, the entries and the end."""

import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from referee.errors import RefereeError
from referee.record.canonical import parse


class InvalidRecord(RefereeError):
    """A record that cannot be read; ``field`` names the line."""


@dataclass(frozen=True, slots=True)
class Record:
    """A record as it was read, nothing checked but its form.

    Attributes:
        header: the first line's object.
        entries: one object for each stroke or decision.
        end: the last line's object.
    """

    header: dict[str, Any]
    entries: tuple[dict[str, Any], ...]
    end: dict[str, Any]


def read_record(source: str | os.PathLike[str] | Iterable[str]) -> Record:
    """Read a finished game's record.

    Args:
        source: path of a file, or the lines themselves.

    Raises:
        InvalidRecord: a line is not JSON, or the lines are not a header, strokes and an end.
        OSError: the file cannot be read.
    """
    if isinstance(source, str | os.PathLike):
        source = _text(Path(source)).split("\n")
    objects = [_object(number, line) for number, line in enumerate(source, 1) if line.strip()]
    if not objects:
        raise InvalidRecord("line 1", None, "a record starts with a header; this one is empty")
    kinds = [line.get("type") for line in objects]
    expected = ["game", *["stroke"] * (len(objects) - 2), "end"]
    for number, (kind, wanted) in enumerate(zip(kinds, expected, strict=False), 1):
        if kind != wanted:
            raise InvalidRecord(f"line {number}, type", kind, f"must be {wanted!r}: header, strokes, end")
    if len(objects) < 2:
        raise InvalidRecord("line 2", None, "the record ends before the game does: no end line")
    return Record(objects[0], tuple(objects[1:-1]), objects[-1])


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8")
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
