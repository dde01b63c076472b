"""The chain: every line of a record names the line before it by its SHA-256, the first one a fixed value.

Whoever changes, drops, adds or exchanges a line would have to write all that follow anew, and the last one is
signed.
"""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

from referee.record.canonical import canonical

GENESIS: Final = hashlib.sha256(b"pooliad/1 record").hexdigest()
"""What a record's first line has for the line before it."""

PREVIOUS: Final = "previous"


def line_digest(line: str) -> str:
    """What the next line calls this one: SHA-256 of its UTF-8 bytes without the line feed, hex."""
    return hashlib.sha256(line.encode()).hexdigest()


def _joined(values: Mapping[str, Any], written: Mapping[str, str]) -> str:
    """The canonical text of an object some of whose members are written: by key, in the order of UTF-16 (RFC 8785)."""
    members = {key: canonical(value) for key, value in values.items()} | dict(written)
    keys = sorted(members, key=lambda key: key.encode("utf-16-be"))
    return "{" + ",".join(f"{canonical(key)}:{members[key]}" for key in keys) + "}"


class Chain:
    """Lines being written one after the other.

    Attributes:
        head: the digest of the last line written; to go on with a chain, start from it.
    """

    def __init__(self, head: str = GENESIS) -> None:
        self.head = head

    def add(self, entry: Mapping[str, Any], written: Mapping[str, str] | None = None) -> str:
        """The next line: the entry with the line before it, in canonical form.

        ``written``: further members of the entry, each in canonical form already.
        """
        values = {**entry, PREVIOUS: self.head}
        line = canonical(values) if written is None else _joined(values, written)
        self.head = line_digest(line)
        return line


@dataclass(frozen=True, slots=True)
class ChainFault:
    """Where a chain is broken.

    Attributes:
        line: the first line, from 1, that does not continue the one before it.
        recorded: what it calls that one. derived: what that one is called.
    """

    line: int
    recorded: Any
    derived: str

    def __str__(self) -> str:
        if self.line == 1:
            return f"line 1 does not start a chain: its {PREVIOUS} is {self.recorded!r}, not {self.derived!r}"
        return (
            f"line {self.line} does not continue line {self.line - 1} as it stands ({self.recorded!r}, not "
            f"{self.derived!r}): line {self.line - 1} was changed, or lines were dropped, added or exchanged"
        )


def chain_fault(lines: Sequence[str], entries: Sequence[Mapping[str, Any]]) -> ChainFault | None:
    """The first break in a chain of lines, given as they are and as they read; None if it is whole."""
    head = GENESIS
    for number, (line, entry) in enumerate(zip(lines, entries, strict=True), 1):
        if entry.get(PREVIOUS) != head:
            return ChainFault(number, entry.get(PREVIOUS), head)
        head = line_digest(line)
    return None
