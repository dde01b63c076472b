"""Follow a match from its first stroke to its last, by asking the server again and again."""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from client.http import Pooliad
from protocol import GameSummary, StrokeView

LOOK_EVERY = 0.1
"""Seconds between two looks at a running match."""


@dataclass(frozen=True, slots=True)
class Played:
    """A stroke, and the game it was played in."""

    game: GameSummary
    stroke: StrokeView


@dataclass(frozen=True, slots=True)
class Ended:
    """A game that has ended; all its strokes came before."""

    game: GameSummary


def follow(server: Pooliad, match_id: str, check: Callable[[], None]) -> Iterator[Played | Ended]:
    """What happens in a match, in order, until it is over; `check` is called between looks and may raise."""
    number = 0
    while True:
        match = server.match(match_id)
        if number < len(match.played):
            yield from _follow_game(server, match.played[number], check)
            number += 1
        elif match.status in ("finished", "aborted"):
            return
        else:
            check()
            time.sleep(LOOK_EVERY)


def _follow_game(server: Pooliad, game: GameSummary, check: Callable[[], None]) -> Iterator[Played | Ended]:
    """One game's strokes, and its end."""
    seen = 0
    while True:
        game = server.game(game.id)  # read before the strokes: when it says "finished", they are all there
        strokes = _strokes_from(server, game.id, seen)
        for stroke in strokes:
            yield Played(game, stroke)
        seen += len(strokes)
        if game.status != "running":
            yield Ended(game)
            return
        check()
        time.sleep(LOOK_EVERY)


def _strokes_from(server: Pooliad, game_id: str, cursor: int) -> list[StrokeView]:
    """Every stroke from the `cursor`-th on."""
    strokes: list[StrokeView] = []
    while True:
        page = server.shots(game_id, cursor + len(strokes))
        strokes.extend(page.shots)
        if page.next_cursor is None or not page.shots:
            return strokes
