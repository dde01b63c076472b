"""What a learner sees and does, as vectors: a game as numbers in [0, 1], an action from numbers in [-1, 1].

On every table alike: places are shares of its width and length, speed is a share of its `v_max`, elevation of what its
`theta_max` leaves above the least that is free. A ball in the jaws, beyond the noses, is seen at the edge.

Every vector in [-1, 1]^8 is a legal action: elevations count from the least that is free, a place that is taken gives
way to the nearest free one, calls and decisions are chosen among those that are open.
"""

import math
from collections.abc import Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from client.geometry import are_free, lattice
from physics import Table, TableState
from physics.constants import N_BALLS, N_POCKETS
from physics.cue import are_playable, min_elevation, min_elevations
from referee import Action, Call, CueBallArea, Decision, Game, Group, Phase
from referee.play.batch import Strokes, groups_of_shooters
from referee.rules.batch_rulings import SAFETY_CALL, target_balls

Vector = NDArray[np.float32]
Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

ACTION_NAMES: Final = ("speed", "direction", "elevation", "side", "height", "place_x", "place_y", "choice")
"""The numbers of an action, in order, each in [-1, 1] as a share of:

- `speed`: 0 to the table's `v_max`;
- `direction`: `phi` from 0 to 360 degrees, a blocked one turned on in steps of 5 degrees;
- `elevation`: the square of the share, from the least elevation that is free to the table's `theta_max`;
- `side`, `height`: the tip's `a` and `b`, from -`OFFSET` to `OFFSET` mm;
- `place_x`, `place_y`: where a cue ball in hand goes, over the table or the kitchen; else ignored;
- `choice`: the call (each ball that may be called into each pocket, at the end a safety), or the decision.
"""
ACTION_SIZE: Final = len(ACTION_NAMES)
DECISIONS: Final = tuple(each for each in Decision if each is not Decision.CONCEDE)
PHASES: Final = (Phase.BREAK, Phase.PLAY, Phase.DECISION)
AREAS: Final = (None, CueBallArea.KITCHEN, CueBallArea.ANYWHERE)
GROUPS: Final = (None, Group.SOLIDS, Group.STRIPES)
OBSERVATION_SIZE: Final = 3 * N_BALLS + len(PHASES) + len(AREAS) + len(GROUPS) + len(DECISIONS) + 2
"""Balls, phase, cue ball in hand, groups, decisions open, stalemate counter, strokes."""

OFFSET: Final = 14.0
"""mm, the greatest tip offset to a side: with as much in height, still on the ball."""
LATTICE: Final = (9, 15)
"""Columns and rows of the places that stand in for one that is taken."""
MARGIN: Final = 0.5
"""Degrees above the least elevation, for when the one asked for cannot be played."""
TURNS: Final = 72
"""Directions tried, all round, when the cue is blocked at every elevation in the one asked for."""
SPEED, DIRECTION, ELEVATION, SIDE, HEIGHT, PLACE_X, PLACE_Y, CHOICE = range(ACTION_SIZE)
PHI, THETA = 1, 2
"""Columns of a stroke."""
_PHASE: Final = {each: tuple([each is phase for phase in PHASES]) for each in Phase}
_AREA: Final = {each: tuple([each is area for area in AREAS]) for each in AREAS}
_GROUP: Final = {each: tuple([each is group for group in GROUPS]) for each in GROUPS}
_NO_DECISIONS: Final = (False,) * len(DECISIONS)
"""What of an observation is one-hot, by value."""
_ORDERS: Final = (tuple(range(N_BALLS)), (0, *range(9, 16), 8, *range(1, 8)))
"""Balls as a player sees them who has solids or no group, and one who has stripes."""


def observe(table: Table, game: Game, seat: int) -> Vector:
    """The game as the player of `seat` sees it, `(OBSERVATION_SIZE,)` float32 in [0, 1].

    Of each ball x and y as shares of width and length and whether it is on the table: first the cue ball, then the own
    group, the 8, the others (solids first while the table is open). Then one-hot the phase, where the cue ball may be
    placed, the groups (open, own solids, own stripes), the decisions open, and as shares of their limits the stalemate
    counter (24 visits) and the strokes (400).
    """
    seen: Vector = observe_all(table, [game], [seat])[0]
    return seen


