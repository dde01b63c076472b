"""One turn: gather strokes, judge them ever more carefully, fewer and fewer, until the budget is spent."""

import contextlib
from dataclasses import dataclass

import numpy as np

from client.agents.search.evaluate import Evaluator
from client.agents.search.options import Options
from client.agents.search.placement import best_places, places
from client.agents.search.pots import in_all_ways
from client.agents.search.refine import centred
from client.agents.search.shots import Floats, Shots, Tables
from client.agents.search.sweep import sweep
from physics import Shot, TableState, min_elevation
from referee import SAFETY, Action, BudgetSpent, Call, CueBallArea, EightBall, Game, Group
from referee.rules.batch_rulings import OPEN, SAFETY_CALL, target_balls

AIMS = 7
"""Directions tried to find the middle of a pot."""
SCREENING = 6
"""Noisy copies of every stroke."""
NARROWING = ((0.25, 10), (0.3, 24), (0.4, 48))
"""Then so large a share of them is kept, and played so many times more; and again."""
POT_SHARE = 0.8
"""Of the budget, what straight pots may cost if all of them fall."""
MOST_WAYS, MOST_POTS = 1500, 15_000
"""However large the budget: ways to play one pot; ways to play all, of which a cue ball in hand has very many."""
MOST_COPIES = 2000
"""Of a finalist in a round, however large the budget."""
FULL = 8000
"""Shots in the budget from which all those copies are played; below it fewer."""
FINALISTS = 8
PLAIN = 0.12
"""A pot that is worth so much more than a safety is played without considering anything else."""
FREE, HARD = 0.5, 4.0
"""Degrees above the least elevation, and m/s, of a stroke for want of any other."""
GROUPS = {Group.SOLIDS: 0, Group.STRIPES: 1, None: OPEN}


@dataclass(frozen=True, slots=True)
class Thought:
    """A stroke that was chosen.

    Attributes:
        action: what to do. worth: the chance to win that it is reckoned to leave. simulated: shots it took.
    """

    action: Action
    worth: float
    simulated: int


@dataclass(frozen=True, slots=True)
class Finalists:
    """Strokes that are left, and what each copy of each was worth under noise, (k, copies)."""

    shots: Shots
    worths: Floats

    @property
    def worth(self) -> Floats:
        """(k,): what each is worth, as far as known."""
        found: Floats = self.worths.mean(axis=1)
        return found

    def best(self, most: int) -> "Finalists":
        """The best of them, the best first."""
        rows = np.argsort(-self.worth, kind="stable")[:most]
        return Finalists(self.shots[rows], self.worths[rows])

    def joined(self, other: "Finalists") -> "Finalists":
        """These and others, all of them played equally often."""
        return Finalists(self.shots.joined(other.shots), np.concatenate((self.worths, other.worths)))


