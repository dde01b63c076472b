"""What a learner sees and does, as vectors: a game as numbers in [0, 1], an action from numbers in [-1, 1].

Every vector in [-1, 1]^8 is a legal action: elevations count from the least that is free, a place that is taken gives
way to the nearest free one, calls and decisions are chosen among those that are open.
"""

import math
from collections.abc import Sequence
from typing import Final, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

import physics
from client.geometry import Point, distance, is_free, lattice
from physics import Shot, Table, TableState
from physics.constants import N_BALLS, N_POCKETS, V_MAX
from referee import SAFETY, Action, Call, CueBallArea, Decision, Game, Phase
from referee.game import callable_balls, members

Vector = NDArray[np.float32]
T = TypeVar("T")

ACTION_SIZE: Final = 8
"""Speed, direction, elevation, side, height, place x, place y, choice."""
DECISIONS: Final = tuple(each for each in Decision if each is not Decision.CONCEDE)
PHASES: Final = (Phase.BREAK, Phase.PLAY, Phase.DECISION)
AREAS: Final = (None, CueBallArea.KITCHEN, CueBallArea.ANYWHERE)
OBSERVATION_SIZE: Final = 3 * N_BALLS + len(PHASES) + len(AREAS) + 3 + len(DECISIONS) + 2
"""Balls, phase, cue ball in hand, groups, decisions open, stalemate counter, strokes."""

OFFSET: Final = 14.0
"""mm, the greatest tip offset to a side: with as much in height, still on the ball."""
LATTICE: Final = (9, 15)
"""Columns and rows of the places that stand in for one that is taken."""
MARGIN: Final = 0.5
"""Degrees above the least elevation, for when the one asked for cannot be played."""
TURNS: Final = 72
"""Directions tried, all round, when the cue is blocked at every elevation in the one asked for."""
_SOLIDS_FIRST: Final = tuple(range(N_BALLS))
_STRIPES_FIRST: Final = (0, *range(9, 16), 8, *range(1, 8))


def observe(table: Table, game: Game, seat: int) -> Vector:
    """The game as the player of `seat` sees it, `(OBSERVATION_SIZE,)` float32 in [0, 1].

    Of each ball x and y as shares of width and length and whether it is on the table: first the cue ball, then the own
    group, the 8, the others (solids first while the table is open). Then one-hot the phase, where the cue ball may be
    placed, the groups (open, own solids, own stripes), the decisions open, and as shares of their limits the stalemate
    counter (24 visits) and the strokes (400).
    """
    own = game.group_of(seat)
    stripes = own is not None and 9 in members(own)
    order = list(_STRIPES_FIRST if stripes else _SOLIDS_FIRST)
    places = game.state.positions[order] / (table.width, table.length)
    there = ~np.isnan(places[:, :1])
    balls = np.hstack([np.where(there, np.clip(places, 0.0, 1.0), 0.0), there])
    flags = [
        *(game.phase is phase for phase in PHASES),
        *(game.cue_ball_in_hand is area for area in AREAS),
        *(own is None, own is not None and not stripes, stripes),
        *(decision in game.decisions for decision in DECISIONS),
    ]
    counters = [min(1.0, game.dry_visits / 24.0), min(1.0, game.stroke / 400.0)]
    return np.concatenate([balls.ravel(), np.array(flags, np.float64), counters]).astype(np.float32)


def act(table: Table, game: Game, vector: NDArray[np.floating]) -> Action:
    """The legal action that a vector of `ACTION_SIZE` numbers stands for; those beyond [-1, 1] count as the bound.

    Raises:
        ValueError: another shape, or a number that is none.
    """
    shares = _shares(vector)
    if game.decisions:
        return Action(decision=_pick(game.decisions, shares[7]))
    place = None if game.cue_ball_in_hand is None else _place(table, game, shares)
    before = game.state if place is None else game.state.moved(0, place)
    call = None if game.phase is Phase.BREAK else _call(game, shares[7])
    return Action(shot=_shot(table, before, shares), call=call, cue_ball=place)


def _shares(vector: NDArray[np.floating]) -> list[float]:
    """The numbers as shares in [0, 1]."""
    values = np.asarray(vector, dtype=np.float64)
    if values.shape != (ACTION_SIZE,):
        raise ValueError(f"an action has shape {values.shape}; it must be ({ACTION_SIZE},)")
    if np.isnan(values).any():
        raise ValueError(f"an action is {values.tolist()}; NaN is no number")
    shares: list[float] = ((np.clip(values, -1.0, 1.0) + 1.0) * 0.5).tolist()
    return shares


def _pick(choices: Sequence[T], share: float) -> T:
    return choices[min(int(share * len(choices)), len(choices) - 1)]


def _call(game: Game, share: float) -> Call | Literal["safety"]:
    """One of the balls that may be called with one of the pockets, or a safety: all in a row, each as wide."""
    balls = callable_balls(game)
    ball, pocket = divmod(_pick(range(len(balls) * N_POCKETS + 1), share), N_POCKETS)
    return SAFETY if ball == len(balls) else Call(balls[ball], pocket)


def _place(table: Table, game: Game, shares: list[float]) -> Point:
    """The place asked for, or the nearest free one of a lattice."""
    kitchen = game.cue_ball_in_hand is CueBallArea.KITCHEN
    radius = table.ball_radius
    low = table.head_string if kitchen else radius
    wanted = (
        radius + shares[5] * (table.width - 2.0 * radius),
        low + shares[6] * (table.length - radius - low),
    )
    if is_free(table, game.state, wanted, kitchen):
        return wanted
    free = lattice(table, game.state, *LATTICE, kitchen)
    return min(free, key=lambda place: distance(place, wanted))


def _shot(table: Table, before: TableState, shares: list[float]) -> Shot:
    """The stroke asked for, turned as far as need be for the cue to be free."""
    a, b = (2.0 * shares[3] - 1.0) * OFFSET, (2.0 * shares[4] - 1.0) * OFFSET
    for turn in range(TURNS):
        phi = 360.0 * (shares[1] + turn / TURNS)
        least = physics.min_elevation(table, before, phi, a, b)
        if math.isnan(least):
            continue
        wanted = least + (table.theta_max - least) * shares[2] ** 2
        for theta in (wanted, min(table.theta_max, least + MARGIN), least):
            shot = Shot(v=shares[0] * V_MAX, phi=phi, theta=theta, a=a, b=b)
            if physics.check(table, before, shot) is None:
                return shot
    raise ValueError(f"the cue is blocked in every direction: {before!r}")
