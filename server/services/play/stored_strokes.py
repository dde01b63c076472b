"""Strokes as the database has them: each once, as the line of its record, compressed.

What players are told of a stroke follows from its line. Version 0.1.0 stored that beside it, and strokes of very many
events still have it: to read megabytes for a summary would make every view dear that shows it. It stored lines as they
are, and such rows stay.
"""

import zlib
from collections.abc import Mapping
from typing import Any, Final

from pydantic_core import from_json
from sqlalchemy import Row, Text, case, cast

from protocol import StrokeDetail, StrokeView
from server.store.tables import moves

MOST_EVENTS: Final = 500
"""Of a stroke that is stored once. Beyond, a summary of 3 kB stands beside a line of 100 kB and more."""

LEVEL, WINDOW_BITS, MEMORY_LEVEL = 1, 13, 6
"""Of compression: a line becomes half as long. More takes longer; so does more memory, which is cleared each time."""

_IS_ALONE: Final = cast(moves.c.stroke, Text) == "null"
SUMMED: Final = (
    moves.c.stroke,
    *(case((_IS_ALONE, column)).label(column.name) for column in (moves.c.line, moves.c.packed)),
)
"""What `view` and `entry` need. The line of a stroke that has its summary is not read."""
LINE: Final = (moves.c.line, moves.c.packed)
"""What `line` needs."""
DECIDES: Final = '{"action":{"decision":'
"""How the line of a decision begins, and no stroke's: its names are in order, as everywhere in canonical JSON."""


def columns(line: str, summary: Mapping[str, Any] | None) -> dict[str, Any]:
    """The columns of `moves` that say what happened: the record's line, and a `StrokeDetail` without events or None."""
    packing = zlib.compressobj(LEVEL, zlib.DEFLATED, WINDOW_BITS, MEMORY_LEVEL)
    return {"line": "", "packed": packing.compress(line.encode()) + packing.flush(), "stroke": summary}


def line(row: Row[Any]) -> str:
    """The line of the record, from `LINE`."""
    return _text(row).decode()


def _text(row: Row[Any]) -> bytes:
    return zlib.decompress(row.packed) if row.packed is not None else bytes(row.line, "utf-8")


def view(row: Row[Any]) -> StrokeView:
    """A stroke as views show it, from `SUMMED`."""
    if row.stroke is None:
        return StrokeView.of_entry(from_json(_text(row)))
    return StrokeView.model_validate(row.stroke)


def detail(row: Row[Any]) -> StrokeDetail:
    """A stroke as histories show it, from the whole row."""
    entry = from_json(_text(row))
    if row.stroke is None:
        return StrokeDetail.of_entry(entry)
    return StrokeDetail.model_validate(row.stroke | {"events": entry.get("events", ())})


def entry(row: Row[Any]) -> dict[str, Any]:
    """What was asked for, and the table before and after, from `SUMMED`; no `shot` in that of a decision."""
    return dict(from_json(_text(row)) if row.stroke is None else row.stroke)


def is_decision(text: str) -> bool:
    """Whether a line is that of a decision."""
    return text.startswith(DECIDES)
