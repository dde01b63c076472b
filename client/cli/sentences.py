"""A stroke in a sentence: who, what was called, what came of it."""

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from protocol import StrokeView

_SEAT = re.compile(r"\b[Pp]layer ([01])\b")
"""How a ruling, which knows no names, speaks of the players."""


def sentence(stroke: int | None, players: tuple[str, str], words: str, rules: Sequence[str]) -> str:
    """For example `  12  greedy makes solid 3 in pocket SW; greedy goes on. (R28)`; a dash for decisions."""
    number = "   -" if stroke is None else f"{stroke + 1:4d}"
    named = _SEAT.sub(lambda found: players[int(found[1])], words)
    return f"{number}  {named} ({', '.join(rules)})"


def sentence_of(stroke: StrokeView, players: tuple[str, str]) -> str:
    """The sentence for a stroke as a server tells it."""
    return sentence(stroke.stroke, players, stroke.ruling.words, stroke.ruling.rules)


def summary(game: Mapping[str, Any], players: tuple[str, str]) -> Iterator[str]:
    """A finished game in a few lines, from its tally."""
    ending = f"{game['reason']}, {game['rule']}" if game["rule"] else game["reason"]
    yield f"game {game['number'] + 1}: {game['winner'] or 'nobody'} wins ({ending})"
    yield f"  {game['strokes']} strokes, {game['simulated_seconds']:.1f} s on the table"
    for seat, name in enumerate(players):
        fouls = ", ".join(f"{rule} x{times}" for rule, times in game["fouls"][seat].items()) or "no fouls"
        made = f"{game['made'][seat]} of {game['called'][seat]} called balls made"
        yield f"  {name}: {game['strokes_by_seat'][seat]} strokes, {made}, {fouls}"
    yield f"  record: {game['record']}"
    yield f"  verify: {game['verify']}"
