"""What a message has in memory: its fields, and beside them what was made of those."""

from collections.abc import Callable
from typing import Any, TypeVar

from pydantic import BaseModel

from protocol.values import Message

STATE, TABLE, MAKER = "_state", "_table", "_late"
"""Where a view keeps, beside its fields, what was made of its balls and its table, and what makes fields that nobody
has read yet; models leave such names alone."""
IN_MEMORY = BaseModel.__dict__["__dict__"]

Source = TypeVar("Source")
Made = TypeVar("Made")


def fields_of(message: BaseModel) -> dict[str, Any]:
    """The fields that a message has in memory; of a view, without those that nobody has read yet."""
    values: dict[str, Any] = IN_MEMORY.__get__(message)
    return values


def made(message: Message, name: str, source: Source, make: Callable[[Source], Made]) -> Made:
    """What ``make`` makes of a field, made once: views are asked for it again and again."""
    values = fields_of(message)
    kept = values.get(name)
    if kept is None or kept[0] is not source:  # a copy of the message may have another field
        kept = values[name] = source, make(source)
    made: Made = kept[1]
    return made
