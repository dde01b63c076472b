"""One turn: gather strokes, judge them ever more carefully, fewer and fewer, until the budget is spent."""

import contextlib
from dataclasses import dataclass

import numpy as np

from client.agents.search import banks, polish
from client.agents.search.budget import TimeUp
from client.agents.search.evaluate import Evaluator, Thinking
from client.agents.search.finalists import Finalists
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
POT_SHARE, POT_SHARE_UNPOLISHED = 0.4, 0.8
"""Of the budget, what trying straight pots for the first time may cost if all of them fall; narrowing them down takes
nearly half as much again. More where nothing is kept for making the best of them better."""
BANK_SHARE, MOST_BANKS = 0.15, 60
"""Of the budget, what aiming banks and their like may cost; and how many are aimed at most."""
POLISH_SHARE = 0.8
"""Of what is left of the budget then, what goes into making finalists better."""
MOST_WAYS, MOST_POTS = 1500, 15_000
"""However large the budget: ways to play one pot; ways to play all, of which a cue ball in hand has very many."""
MOST_COPIES = 2000
"""Of a finalist in a round, however large the budget."""
FULL = 8000
"""Shots in the budget from which all those copies are played; below it fewer."""
FINALISTS = 8
PLAIN = 0.12
"""A pot that is worth so much more than a safety, by the race, is played without considering anything else."""
FREE, HARD = 0.5, 4.0
"""Degrees above the least elevation, and m/s, of a stroke for want of any other."""
GROUPS = {Group.SOLIDS: 0, Group.STRIPES: 1, None: OPEN}


@dataclass(frozen=True, slots=True)
class Considered:
    """A stroke that came far.

    Attributes:
        action: the stroke. worth: the chance to win that it is reckoned to leave; error: its standard error.
        copies: how often it was played under noise.
    """

    action: Action
    worth: float
    error: float
    copies: int


@dataclass(frozen=True, slots=True)
class Thought:
    """A stroke that was chosen.

    Attributes:
        action: what to do. worth: the chance to win that it is reckoned to leave. simulated: shots it took.
        considered: the finalists, the best first; empty when nothing was simulated.
        without_pot: the worth of the table to a player who pots nothing.
    """

    action: Action
    worth: float
    simulated: int
    considered: tuple[Considered, ...] = ()
    without_pot: float = 0.0


