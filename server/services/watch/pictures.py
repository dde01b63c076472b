"""Pictures of games: how the balls lie, what a stroke did."""

import json
from functools import lru_cache
from typing import Any, Final

from sqlalchemy import select

import pictures
from physics import Shot, Table, TableState, simulate
from server.errors import NotFound, invalid_field
from server.services.play import stored_strokes
from server.services.play.live_game import find
from server.services.runtime.context import Context
from server.services.watch.previews import DRAWS_PNG, WIDTH
from server.store.tables import moves

LONGEST_NUMBER = 9
"""Digits of a stroke's number."""
PNGS: Final = 128
"""Pictures as PNG that are kept: one takes 0.1 s to draw, and everybody to whom a link is sent asks for the same."""


def position(context: Context, game_id: str, theme: str, upright: bool) -> tuple[str, int]:
    """The balls of a game as they lie, and its version; raises `NotFound`."""
    _refuse_theme(theme)
    with context.database.reading() as connection:
        live = find(connection, game_id)
    return pictures.svg(live.game.state, table=live.rules.table, theme=theme, upright=upright), live.row.version


def position_as_png(context: Context, game_id: str) -> tuple[bytes, int]:
    """The balls of a game as they lie, for a link's preview, and its version; raises `NotFound`."""
    if not DRAWS_PNG:
        raise NotFound("this server draws no PNG: it takes the extra, pip install 'pooliad[pictures]'")
    with context.database.reading() as connection:
        live = find(connection, game_id)
    values = (json.dumps(each.to_dict()) for each in (live.game.state, live.rules.table))
    return _position_as_png(*values), live.row.version


@lru_cache(PNGS)
def _position_as_png(state: str, table: str) -> bytes:
    places, shape = TableState.from_dict(json.loads(state)), Table.from_dict(json.loads(table))
    return pictures.png(places, table=shape, width=WIDTH)


def stroke(context: Context, game_id: str, number: str, theme: str, upright: bool) -> str:
    """What a stroke did, by its place in the history from 0; raises `NotFound`, of a decision too."""
    _refuse_theme(theme)
    nothing = NotFound(f"there is no stroke {number} in game {game_id}")
    with context.database.reading() as connection:
        live = find(connection, game_id)
        if not (number.isascii() and number.isdigit() and len(number) <= LONGEST_NUMBER):
            raise nothing
        ours = (moves.c.game_id == game_id) & (moves.c.number == int(number))
        row: Any = connection.execute(select(*stored_strokes.SUMMED).where(ours)).one_or_none()
    if row is None or (entry := stored_strokes.entry(row)).get("shot") is None:
        raise nothing
    return _drawn(live.rules.table, entry, theme, upright)


def _drawn(table: Table, entry: dict[str, Any], theme: str, upright: bool) -> str:
    """The stroke simulated again; only how it began where another release's engine does not end it as it was."""
    before, shot = TableState.from_dict(entry["before"]), Shot.from_dict(entry["shot"])
    call = entry["action"].get("call")
    look: dict[str, Any] = {"shot": shot, "theme": theme, "upright": upright}
    look |= {"call": (call["ball"], call["pocket"])} if isinstance(call, dict) else {}
    result = simulate(table, before, shot)
    if result.final.to_dict() != entry["final"]:
        return pictures.svg(before, table=table, **look)
    return pictures.svg(result, **look)


def _refuse_theme(theme: str) -> None:
    if theme not in pictures.THEMES:
        raise invalid_field("theme", theme, f"one of {', '.join(pictures.THEMES)}")
