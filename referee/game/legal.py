"""What a player may do now: the answer to ``EightBall.legal`` and a part of every ruling."""

from dataclasses import dataclass
from typing import Any

from physics.constants import N_POCKETS
from referee.game.action import Decision
from referee.game.game import CueBallArea, Game, Group, Phase

EIGHT = 8
_MEMBERS = {Group.SOLIDS: tuple(range(1, 8)), Group.STRIPES: tuple(range(9, 16))}
_OWN = {group: frozenset(balls) for group, balls in _MEMBERS.items()} | {None: frozenset().union(*_MEMBERS.values())}


@dataclass(frozen=True, slots=True)
class Legal:
    """The actions a game admits.

    Attributes:
        turn: the seat that may act.
        actions: ``"shot"``, ``"decision"``, ``"concede"``; empty when the game is over.
        call_required: a stroke names a ball and a pocket, or a safety (every stroke but the break).
        callable: the balls that may be called now.
        pockets: the pockets that may be called now.
        safety: a safety may be called.
        cue_ball: ``"kitchen"`` or ``"anywhere"`` if the cue ball is in hand, else None.
        must_place: the stroke has to say where the cue ball goes, because it is not on the table.
        decisions: the choices open now.
    """

    turn: int
    actions: tuple[str, ...] = ()
    call_required: bool = False
    callable: tuple[int, ...] = ()
    pockets: tuple[int, ...] = ()
    safety: bool = False
    cue_ball: CueBallArea | None = None
    must_place: bool = False
    decisions: tuple[Decision, ...] = ()

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {
            "turn": self.turn,
            "actions": list(self.actions),
            "call_required": self.call_required,
            "callable": list(self.callable),
            "pockets": list(self.pockets),
            "safety": self.safety,
            "cue_ball": None if self.cue_ball is None else self.cue_ball.value,
            "must_place": self.must_place,
            "decisions": [decision.value for decision in self.decisions],
        }


def members(group: Group) -> tuple[int, ...]:
    """The seven balls of a group."""
    return _MEMBERS[group]


def remaining(game: Game, seat: int) -> tuple[int, ...]:
    """The balls of a seat's group that are on the table; on an open table all object balls but the 8."""
    own = _OWN[game.group_of(seat)]
    return tuple([ball for ball in game.state.balls if ball in own])


def callable_balls(game: Game) -> tuple[int, ...]:
    """R23: on an open table any ball but the 8; with a group its balls; the group cleared, the 8 alone."""
    own = remaining(game, game.turn)
    return (EIGHT,) if not own and game.groups is not None else own


def legal(game: Game) -> Legal:
    """What ``game`` admits."""
    match game.phase:
        case Phase.OVER | Phase.RERACK:
            return Legal(turn=game.turn)
        case Phase.DECISION:
            return Legal(turn=game.turn, actions=("decision", "concede"), decisions=game.decisions)
        case Phase.BREAK:
            return _stroke(game)
        case Phase.PLAY:
            return _stroke(game, callable_balls(game))


def _stroke(game: Game, balls: tuple[int, ...] | None = None) -> Legal:
    called = balls is not None
    return Legal(
        turn=game.turn,
        actions=("shot", "concede"),
        call_required=called,
        callable=balls or (),
        pockets=tuple(range(N_POCKETS)) if called else (),
        safety=called,
        cue_ball=game.cue_ball_in_hand,
        must_place=0 not in game.state.balls,
    )
