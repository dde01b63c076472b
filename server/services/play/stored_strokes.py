"""Strokes as the database has them: each once, as the line of its record.

What players are told of a stroke follows from its line. Version 0.1.0 stored that beside it, and strokes of very many
events still have it: to read megabytes for a summary would make every view dear that shows it.
"""

from typing import Any, Final

from pydantic_core import from_json
from sqlalchemy import Row, Text, case, cast

from protocol import StrokeDetail, StrokeView
from server.store.tables import moves

MOST_EVENTS: Final = 500
"""Of a stroke that is stored once. Beyond, a summary of 3 kB stands beside a line of 100 kB and more."""

SUMMED: Final = (moves.c.stroke, case((cast(moves.c.stroke, Text) == "null", moves.c.line)).label("line"))
"""What `view` and `entry` need: one of the two. The line of a stroke that has its summary is not read."""
DECIDES: Final = '{"action":{"decision":'
"""How the line of a decision begins, and no stroke's: its names are in order, as everywhere in canonical JSON."""


def view(row: Row[Any]) -> StrokeView:
    """A stroke as views show it, from `SUMMED`."""
    if row.stroke is None:
        return StrokeView.of_entry(from_json(row.line))
    return StrokeView.model_validate(row.stroke)


def detail(row: Row[Any]) -> StrokeDetail:
    """A stroke as histories show it, from the whole row."""
    entry = from_json(row.line)
    if row.stroke is None:
        return StrokeDetail.of_entry(entry)
    return StrokeDetail.model_validate(row.stroke | {"events": entry.get("events", ())})


def entry(row: Row[Any]) -> dict[str, Any]:
    """What was asked for, and the table before and after, from `SUMMED`; no `shot` in that of a decision."""
    return dict(from_json(row.line) if row.stroke is None else row.stroke)


def is_decision(line: str) -> bool:
    """Whether a line is that of a decision."""
    return line.startswith(DECIDES)
