"""How matches and games show themselves in a notebook: a line of text, or a replay to watch."""

import re
from collections.abc import Iterable, Iterator
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pictures
    from client.local import LocalMatch
    from client.local_game import PlayedGame

HEIGHT = 640
"""Pixels of a replay in a page."""

SEAT = re.compile(r"\b[Pp]layer ([01])\b")
"""How a ruling, which knows no names, speaks of the players."""


def line_of(game: "PlayedGame") -> str:
    """Who played, who won and why."""
    players, outcome = game.header.players, game.outcome
    winner = "nobody" if outcome.winner is None else players[outcome.winner]
    return f"{players[0]} against {players[1]}: {winner} wins, {outcome.reason}, {len(game.strokes)} strokes"


def replay_of(games: Iterable["PlayedGame"], title: str) -> str:
    """An inline frame that plays the games, every stroke with its ruling; empty where nothing was played."""
    import pictures

    scenes = [scene for game in games for scene in _scenes(game)]
    if not scenes:
        return f"<p>{escape(title)}</p>"
    page = escape(pictures.html(scenes, title=title))
    return f'<iframe srcdoc="{page}" title="{escape(title)}" style="width:100%;height:{HEIGHT}px;border:0"></iframe>'


def match_line(match: "LocalMatch") -> str:
    """Who played and how it ended."""
    first, second = match.score
    return f"{match.players[0]} {first:g} : {second:g} {match.players[1]}, seed {match.seed}"


def _scenes(game: "PlayedGame") -> Iterator["pictures.ReplayShot"]:
    from physics import simulate
    from pictures import ReplayShot

    table = game.header.terms.rules.table
    for stroke in game.strokes:
        if stroke.shot is not None:  # simulated again: a game need not keep the events of its strokes
            words = SEAT.sub(lambda found: game.header.players[int(found[1])], stroke.ruling.words)
            yield ReplayShot(simulate(table, stroke.before, stroke.shot), words)
