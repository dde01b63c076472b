"""How matches and games show themselves in a notebook: a replay to watch."""

import re
from collections.abc import Iterable, Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pictures
    from referee.play import Stroke
    from referee.record import Header

HEIGHT = 640
"""Pixels of a replay in a page."""

SEAT = re.compile(r"\b[Pp]layer ([01])\b")
"""How a ruling, which knows no names, speaks of the players."""


def replay_of(games: Iterable[tuple["Header", Sequence["Stroke"]]], title: str) -> str:
    """An inline frame that plays the games, every stroke with its ruling; empty where nothing was played."""
    import pictures

    scenes = [scene for header, strokes in games for scene in _scenes(header, strokes)]
    if not scenes:
        return f"<p>{escape(title)}</p>"
    page = escape(pictures.html(scenes, title=title))
    return f'<iframe srcdoc="{page}" title="{escape(title)}" style="width:100%;height:{HEIGHT}px;border:0"></iframe>'


def _scenes(header: "Header", strokes: Sequence["Stroke"]) -> Iterator["pictures.ReplayShot"]:
    from physics import simulate
    from pictures import ReplayShot

    table = header.terms.rules.table
    for stroke in strokes:
        if stroke.shot is not None:  # simulated again: a game need not keep the events of its strokes
            words = SEAT.sub(lambda found: header.players[int(found[1])], stroke.ruling.words)
            yield ReplayShot(simulate(table, stroke.before, stroke.shot), words)