class TurnSearch:
    """Everything that depends on how the game stands."""

    def __init__(self, rules: EightBall, game: Game, evaluator: Evaluator, options: Options) -> None:
        self._rules, self._game, self._evaluator, self._options = rules, game, evaluator, options
        self._group = GROUPS[game.group_of(game.turn)]
        self._area = game.cue_ball_in_hand
        self._kitchen = self._area is CueBallArea.KITCHEN

    def best(self) -> Thought:
        """The best stroke that the budget finds; without any simulation left, the likeliest straight pot."""
        tables = self._tables()
        try:
            found = self._found(tables)
        except BudgetSpent:
            found = None
        if found is None:
            return self._reckoned(tables)
        with contextlib.suppress(BudgetSpent):
            found = self._told_apart(found)
        found = found.best(FINALISTS)
        for row in range(len(found.shots)):
            action = self._action(found.shots, row)
            if not self._rules.check(self._game, action):
                return Thought(action, float(found.worth[row]), self._evaluator.budget.simulated)
        return self._anything(tables)

    def _found(self, tables: Tables) -> Finalists | None:
        """The best strokes of all kinds."""
        pots = self._pots(tables)
        plain = float(self._evaluator.values.without_pot(tables[:1])[0]) + PLAIN
        if not self._options.safeties or (pots is not None and pots.worth.max() >= plain):
            return pots
        others = self._others(tables)
        return pots.joined(others) if pots and others else pots or others

    def _tables(self) -> Tables:
        """Where to play from: the table as it lies, or with the cue ball in many places."""
        positions = self._game.state.positions
        if self._area is None:
            return Tables(positions[None].copy(), np.array([self._group], np.int8))
        table, sight = self._rules.table, self._evaluator.values.sight
        base = positions.copy()
        base[0] = np.nan
        targets = target_balls(base[None], np.array([self._group], np.int8))[0]
        if self._kitchen:  # R38: no ball behind the string first
            targets &= base[:, 1] <= table.head_string
        points = places(table, base, targets, self._kitchen)
        most = int(np.clip(self._evaluator.budget.total / 1500, 6, 40))
        return best_places(sight, base, self._group, targets, points, most)

    def _pots(self, tables: Tables) -> Finalists | None:
        """The best straight pots."""
        budget, sight = self._evaluator.budget, self._evaluator.values.sight
        pots = int(np.clip(budget.total / 2500, 3, 10)) if len(tables) == 1 else 2
        listed = sight.pots(tables, pots)
        there = max(1, int((listed.chance > 0.0).sum()))
        affordable = min(POT_SHARE * budget.total / (AIMS + SCREENING), MOST_POTS)
        ways = int(np.clip(affordable / there, 4, MOST_WAYS)) if self._options.ways else 2
        shots = sight.aimed(sight.raised(in_all_ways(tables, listed, ways)))
        return self._narrowed(centred(self._evaluator, shots, AIMS)) if len(shots) else None

    def _others(self, tables: Tables) -> Finalists | None:
        """The best of the strokes that are no straight pots."""
        budget = self._evaluator.budget
        targets = int(target_balls(tables.positions[:1], tables.group[:1]).sum())
        each = int(np.clip(0.2 * budget.total / max(1, targets) / 12, 7, 41))
        shots = sweep(self._evaluator, tables, each)
        if not len(shots):
            return None
        plain = self._evaluator.as_meant(shots, self._kitchen)
        most = int(np.clip(0.15 * budget.total / SCREENING, 24, 400))
        return self._narrowed(shots[np.argsort(-plain, kind="stable")[:most]])

    def _narrowed(self, shots: Shots) -> Finalists | None:
        """The best of the strokes, judged in rounds: fewer and fewer, more and more often."""
        if not len(shots):
            return None
        found = Finalists(shots, self._evaluator.noisy(shots, SCREENING, self._kitchen))
        fewer = np.clip(self._evaluator.budget.total / FULL, 0.2, 1.0)
        for share, copies in NARROWING:
            found = found.best(max(FINALISTS, int(share * len(found.shots))))
            if self._evaluator.noise > 0.0:
                found = self._again(found, max(2, round(copies * fewer)))
        return found.best(FINALISTS)

    def _told_apart(self, found: Finalists) -> Finalists:
        """The best of the finalists, played more often, fewer and fewer of them, until the budget is spent."""
        budget, keep = self._evaluator.budget, len(found.shots)
        while keep > 1 and self._evaluator.noise > 0.0:
            affordable = int((1.0 - budget.spent) * budget.total / (keep * keep.bit_length()))
            if affordable < SCREENING:
                break
            found = self._again(found.best(keep), min(affordable, MOST_COPIES))
            keep //= 2
        return found

    def _again(self, found: Finalists, copies: int) -> Finalists:
        """The same strokes, each played so many times more."""
        more = self._evaluator.noisy(found.shots, copies, self._kitchen)
        return Finalists(found.shots, np.concatenate((found.worths, more), axis=1))

    def _reckoned(self, tables: Tables) -> Thought:
        """The likeliest straight pot by geometry alone, and if there is none, anything."""
        sight = self._evaluator.values.sight
        listed = sight.pots(tables, 1)
        shots = sight.aimed(sight.raised(in_all_ways(tables, listed, 1)))
        if not len(shots):
            return self._anything(tables)
        best = int(listed.chance[shots.table, 0].argmax())
        return Thought(self._action(shots, best), 0.0, self._evaluator.budget.simulated)

    def _anything(self, tables: Tables) -> Thought:
        """A safety in the first direction in which the cue is free: nothing else was found."""
        table, state = self._rules.table, TableState.from_positions(_placed(tables.positions[0]))
        for phi in range(360):
            theta = min_elevation(table, state, float(phi)) + FREE
            if theta <= table.theta_max:  # False for NaN: blocked at every elevation
                nothing = np.array([SAFETY_CALL])
                strokes = np.array([[HARD, float(phi), theta, 0.0, 0.0]])
                shots = Shots(tables, np.zeros(1, np.int64), strokes, nothing, nothing, np.zeros(1))
                return Thought(self._action(shots, 0), 0.0, self._evaluator.budget.simulated)
        raise RuntimeError(f"no direction is free for the cue: {state!r}")

    def _action(self, shots: Shots, row: int) -> Action:
        """A stroke as the referee takes it."""
        ball, pocket = int(shots.ball[row]), int(shots.pocket[row])
        x, y = shots.before()[row, 0].tolist()
        return Action(
            shot=Shot(*shots.strokes[row].tolist()),
            call=SAFETY if ball == SAFETY_CALL else Call(ball, pocket),
            cue_ball=None if self._area is None else (x, y),
        )


def _placed(positions: Floats) -> dict[int, tuple[float, float]]:
    """Positions by ball, the absent left out."""
    return {ball: (float(x), float(y)) for ball, (x, y) in enumerate(positions) if not np.isnan(x)}
