"""A game as a row of numbers, and back."""

import numpy as np

from client.learn.codec import Floats, Integers
from client.learn.compiled import layout as to
from physics import TableState
from referee import Decision, Game, Outcome
from referee.game import RuleId
from referee.rules.breaks import OFFERED
from referee.rules.calls import assign

NEW = np.zeros(to.WIDTH, np.int64)
NEW[[to.GROUP, to.CHOICE, to.WINNER]] = to.OPEN, to.NO_CHOICE, to.NOBODY
"""A game before its first rack."""


def row_of(game: Game) -> Integers:
    """A game's row of `Games.state`, its balls left aside."""
    outcome = game.outcome
    values = np.empty(to.WIDTH, np.int64)
    values[to.PHASE], values[to.AREA] = to.PHASES.index(game.phase), to.AREAS.index(game.cue_ball_in_hand)
    values[[to.TURN, to.BREAKER, to.STROKE, to.RACK]] = game.turn, game.breaker, game.stroke, game.rack
    values[to.GROUP] = to.OPEN if game.groups is None else to.GROUPS.index(game.groups[0])
    values[to.CHOICE] = to.NO_CHOICE if game.choice is None else [str(each) for each in to.CHOICES].index(game.choice)
    values[[to.VISIT_STROKES, to.DRY_VISITS, to.REPLAYS]] = game.visit_strokes, game.dry_visits, game.replays
    values[[to.WINNER, to.REASON, to.DECIDED_BY]] = to.NOBODY, 0, 0
    if outcome is not None:
        reason = to.REASONS.index(outcome.reason)
        values[[to.WINNER, to.REASON, to.DECIDED_BY]] = (
            to.NOBODY if outcome.winner is None else outcome.winner,
            reason,
            reason,
        )
    return values


def game_of(places: Floats, row: Integers) -> Game:
    """The game of a row, its balls at these places, (16, 2) m."""
    state = row.tolist()
    here = bool(places[0, 0] == places[0, 0])
    choice = None if state[to.CHOICE] == to.NO_CHOICE else to.CHOICES[state[to.CHOICE]]
    outcome = None
    if state[to.PHASE] == to.OVER:
        winner, reason = state[to.WINNER], state[to.REASON]
        outcome = Outcome(None if winner == to.NOBODY else winner, to.REASONS[reason], to.ENDS[state[to.DECIDED_BY]])
    return Game(
        state=TableState.trusted(places.copy()),
        phase=to.PHASES[state[to.PHASE]],
        turn=state[to.TURN],
        breaker=state[to.BREAKER],
        groups=None if state[to.GROUP] == to.OPEN else assign(0, to.GROUPS[state[to.GROUP]]),
        cue_ball_in_hand=to.AREAS[state[to.AREA]],
        decisions=() if choice is None else _offered(choice, here),
        choice=choice,
        stroke=state[to.STROKE],
        rack=state[to.RACK],
        visit_strokes=state[to.VISIT_STROKES],
        dry_visits=state[to.DRY_VISITS],
        replays=state[to.REPLAYS],
        outcome=outcome,
    )


def _offered(choice: str, here: bool) -> tuple[Decision, ...]:
    """The decisions that a choice offers; `here`: whether the cue ball is on the table, to be accepted there."""
    return tuple(
        [each for each in OFFERED[choice] if here or choice != RuleId.R12a or each is not Decision.ACCEPT_TABLE]
    )
