"""The state of a game between two actions: an immutable value that JSON carries without loss."""

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from enum import StrEnum
from typing import Any, TypeVar

from physics.state import TableState
from referee.errors import InvalidGame
from referee.game.action import Decision
from referee.game.outcome import Outcome
from referee.game.rule_id import plain_id


class Phase(StrEnum):
    """What the game awaits."""

    BREAK = "break"
    PLAY = "play"
    DECISION = "decision"
    RERACK = "rerack"
    """A new rack, from whoever drives the game: ``EightBall.rerack``. No player acts in this phase."""
    OVER = "over"


class CueBallArea(StrEnum):
    """Where the player in turn may put a cue ball in hand."""

    KITCHEN = "kitchen"
    ANYWHERE = "anywhere"


class Group(StrEnum):
    """Solids are 1-7, stripes 9-15."""

    SOLIDS = "solids"
    STRIPES = "stripes"


@dataclass(frozen=True, slots=True)
class Game:
    """Everything that the next ruling depends on.

    Attributes:
        state: the balls on the table. A pocketed cue ball is absent until it is placed; so is an 8 pocketed
            on the break while the choice whether to spot it is open.
        phase: what is awaited.
        turn: seat (0 or 1) of the player who acts; in phase ``rerack`` of the player who will break.
        breaker: seat that broke first in this game; replays of the rack fall to it again.
        groups: the group of seat 0 and of seat 1; None on an open table.
        cue_ball_in_hand: where the player in turn may put the cue ball; None: it lies where it lies.
        decisions: the choices now open, in phase ``decision``.
        choice: id of the rule that grants these choices.
        stroke: index of the next stroke in this game, re-racks included; a decision is no stroke.
        rack: index of the present rack: 0, then one more after every re-rack.
        visit_strokes: strokes the player in turn has played since coming to the table.
        dry_visits: consecutive finished visits without a ball pocketed (R49).
        replays: racks replayed because of a stalemate (R49).
        outcome: the result, in phase ``over``.
    """

    state: TableState
    phase: Phase
    turn: int
    breaker: int
    groups: tuple[Group, Group] | None = None
    cue_ball_in_hand: CueBallArea | None = None
    decisions: tuple[Decision, ...] = ()
    choice: str | None = None
    stroke: int = 0
    rack: int = 0
    visit_strokes: int = 0
    dry_visits: int = 0
    replays: int = 0
    outcome: Outcome | None = None

    @property
    def strokes_played(self) -> int:
        """Strokes played in this game, miscues and replayed racks included."""
        return self.stroke

    @property
    def opponent(self) -> int:
        """The seat that is not in turn."""
        return 1 - self.turn

    @property
    def is_over(self) -> bool:
        """The game has an outcome."""
        return self.phase is Phase.OVER

    def group_of(self, seat: int) -> Group | None:
        """The seat's group, None on an open table."""
        return None if self.groups is None else self.groups[seat]

    def exchanged(self) -> "Game":
        """The same game with the seats exchanged: what was to be played by one is to be played by the other."""
        outcome = self.outcome
        if outcome is not None and outcome.winner is not None:
            outcome = replace(outcome, winner=1 - outcome.winner)
        groups = None if self.groups is None else (self.groups[1], self.groups[0])
        return replace(self, turn=1 - self.turn, breaker=1 - self.breaker, groups=groups, outcome=outcome)

    def to_dict(self) -> dict[str, Any]:
        """JSON form; ``Game.from_dict(json.loads(json.dumps(game.to_dict()))) == game``."""
        data = {name: getattr(self, name) for name in _PLAIN}
        return data | {
            "state": self.state.to_dict(),
            "choice": None if self.choice is None else plain_id(self.choice),
            "phase": self.phase.value,
            "groups": None if self.groups is None else [group.value for group in self.groups],
            "cue_ball_in_hand": None if self.cue_ball_in_hand is None else self.cue_ball_in_hand.value,
            "decisions": [decision.value for decision in self.decisions],
            "outcome": None if self.outcome is None else self.outcome.to_dict(),
        }

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> "Game":
        """Read what ``to_dict`` wrote.

        Raises:
            InvalidGame: a key is missing or unknown, or a value is not one of its kind.
            physics.InvalidState: the balls do not lie on a table.
        """
        _check_shape(data)
        return cls(
            state=TableState.from_dict(data["state"]),
            phase=_member(Phase, "phase", data["phase"]),
            turn=_seat("turn", data["turn"]),
            breaker=_seat("breaker", data["breaker"]),
            groups=_groups(data["groups"]),
            cue_ball_in_hand=_optional(CueBallArea, "cue_ball_in_hand", data["cue_ball_in_hand"]),
            decisions=tuple(_member(Decision, "decisions", one) for one in data["decisions"]),
            choice=_rule("choice", data["choice"]),
            outcome=None if data["outcome"] is None else Outcome.from_dict(data["outcome"]),
            **{name: _count(name, data[name]) for name in _COUNTS},
        )


_COUNTS = ("stroke", "rack", "visit_strokes", "dry_visits", "replays")
_PLAIN = ("turn", "breaker", *_COUNTS)
_NAMES = {field.name for field in fields(Game)}

_SHAPES: dict[str, type] = {"state": Mapping, "decisions": list}


def _check_shape(data: Any) -> None:
    if not isinstance(data, Mapping):
        raise InvalidGame("game", data, "an object")
    if set(data) != _NAMES:
        raise InvalidGame("game", sorted(set(data) ^ _NAMES), f"exactly the keys {sorted(_NAMES)}")
    for name, shape in _SHAPES.items():
        if not isinstance(data[name], shape):
            raise InvalidGame(name, data[name], "an object" if shape is Mapping else "a list")


E = TypeVar("E", bound=StrEnum)


def _member(kind: type[E], name: str, value: Any) -> E:
    try:
        return kind(value)
    except ValueError:
        raise InvalidGame(name, value, f"one of {', '.join(kind)}") from None


def _optional(kind: type[E], name: str, value: Any) -> E | None:
    return None if value is None else _member(kind, name, value)


def _count(name: str, value: Any) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise InvalidGame(name, value, "an integer of at least 0")
    return value


def _seat(name: str, value: Any) -> int:
    if _count(name, value) > 1:
        raise InvalidGame(name, value, "seat 0 or 1")
    return int(value)


def _rule(name: str, value: Any) -> str | None:
    if value is not None and not isinstance(value, str):
        raise InvalidGame(name, value, "a rule id or null")
    return value


def _groups(value: Any) -> tuple[Group, Group] | None:
    if value is None:
        return None
    if isinstance(value, list | tuple) and sorted(map(str, value)) == [Group.SOLIDS, Group.STRIPES]:
        return Group(value[0]), Group(value[1])
    raise InvalidGame("groups", value, 'null, ["solids", "stripes"] or ["stripes", "solids"]')
