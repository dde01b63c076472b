"""Which engine made a record: the version, and a digest of the code that decides what happens."""

import hashlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any, Self

_DECIDING = ("physics", "referee.game", "referee.rules", "referee.play")
"""Packages whose code a game's course depends on. Any edit there makes another engine: stricter than need be,
but a record must never be called false because of a change in the engine, nor true in spite of one."""


@dataclass(frozen=True, slots=True)
class Engine:
    """An engine.

    Attributes:
        version: of the distribution ``pooliad``.
        digest: SHA-256 over the deciding packages' source files, hex.
    """

    version: str
    digest: str

    def __str__(self) -> str:
        return f"pooliad {self.version} (engine {self.digest[:12]})"

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for the record's header."""
        return {"version": self.version, "digest": self.digest}

    @classmethod
    def from_dict(cls, values: Any) -> Self:
        """Read what ``to_dict`` wrote; ValueError if it is anything else."""
        if (
            not isinstance(values, Mapping)
            or set(values) != {"version", "digest"}
            or not all(isinstance(value, str) for value in values.values())
        ):
            raise ValueError("must be an object with the strings version and digest")
        return cls(**values)


@cache
def this_engine() -> Engine:
    """The engine that is running."""
    total = hashlib.sha256()
    for package in _DECIDING:
        for name, source in sorted(_sources(files(package), package)):
            total.update(f"{name}\0{hashlib.sha256(source).hexdigest()}\n".encode())
    return Engine(_version(), total.hexdigest())


def _version() -> str:
    """The installed version; code that runs without being installed has only its digest."""
    try:
        return version("pooliad")
    except PackageNotFoundError:
        return "not installed"


def _sources(folder: Traversable, name: str) -> Iterator[tuple[str, bytes]]:
    """(dotted name, bytes) of every Python file, line endings made equal."""
    for entry in folder.iterdir():
        if entry.name.endswith(".py"):
            yield f"{name}.{entry.name}", entry.read_bytes().replace(b"\r\n", b"\n")
        elif entry.is_dir() and entry.name.isidentifier():
            yield from _sources(entry, f"{name}.{entry.name}")
