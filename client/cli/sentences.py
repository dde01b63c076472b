"""A stroke in a sentence: who, what was called, what came of it."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from physics.constants import POCKET_NAMES
from referee import Action, Call
from referee.wire import StrokeView


def sentence(stroke: int | None, player: str, action: Action, words: str, rules: Sequence[str]) -> str:
    """For example `12  greedy calls the 3 in SW: made, shoots again (R28)`; decisions have no number."""
    number = "  -" if stroke is None else f"{stroke + 1:3d}"
    return f"{number}  {player} {intention(action)}: {words} ({', '.join(rules)})"


def sentence_of(stroke: StrokeView, players: tuple[str, str]) -> str:
    """The sentence for a stroke as a server tells it."""
    ruling = stroke.ruling
    return sentence(
        stroke.stroke, players[stroke.seat], stroke.action.to_action(), ruling.words, ruling.rules
    )


def intention(action: Action) -> str:
    """What the player meant to do, as a verb phrase."""
    if action.decision is not None:
        return f"decides to {action.decision.replace('_', ' ')}"
    if isinstance(action.call, Call):
        return f"calls the {action.call.ball} in {POCKET_NAMES[action.call.pocket]}"
    return "breaks" if action.call is None else "plays safe"


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