def observe_all(table: Table, games: Sequence[Game], seats: Sequence[int]) -> Vector:
    """`observe` for each of n games with its seat, `(n, OBSERVATION_SIZE)`."""
    own = [game.group_of(seat) for game, seat in zip(games, seats, strict=True)]
    order = np.array(_ORDERS)[[int(group is Group.STRIPES) for group in own]]
    positions = np.stack([game.state.positions for game in games])
    places = np.take_along_axis(positions, order[:, :, None], axis=1) / (table.width, table.length)
    there = ~np.isnan(places[:, :, :1])
    balls = np.concatenate((np.where(there, np.clip(places, 0.0, 1.0), 0.0), there), axis=2)
    state = [_state_of(game, group) for game, group in zip(games, own, strict=True)]
    return np.concatenate((balls.reshape(len(games), -1), state), axis=1).astype(np.float32)


def _state_of(game: Game, own: Group | None) -> tuple[float, ...]:
    """What there is to know of a game beside the balls."""
    decisions = tuple([decision in game.decisions for decision in DECISIONS]) if game.decisions else _NO_DECISIONS
    counters = min(1.0, game.dry_visits / 24.0), min(1.0, game.stroke / 400.0)
    return *_PHASE[game.phase], *_AREA[game.cue_ball_in_hand], *_GROUP[own], *decisions, *counters


def act(table: Table, game: Game, vector: NDArray[np.floating]) -> Action:
    """The legal action that a vector of `ACTION_SIZE` numbers stands for; those beyond [-1, 1] count as the bound.

    Raises:
        ValueError: the action has another shape, or holds NaN.
    """
    if game.decisions:
        share = _shares(np.asarray(vector)[None], 1)[0, CHOICE]
        return Action(decision=game.decisions[min(int(share * len(game.decisions)), len(game.decisions) - 1)])
    return strokes(table, [game], np.asarray(vector)[None]).action(0)


def strokes(table: Table, games: Sequence[Game], vectors: NDArray[np.floating]) -> Strokes:
    """The legal strokes that n vectors stand for, `(n, ACTION_SIZE)`, one in each of n games that await no decision.

    Raises:
        ValueError: as for `act`.
    """
    shares = _shares(vectors, len(games))
    before = np.stack([game.state.positions for game in games])
    _place_cue_balls(table, games, before, shares)
    ball, pocket = _calls(games, before, shares[:, CHOICE])
    return Strokes(games, before, _shots(table, before, shares), ball, pocket)


def encode(table: Table, game: Game, action: Action) -> Vector:
    """The vector that `act` reads as this action, to the precision of float32: what a policy that imitates is shown.

    Raises:
        ValueError: a concession, or a tip offset beyond `OFFSET`: no vector stands for it.
    """
    shares = np.full(ACTION_SIZE, 0.5)
    if action.decision is not None:
        if action.decision not in (game.decisions or ()):
            raise ValueError(f"decision = {action.decision}: must be one of {game.decisions}, no vector is another")
        shares[CHOICE] = (game.decisions.index(action.decision) + 0.5) / len(game.decisions)
        return _vector(shares)
    shot, state = action.shot, game.state
    assert shot is not None
    if action.cue_ball is not None:
        state = state.moved(0, action.cue_ball)
        shares[[PLACE_X, PLACE_Y]] = _place_shares(table, game, action.cue_ball)
    for field, offset in (("a", shot.a), ("b", shot.b)):
        if abs(offset) > OFFSET:
            raise ValueError(f"{field} = {offset}: must be from -{OFFSET:g} to {OFFSET:g} mm")
    shares[[SPEED, DIRECTION]] = shot.v / table.v_max, shot.phi % 360.0 / 360.0
    shares[[SIDE, HEIGHT]] = 0.5 * (shot.a / OFFSET + 1.0), 0.5 * (shot.b / OFFSET + 1.0)
    least = min_elevation(table, state, shot.phi, shot.a, shot.b)
    if shot.theta > least:  # no number where the cue is blocked at any: `act` turns such a stroke
        shares[ELEVATION] = math.sqrt((shot.theta - least) / (table.theta_max - least))
    else:
        shares[ELEVATION] = 0.0
    shares[CHOICE] = _call_share(game, state, action)
    return _vector(shares)


def _vector(shares: Floats) -> Vector:
    return (2.0 * shares - 1.0).astype(np.float32)


def _place_shares(table: Table, game: Game, place: tuple[float, float]) -> tuple[float, float]:
    """The inverse of what `_place_cue_balls` does with them."""
    radius = table.ball_radius
    low = table.head_string if game.cue_ball_in_hand is CueBallArea.KITCHEN else radius
    return (place[0] - radius) / (table.width - 2.0 * radius), (place[1] - low) / (table.length - radius - low)


