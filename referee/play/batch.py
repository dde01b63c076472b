"""Strokes of many games at once: one batch through the physics, and the games that follow."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from physics import Batch, Facts, Shot, simulate_batch
from physics.facts import NEVER
from referee.game import SAFETY, Action, Call, CueBallArea, Game, Group, Phase
from referee.play.noise import NoiseModel
from referee.rules import EightBall
from referee.rules.batch_rulings import OPEN, SAFETY_CALL, Verdicts, read_verdicts
from referee.rules.calls import assign
from referee.rules.judge import next_game
from referee.rules.stroke_facts import CUE_BALL

_GROUPS = (Group.SOLIDS, Group.STRIPES)


@dataclass(frozen=True, slots=True, eq=False)
class Strokes:
    """A stroke that may be played in each of n games.

    Attributes:
        games: (n) before them, none waiting for a decision.
        before: (n, 16, 2) m, the tables, the cue ball placed where it is in hand.
        shots: (n, 5) as intended, columns v, phi, theta, a, b.
        ball, pocket: (n,) int64, the calls; ball -1 is a safety, and nothing on the break.
    """

    games: Sequence[Game]
    before: NDArray[np.float64]
    shots: NDArray[np.float64]
    ball: NDArray[np.int64]
    pocket: NDArray[np.int64]

    def action(self, row: int) -> Action:
        """One of them as a player would submit it."""
        game, ball = self.games[row], int(self.ball[row])
        called: Call | Literal["safety"] = SAFETY if ball == SAFETY_CALL else Call(ball, int(self.pocket[row]))
        x, y = self.before[row, CUE_BALL].tolist()
        return Action(
            shot=Shot(*self.shots[row].tolist()),
            call=None if game.phase is Phase.BREAK else called,
            cue_ball=None if game.cue_ball_in_hand is None else (x, y),
        )


def groups_of_shooters(games: Sequence[Game]) -> NDArray[np.int8]:
    """(n,): the group of the player in turn, -1 on an open table, 0 solids, 1 stripes."""
    return np.array([OPEN if game.groups is None else _GROUPS.index(game.groups[game.turn]) for game in games], np.int8)


def play_strokes(
    rules: EightBall, strokes: Strokes, noise: NoiseModel, draws: NDArray[np.float64], *, threads: int = 1
) -> list[Game]:
    """The games after these strokes, as ``EightBall.apply`` has them; whether they may be played is not asked again.

    Args:
        rules, noise: of all games. strokes: one a game.
        draws: (n, 5) standard normal numbers for the noise, columns as those of the shots.
        threads: of the physics.

    Returns:
        n games; those in phase ``rerack`` await new balls.
    """
    shots = noise.perturb_rows(strokes.shots, draws, rules.table)
    batch = simulate_batch(rules.table, strokes.before, shots, threads=threads, event_limit=rules.limits.events)
    kitchen = np.array([game.cue_ball_in_hand is CueBallArea.KITCHEN for game in strokes.games])
    calls = groups_of_shooters(strokes.games), strokes.ball, strokes.pocket
    verdicts = read_verdicts(rules.table, strokes.before, *calls, batch, kitchen)
    after = _in_play(strokes, verdicts, batch)
    decided = (verdicts.won | verdicts.lost | ~verdicts.played).tolist()
    for row, game in enumerate(strokes.games):
        if decided[row] or game.phase is not Phase.PLAY or _is_limited(rules, after[row]):
            facts = Facts.from_record(batch.facts[row])
            after[row] = rules.apply(game, strokes.action(row), facts, batch.state(row)).game
    return after


def _in_play(strokes: Strokes, verdicts: Verdicts, batch: Batch) -> list[Game]:
    """The games after strokes that were no breaks and decided nothing, the limits of R49 aside."""
    pocketed = (batch.facts["pocketed"][:, CUE_BALL + 1 :] != NEVER).any(axis=1)
    columns = [column.tolist() for column in (verdicts.continues, verdicts.fouled, pocketed, verdicts.group)]
    after = []
    for row, (game, goes_on, fouled, fell, group) in enumerate(zip(strokes.games, *columns, strict=True)):
        groups = game.groups
        if groups is None and group != OPEN:
            groups = assign(game.turn, _GROUPS[group])
        turn = game.turn if goes_on else game.opponent
        area = CueBallArea.ANYWHERE if fouled else None
        after.append(next_game(game, turn, batch.state(row), Phase.PLAY, fell, groups=groups, area=area))
    return after


def _is_limited(rules: EightBall, after: Game) -> bool:
    """Whether a limit of R49 is reached."""
    return after.stroke >= rules.limits.strokes or after.dry_visits >= rules.limits.dry_visits
