"""The limits of a game; R49: one that does not get on is replayed, and in the end drawn."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from typing import Any, Final, Self

from physics.constants import EVENT_LIMIT
from referee.errors import InvalidGame
from referee.game import EndReason, Game, Outcome, Phase, RuleId

EVENTS_OF_A_STROKE: Final = 20_000
"""A hundred times as many as a break has, and more than any ordinary stroke: see docs/benchmarks.md, Stress."""


@dataclass(frozen=True, slots=True)
class Limits:
    """When a game counts as stuck, and when a stroke is ended.

    Attributes:
        dry_visits: consecutive visits without a pocketed object ball that make a stalemate.
        replays: racks replayed for a stalemate before the next stalemate draws the game.
        strokes: strokes in a game, replayed racks included, after which it is drawn.
        events: events of a stroke, at most ``physics.constants.EVENT_LIMIT``, after which the balls are stopped where
            they are (``Status.EVENT_LIMIT``). The rules go on from there.
    """

    dry_visits: int = 24
    replays: int = 2
    strokes: int = 400
    events: int = EVENTS_OF_A_STROKE

    def __post_init__(self) -> None:
        for field, least in zip(fields(self), (1, 0, 1, 1), strict=True):
            value = getattr(self, field.name)
            if isinstance(value, bool) or not isinstance(value, int) or value < least:
                raise InvalidGame(f"limits.{field.name}", value, f"an integer of at least {least}")
        if self.events > EVENT_LIMIT:
            raise InvalidGame("limits.events", self.events, f"an integer of at most {EVENT_LIMIT}")

    def to_dict(self) -> dict[str, int]:
        """Plain values by name. The events are left out where they are the physics' own limit: see ``from_dict``."""
        return {name: value for name, value in asdict(self).items() if (name, value) != ("events", EVENT_LIMIT)}

    @classmethod
    def from_dict(cls, values: Mapping[str, Any]) -> Self:
        """Read what ``to_dict`` wrote. Version 0.1.0 ended no stroke before the physics did, and wrote no events.

        Raises:
            InvalidGame: a value that cannot be. TypeError: an unknown name.
        """
        return cls(**({"events": EVENT_LIMIT} | dict(values)))


def dry_visits_after(game: Game, turn: int, pocketed: bool) -> int:
    """R49: consecutive finished visits without a pocketed object ball, fouls included, when ``turn`` is next.

    A scratch pockets no object ball. A visit of several strokes has pocketed one, or it would have ended.
    """
    if pocketed:
        return 0
    return game.dry_visits + (game.visit_strokes == 0 and turn != game.turn)


def stroke_limit(game: Game, limits: Limits) -> Game | None:
    """R49: the game drawn because its strokes are used up, or None."""
    if game.is_over or game.stroke < limits.strokes:
        return None
    return over(game, Outcome(None, EndReason.STROKE_LIMIT, RuleId.R49))


def stalemate(game: Game, limits: Limits) -> Game | None:
    """R49: the game sent to a replay of the rack by its first breaker, or drawn; None if it gets on."""
    if game.is_over or game.dry_visits < limits.dry_visits:
        return None
    if game.replays >= limits.replays:
        return over(game, Outcome(None, EndReason.STALEMATE, RuleId.R49))
    return replace(await_rack(game, game.breaker), dry_visits=0, replays=game.replays + 1)


def await_rack(game: Game, turn: int) -> Game:
    """The game waiting for a new rack, which ``turn`` will break."""
    return replace(
        game,
        phase=Phase.RERACK,
        turn=turn,
        groups=None,
        cue_ball_in_hand=None,
        decisions=(),
        choice=None,
        visit_strokes=game.visit_strokes if turn == game.turn else 0,
    )


def over(game: Game, outcome: Outcome) -> Game:
    """The game with its result."""
    return replace(game, phase=Phase.OVER, cue_ball_in_hand=None, decisions=(), choice=None, outcome=outcome)
