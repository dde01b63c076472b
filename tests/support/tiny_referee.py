"""A referee for a few balls with groups, written a second time and as shortly as the rules allow.

It shares nothing with the package `referee`: play after the break, no noise, groups fixed, from the events of a shot
alone (docs/rules.md: R23 to R35, R42 to R46).
"""

from dataclasses import dataclass, field
from typing import Any

from physics import Shot, Table, TableState, simulate

EIGHT = 8
SOLIDS, STRIPES = set(range(1, 8)), set(range(9, 16))


@dataclass
class TinyReferee:
    """A game: where the balls lie, whose turn it is, the version, and what was accepted so far."""

    table: Table
    balls: dict[int, tuple[float, float]]
    turn: int = 0
    version: int = 1
    in_hand: bool = False
    winner: int | None = None
    history: list[dict[str, Any]] = field(default_factory=list)

    @property
    def callable(self) -> list[int]:
        """The group of whoever is in turn, or the 8 when it is cleared."""
        group = (SOLIDS, STRIPES)[self.turn]
        return sorted(group & set(self.balls)) or [EIGHT]

    def play(self, shot: dict[str, float], call: Any, cue_ball: list[float] | None) -> None:
        """Accept a stroke and rule on it."""
        before = dict(self.balls) | ({} if cue_ball is None else {0: (cue_ball[0], cue_ball[1])})
        result = simulate(self.table, TableState.from_positions(before), Shot(**shot))
        seat, targets = self.turn, self.callable
        down = {event.ball: event.other for event in result.events if event.kind == "pocket_collision"}
        foul = self._is_foul(result.events, targets, down)
        made = call != "safety" and down.get(call["ball"]) == call["pocket"]
        places = {ball: result.final.position(ball) for ball in result.final.balls}
        self.balls = {ball: place for ball, place in places.items() if place}
        if EIGHT in down:
            won = targets == [EIGHT] and made and not foul
            self.winner = seat if won else 1 - seat
        self.in_hand = foul
        self.turn = seat if made and not foul else 1 - seat
        self.version += 1
        self.history.append({"seat": seat, "shot": shot, "final": result.final.to_dict()})

    def concede(self) -> None:
        self.history.append({"seat": self.turn})
        self.winner = 1 - self.turn
        self.version += 1

    @staticmethod
    def _is_foul(events: Any, targets: list[int], down: dict[int, int]) -> bool:
        contacts = [event for event in events if event.kind == "ball_collision" and 0 in (event.ball, event.other)]
        if not contacts or 0 in down:
            return True
        first = contacts[0]
        struck = {event.ball or event.other for event in contacts if event.time == first.time}
        cushion = any(event.kind == "rail_collision" and event.index > first.index for event in events)
        return not struck & set(targets) or not (down or cushion)
