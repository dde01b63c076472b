"""What a match came to: numbers gathered stroke by stroke, for people and as JSON."""

import shlex
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from protocol import GameSummary, StrokeView
from protocol.shots import CallRequest


@dataclass(slots=True)
class GameTally:
    """One game's numbers.

    Attributes:
        strokes: played, by seat. fouls: how often each rule id was broken, by seat.
        called, made: balls called, and called balls pocketed on a fair stroke, by seat.
        simulated: s of table time.
    """

    strokes: list[int] = field(default_factory=lambda: [0, 0])
    fouls: tuple[Counter[str], Counter[str]] = field(default_factory=lambda: (Counter(), Counter()))
    called: list[int] = field(default_factory=lambda: [0, 0])
    made: list[int] = field(default_factory=lambda: [0, 0])
    simulated: float = 0.0

    def add(self, stroke: StrokeView) -> None:
        """Count a stroke; decisions are not strokes."""
        if stroke.shot is None:
            return
        seat = stroke.seat
        self.strokes[seat] += 1
        self.fouls[seat].update(stroke.ruling.fouls)
        self.simulated += stroke.duration or 0.0
        if isinstance(stroke.action.call, CallRequest):
            self.called[seat] += 1
            self.made[seat] += stroke.ruling.made

    def value(self, game: GameSummary, players: tuple[str, str], record: Path, keys: Path) -> dict[str, Any]:
        """Everything about the game, as JSON; `keys` is the file with those that the record is signed with."""
        outcome = game.outcome
        winner = None if outcome is None else outcome.winner
        return {
            "id": game.id,
            "number": game.number,
            "breaker": players[game.breaker],
            "winner": None if winner is None else players[winner],
            "winner_seat": winner,
            "reason": None if outcome is None else outcome.reason.value,
            "rule": None if outcome is None else outcome.rule,
            "strokes": sum(self.strokes),
            "strokes_by_seat": self.strokes,
            "fouls": [dict(sorted(fouls.items())) for fouls in self.fouls],
            "called": self.called,
            "made": self.made,
            "simulated_seconds": round(self.simulated, 3),
            "record": str(record),
            "verify": f"pooliad replay verify {shlex.quote(str(record))} --key {shlex.quote(str(keys))}",
        }
