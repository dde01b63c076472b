"""Which engine made a record: the version, and a digest of the code that decides what happens."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.resources import files
from importlib.resources.abc import Traversable
from typing import Any, Self

from referee.record.sources import digest_of_sources

_DECIDING = ("physics", "referee.game", "referee.rules", "referee.play")
"""Packages whose code a game's course depends on. Whatever that code says otherwise than before makes another engine:
stricter than need be, but a record must never be called false because of a change in the engine, nor true in spite
of one."""


@dataclass(frozen=True, slots=True)
class Engine:
    """An engine. Two with the same digest are the same one.

    Attributes:
        version: of the distribution ``pooliad`` it came with.
        digest: SHA-256 (hex) of what the deciding packages' sources say (``digest_of_sources``); of version 0.1.0 it is
            that of their bytes.
    """

    version: str
    digest: str

    def __str__(self) -> str:
        return f"pooliad {self.version} (engine {self.digest[:12]})"

    def is_same(self, other: "Engine") -> bool:
        """Whether the two decide alike."""
        return self.digest == other.digest

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
    return Engine(_version(), digest_of_sources(deciding_sources()))


def deciding_sources() -> dict[str, bytes]:
    """The files that the digest covers, by the name of their module."""
    return {name: source for package in _DECIDING for name, source in _sources(files(package), package)}


def _version() -> str:
    """The installed version; code that runs without being installed has only its digest."""
    try:
        return version("pooliad")
    except PackageNotFoundError:
        return "not installed"


def _sources(folder: Traversable, package: str) -> Iterator[tuple[str, bytes]]:
    """(module, bytes) of every Python file."""
    for entry in folder.iterdir():
        if entry.name.endswith(".py"):
            yield f"{package}.{entry.name.removesuffix('.py')}".removesuffix(".__init__"), entry.read_bytes()
        elif entry.is_dir() and entry.name.isidentifier():
            yield from _sources(entry, f"{package}.{entry.name}")
