"""Fields of an event's terms that a type alone does not describe: its table, its seed, its lots."""

from collections.abc import Mapping
from typing import Any

from tournament.errors import InvalidSpec


def table_of(value: Any) -> str | Mapping[str, Any]:
    """A table's name or its parameters; the physics says whether they make a table."""
    from physics import Table
    from physics.table import NAMED

    if isinstance(value, str) and value in NAMED:
        return value
    if not isinstance(value, Mapping):
        raise InvalidSpec("", value, f"must be {', '.join(NAMED)} or a table's parameters")
    return Table.from_dict(value).to_dict()


def seed_of(value: Any) -> int | str | None:
    """An integer, 64 hexadecimal digits, or None where it is to be drawn."""
    if isinstance(value, str):
        return _secret(value, "64 lower-case hexadecimal digits, or an integer")
    if isinstance(value, bool) or not isinstance(value, int | None) or not 0 <= (value or 0) < 2**63:
        raise InvalidSpec("", value, f"must be an integer from 0 to {2**63 - 1}, or 64 hexadecimal digits")
    return value


def lots_of(value: Any) -> str | None:
    """64 hexadecimal digits, or None where no server has drawn any."""
    return None if value is None else _secret(value, "64 lower-case hexadecimal digits")


def _secret(value: Any, allowed: str) -> str:
    """A secret in writing; the error does not repeat it."""
    if not isinstance(value, str) or len(value) != 64 or not set(value) <= set("0123456789abcdef"):
        shown = f"<{len(value)} letters>" if isinstance(value, str) else type(value).__name__
        raise InvalidSpec("", shown, f"must be {allowed}")
    return value