def _call_share(game: Game, state: TableState, action: Action) -> float:
    """The middle of the stretch that `_calls` reads as the action's call."""
    if not isinstance(action.call, Call):
        return 1.0
    balls = np.flatnonzero(target_balls(state.positions[None], groups_of_shooters([game]))[0]).tolist()
    number = balls.index(action.call.ball) * N_POCKETS + action.call.pocket
    share: float = (number + 0.5) / (len(balls) * N_POCKETS + 1)
    return share


def _shares(vectors: NDArray[np.floating], count: int) -> Floats:
    """The numbers as shares in [0, 1]."""
    values = np.asarray(vectors, dtype=np.float64)
    if values.shape != (count, ACTION_SIZE):
        raise ValueError(f"an action has shape {values.shape[1:]}; it must be ({ACTION_SIZE},)")
    if np.isnan(values).any():
        raise ValueError(f"an action is {values[np.isnan(values).any(axis=1)][0].tolist()}; NaN is no number")
    shares: Floats = (np.clip(values, -1.0, 1.0) + 1.0) * 0.5
    return shares


def _calls(games: Sequence[Game], before: Floats, share: Floats) -> tuple[Integers, Integers]:
    """One of the balls that may be called with one of the pockets, or a safety: all in a row, each as wide."""
    targets = target_balls(before, groups_of_shooters(games))
    balls = targets.sum(axis=1)
    rank, pocket = np.divmod(
        np.minimum((share * (balls * N_POCKETS + 1)).astype(np.int64), balls * N_POCKETS), N_POCKETS
    )
    uncalled = (rank == balls) | np.array([game.phase is Phase.BREAK for game in games])
    by_rank = np.argsort(~targets, axis=1, kind="stable")
    ball = by_rank[np.arange(len(games)), np.minimum(rank, N_BALLS - 1)]
    return np.where(uncalled, SAFETY_CALL, ball), np.where(uncalled, SAFETY_CALL, pocket)


def _place_cue_balls(table: Table, games: Sequence[Game], before: Floats, shares: Floats) -> None:
    """Where it is in hand, put it at the place asked for, or at the nearest free one of a lattice."""
    rows = [row for row, game in enumerate(games) if game.cue_ball_in_hand is not None]
    if not rows:
        return
    kitchen = np.array([games[row].cue_ball_in_hand is CueBallArea.KITCHEN for row in rows])
    radius = table.ball_radius
    low = np.where(kitchen, table.head_string, radius)
    x = radius + shares[rows, PLACE_X] * (table.width - 2.0 * radius)
    y = low + shares[rows, PLACE_Y] * (table.length - radius - low)
    wanted = np.column_stack((x, y))
    free = are_free(table, before[rows], wanted[:, None, :], kitchen)[:, 0]
    for number in np.flatnonzero(~free).tolist():
        places = np.array(lattice(table, games[rows[number]].state, *LATTICE, bool(kitchen[number])))
        wanted[number] = places[np.hypot(*(places - wanted[number]).T).argmin()]
    before[rows, 0] = wanted


def _shots(table: Table, before: Floats, shares: Floats) -> Floats:
    """The strokes asked for, (n, 5), turned as far as need be for the cue to be free."""
    a, b = (2.0 * shares[:, SIDE] - 1.0) * OFFSET, (2.0 * shares[:, HEIGHT] - 1.0) * OFFSET
    shots = np.column_stack((shares[:, SPEED] * table.v_max, np.zeros((len(shares), 2)), a, b))
    left = np.arange(len(shares))
    for turn in range(TURNS):
        shots[left, PHI] = 360.0 * (shares[left, DIRECTION] + turn / TURNS)
        left = left[~_raise_cues(table, before, shots, left, shares[:, ELEVATION])]
        if not len(left):
            return shots
    raise ValueError(f"the cue is blocked in every direction, the balls at {before[left[0]].tolist()}")


def _raise_cues(table: Table, before: Floats, shots: Floats, rows: Integers, share: Floats) -> NDArray[np.bool_]:
    """Elevate these strokes as asked for, or as little as can be; which of them can be played."""
    _, phi, _, a, b = shots[rows].T
    least = min_elevations(table, before[rows], phi, a, b)
    wanted = least + (table.theta_max - least) * share[rows] ** 2
    free = np.zeros(len(rows), np.bool_)
    for theta in (wanted, np.minimum(table.theta_max, least + MARGIN), least):
        tried = np.flatnonzero(~free & ~np.isnan(least))
        if not len(tried):
            break
        shots[rows[tried], THETA] = theta[tried]
        free[tried] = are_playable(table, before[rows[tried]], shots[rows[tried]])
    return free
