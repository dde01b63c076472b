"""A stroke as the rules see it: the game before it, what was asked for, what happened."""

from dataclasses import dataclass

from physics.facts import NEVER, Facts
from physics.state import TableState
from physics.table import Table
from referee.game import EIGHT, Action, Evidence, Game, Group, callable_balls, members

CUE_BALL = 0
Finding = tuple[Evidence, ...]
"""What a predicate found: the proof, or nothing when the rule does not apply."""


@dataclass(frozen=True, slots=True)
class StrokeFacts:
    """One stroke under judgement.

    Attributes:
        table: the table it was played on.
        game: the game before the stroke.
        action: shot, call and placement.
        facts: what the simulation says happened.
        final: the balls afterwards.
        pocketed: the object balls pocketed, however late they fell (R51: the simulation runs until every ball
            rests, so a ball that hangs at a pocket and drops belongs to the stroke), in order of numbers.
        struck: the balls struck first, more than one when at the same instant.
        targets: the balls the shooter may strike first; they are those that may be called.
        on_eight: the shooter's group was cleared before the stroke (R27).
    """

    table: Table
    game: Game
    action: Action
    facts: Facts
    final: TableState
    pocketed: tuple[int, ...]
    struck: tuple[int, ...]
    targets: tuple[int, ...]
    on_eight: bool

    @property
    def shooter(self) -> int:
        """The seat that played it."""
        return self.game.turn

    @property
    def opponent(self) -> int:
        """The other seat."""
        return 1 - self.game.turn

    @property
    def eight_pocketed(self) -> bool:
        """The 8 went into a pocket."""
        return self.facts.pocketed[EIGHT] != NEVER

    @property
    def eight_off_table(self) -> bool:
        """The 8 left the table."""
        return self.facts.off_table[EIGHT] != NEVER

    def searched(self, first: int = 0) -> tuple[int, int] | None:
        """The range of events from ``first`` to the last, which a negative fact was looked for in."""
        last = self.facts.n_events - 1
        return None if last < first else (first, last)


def read_stroke(table: Table, game: Game, action: Action, facts: Facts, final: TableState) -> StrokeFacts:
    """Gather what several rules ask for."""
    targets = callable_balls(game)
    pocketed, struck = balls_pocketed(facts), facts.struck_first
    return StrokeFacts(table, game, action, facts, final, pocketed, struck, targets, group_cleared(targets))


def balls_pocketed(facts: Facts) -> tuple[int, ...]:
    """R51: the object balls pocketed before every ball came to rest."""
    return tuple([ball for ball in range(1, 16) if facts.pocketed[ball] != NEVER])


def group_cleared(targets: tuple[int, ...]) -> bool:
    """R27: none of the shooter's group is on the table, so that only the 8 is left to play."""
    return targets == (EIGHT,)


def group_of_ball(ball: int) -> Group:
    """The group an object ball other than the 8 belongs to."""
    return Group.SOLIDS if ball in members(Group.SOLIDS) else Group.STRIPES