class TurnSearch:
    """Everything that depends on how the game stands."""

    def __init__(
        self, rules: EightBall, game: Game, evaluator: Evaluator, options: Options, chance: np.random.Generator
    ) -> None:
        self._rules, self._game, self._evaluator, self._options = rules, game, evaluator, options
        self._chance = chance
        self._group = GROUPS[game.group_of(game.turn)]
        self._area = game.cue_ball_in_hand
        self._kitchen = self._area is CueBallArea.KITCHEN
        self._found: Finalists | None = None
        self._aside: Finalists | None = None

    def best(self) -> Thinking[Thought]:
        """The best stroke that the budget finds; without any simulation left, the likeliest straight pot."""
        tables = self._tables()
        with contextlib.suppress(BudgetSpent, TimeUp):  # what was found until then is played
            yield from self._think(tables)
        if self._found is None:
            return self._reckoned(tables)
        considered = tuple(self._considered(self._found) + self._considered(self._aside))[:FINALISTS]
        if not considered:
            return self._anything(tables)
        best, plain = considered[0], float(self._evaluator.values.without_pot(tables[:1])[0])
        return Thought(best.action, best.worth, self._evaluator.budget.simulated, considered, plain)

    def _think(self, tables: Tables) -> Thinking[None]:
        """Find the best strokes of all kinds, make them better, and tell them apart."""
        yield from self._pots(tables)
        values = self._evaluator.values
        plain = float(values.without_pot(tables[:1])[0]) + PLAIN * values.odds.scale
        if self._options.safeties and (self._found is None or self._found.worth.max() < plain):
            yield from self._others(tables)
        if self._options.polish:
            yield from self._polished()
        yield from self._told_apart()

    def _considered(self, found: Finalists | None) -> list[Considered]:
        """The best of some strokes that the rules allow, the best first."""
        if found is None:
            return []
        ordered = found.best(FINALISTS)
        strokes = [
            Considered(self._action(ordered.shots, row), float(worth), float(error), int(copies))
            for row, (worth, error, copies) in enumerate(zip(ordered.worth, ordered.error, ordered.copies, strict=True))
        ]
        return [each for each in strokes if not self._rules.check(self._game, each.action)]

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

    def _pots(self, tables: Tables) -> Thinking[None]:
        """The best straight pots."""
        budget, sight = self._evaluator.budget, self._evaluator.values.sight
        pots = int(np.clip(budget.total / 2500, 3, 10)) if len(tables) == 1 else 2
        listed = sight.pots(tables, pots)
        there = max(1, int((listed.chance > 0.0).sum()))
        share = POT_SHARE if self._options.polish else POT_SHARE_UNPOLISHED
        affordable = min(share * budget.total / (AIMS + SCREENING), MOST_POTS)
        ways = int(np.clip(affordable / there, 4, MOST_WAYS)) if self._options.ways else 2
        shots = sight.aimed(sight.raised(in_all_ways(tables, listed, ways)))
        if len(shots):
            yield from self._narrowed((yield from centred(self._evaluator, shots, AIMS)))

    def _others(self, tables: Tables) -> Thinking[None]:
        """The best of the strokes that are no straight pots."""
        budget, evaluator = self._evaluator.budget, self._evaluator
        targets = int(target_balls(tables.positions[:1], tables.group[:1]).sum())
        each = int(np.clip(0.2 * budget.total / max(1, targets) / 12, 7, 41))
        shots = yield from sweep(evaluator, tables, each, self._options.jumps)
        if not len(shots):
            return
        plain = yield from evaluator.as_meant(shots)
        most = int(np.clip(0.15 * budget.total / SCREENING, 24, 400))
        kept = shots[np.argsort(-plain, kind="stable")[:most]]
        if self._options.banks:
            aimed = int(np.clip(BANK_SHARE * budget.total / banks.COST, 3, MOST_BANKS))
            kept = kept.joined((yield from banks.aimed(evaluator, shots, plain, aimed)))
        yield from self._narrowed(kept)

    def _narrowed(self, shots: Shots) -> Thinking[None]:
        """Find the best of the strokes, judged in rounds: fewer and fewer, more and more often."""
        if not len(shots):
            return
        before, evaluator = self._found, self._evaluator
        found = Finalists.of(shots, (yield from evaluator.noisy(shots, SCREENING)))
        fewer = np.clip(evaluator.budget.total / FULL, 0.2, 1.0)
        for share, copies in NARROWING:
            found = found.best(max(FINALISTS, int(share * len(found))))
            self._found = found if before is None else before.joined(found)
            if evaluator.noise > 0.0:
                found = yield from self._again(found, max(2, round(copies * fewer)))
        found = found.best(FINALISTS)
        self._found = found if before is None else before.joined(found)

    def _polished(self) -> Thinking[None]:
        """The finalists and better strokes near them."""
        evaluator = self._evaluator
        if self._found is None or evaluator.noise == 0.0:
            return
        left = (1.0 - evaluator.budget.spent) * evaluator.budget.total
        for spread, copies in polish.rounds(POLISH_SHARE * left):
            found = yield from polish.better(evaluator, self._found, spread, copies, self._chance)
            self._found = found.best(2 * FINALISTS)

    def _told_apart(self) -> Thinking[None]:
        """The best of the finalists, played more often, fewer and fewer of them, until the budget is spent."""
        if self._found is None:
            return
        budget, keep = self._evaluator.budget, FINALISTS
        while keep > 1 and self._evaluator.noise > 0.0:
            affordable = int((1.0 - budget.spent) * budget.total / (keep * keep.bit_length()))
            if affordable < SCREENING:
                break
            ordered = self._found.best(len(self._found))
            first, rest = ordered[np.arange(min(keep, len(ordered)))], ordered[np.arange(keep, len(ordered))]
            self._aside = rest if self._aside is None else rest.joined(self._aside)
            self._found = first
            self._found = yield from self._again(first, min(affordable, MOST_COPIES))
            keep //= 2

    def _again(self, found: Finalists, copies: int) -> Thinking[Finalists]:
        """The same strokes, each played so many times more."""
        return found.again((yield from self._evaluator.noisy(found.shots, copies)))

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
