"""Fields of a view that are made when somebody reads them: they cost more than a name."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final

from physics.table import Table
from protocol.allowed import Allowed, Area
from protocol.game_terms import GameTerms
from protocol.outcomes import OutcomeView
from protocol.strokes import StrokeView
from referee.game import Game, Legal, Phase, legal


@dataclass(slots=True)
class LateFields:
    """What makes the fields of a view that cost more than a name: a method for each of `LATE`.

    Attributes:
        terms, game, table: that the view is of. strokes: see `View.of`.
    """

    terms: GameTerms
    game: Game
    table: Table
    strokes: Sequence[StrokeView] | Callable[[], Sequence[StrokeView]]
    _legal: Legal | None = field(default=None, init=False)

    def why(self) -> str:
        """Say in a sentence why it is whose turn."""
        if strokes := self.strokes_since():
            return strokes[-1].ruling.words
        game = self.game
        return f"{self.terms.players[game.turn]} {'breaks' if game.phase is Phase.BREAK else 'is to act'}"

    def allowed(self) -> Allowed:
        """See `View`."""
        return Allowed.of(self._admitted())

    def callable_balls(self) -> tuple[int, ...]:
        """See `View`."""
        return self._admitted().callable

    def _admitted(self) -> Legal:
        if self._legal is None:
            self._legal = legal(self.game)
        return self._legal

    def cue_ball_area(self) -> Area | None:
        """See `View`."""
        area = self.game.cue_ball_in_hand
        return None if area is None else Area.of(area, self.table)

    def balls(self) -> dict[int, tuple[float, float]]:
        """See `View`."""
        return self.game.state.by_ball()

    def strokes_since(self) -> tuple[StrokeView, ...]:
        """See `View`."""
        return tuple(self.strokes() if callable(self.strokes) else self.strokes)

    def outcome(self) -> OutcomeView | None:
        """See `View`."""
        outcome = self.game.outcome
        return None if outcome is None else OutcomeView.of(outcome)


LATE: Final = frozenset(("why", "allowed", "callable_balls", "cue_ball_area", "balls", "strokes_since", "outcome"))
"""Fields of a view that are made when somebody reads them."""
