"""Where a game begins that does not begin with a break."""

from typing import Annotated, Literal, Self

from pydantic import ConfigDict, Field

from physics.state import TableState
from protocol.values import Balls, Request, Seat
from referee.game import CueBallArea, Game, Group, Phase


class Position(Request):
    """A position to begin from. A match with one is unrated.

    Attributes:
        balls: on the table, m.
        phase: ``play``; or ``break``, all sixteen balls being given; or ``decision``.
        turn: the seat that acts first, in the first game; the seats are exchanged in every second one.
        breaker: the seat a replayed rack falls to (R49).
        groups: by seat; null on an open table.
        cue_ball_in_hand: where the cue ball may be placed; null: it lies where it lies.
        choice: in phase ``decision`` the rule that grants the choice: R12, R12a, R13, R14, R16 or R17.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4]}, "groups": ["solids", "stripes"]}
            ]
        }
    )

    balls: Balls
    phase: Literal["break", "play", "decision"] = "play"
    turn: Seat = 0
    breaker: Seat = 0
    groups: tuple[Group, Group] | None = None
    cue_ball_in_hand: CueBallArea | None = None
    choice: Annotated[str, Field(max_length=8)] | None = None

    @classmethod
    def of(cls, game: Game) -> Self:
        """The position of a game that goes on, e.g. of ``view.to_game()``."""
        return cls.model_validate(
            {
                "balls": game.state.to_dict(),
                "phase": game.phase.value,
                "turn": game.turn,
                "breaker": game.breaker,
                "groups": game.groups,
                "cue_ball_in_hand": game.cue_ball_in_hand,
                "choice": game.choice,
            }
        )

    def to_game(self) -> Game:
        """The referee's game, for ``EightBall.begin_from`` to look at."""
        return Game(
            state=TableState.from_positions(self.balls),
            phase=Phase(self.phase),
            turn=self.turn,
            breaker=self.breaker,
            groups=self.groups,
            cue_ball_in_hand=self.cue_ball_in_hand,
            choice=self.choice,
        )
