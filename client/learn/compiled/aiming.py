"""An action's numbers made a stroke that can be played: `codec.act`, compiled, and the game's noise."""

import math

import numpy as np

from client.learn.compiled import layout as to
from client.learn.compiled.compiling import compiled, inner
from client.learn.compiled.decisions import decide
from client.learn.compiled.groups import EIGHT, group_of, in_group, is_on_eight
from client.learn.compiled.placing import put
from physics.kernels import layout as at
from physics.kernels.compiling import load, row
from physics.kernels.start import place
from physics.kernels.strike import MILLIMETRE, lowest_elevation, playable, read_stroke
from physics.kernels.workspace import bare_real_workspace, bare_workspace


@inner
def call(game, before, share):
    """The ball and the pocket that a number in [0, 1] calls; SAFETY for none, and on the break."""
    if game[to.PHASE] == to.BREAK:
        return to.SAFETY, to.SAFETY
    group, balls = group_of(game, game[to.TURN]), 0
    eight = is_on_eight(before, group)
    for ball in range(1, at.LANES):
        callable_now = ball == EIGHT if eight else in_group(ball, group)
        balls += int(callable_now and before[ball, 0] == before[ball, 0])
    chosen = min(int(share * (balls * 6 + 1)), balls * 6)
    left, pocket = chosen // 6, chosen % 6
    for ball in range(1, at.LANES):
        callable_now = ball == EIGHT if eight else in_group(ball, group)
        if callable_now and before[ball, 0] == before[ball, 0]:
            if left == 0:
                return ball, pocket
            left -= 1
    return to.SAFETY, to.SAFETY


@inner
def raise_cue(s, table, shots, k, share):
    """Elevate a stroke as asked for, or as little as can be; whether it can be played. `s` has the balls laid out."""
    shot = shots[k]
    least = 0.0
    if load(s.p, at.P_CUE_TEST) != 0.0:
        least = lowest_elevation(s, shot[at.S_PHI], shot[at.S_A] * MILLIMETRE, shot[at.S_B] * MILLIMETRE)
    if math.isnan(least):
        return False
    wanted = least + (table[to.T_ELEVATION] - least) * (share * share)
    for n in range(3):
        shot[at.S_THETA] = wanted if n == 0 else least
        if n == 1:
            shot[at.S_THETA] = min(table[to.T_ELEVATION], least + table[to.T_MARGIN])
        if playable(s, read_stroke(row(shots, k))) == at.AT_REST:
            return True
    return False


@inner
def mod_360(phi):
    """As `referee.play.noise` has it, of an angle in (-360, 720), where the difference is exact."""
    rest = phi - 360.0 if phi >= 360.0 else phi
    if rest < 0.0:
        rest += 360.0
    return rest if rest < 360.0 else 0.0


@inner
def disturb(table, shot, sigmas, draw):
    """Add the game's noise, as `NoiseModel.perturb_rows` does."""
    shot[at.S_V] = min(max(shot[at.S_V] + sigmas[at.S_V] * draw[at.S_V], 0.0), table[to.T_SPEED])
    shot[at.S_PHI] = mod_360(mod_360(shot[at.S_PHI]) + sigmas[at.S_PHI] * draw[at.S_PHI])
    theta = shot[at.S_THETA] + sigmas[at.S_THETA] * draw[at.S_THETA]
    shot[at.S_THETA] = min(max(theta, 0.0), table[to.T_ELEVATION])
    shot[at.S_A] += sigmas[at.S_A] * draw[at.S_A]
    shot[at.S_B] += sigmas[at.S_B] * draw[at.S_B]


@inner
def aim_row(s, table, lattice, k, game, share, before, shots, calls, turns):
    """One stroke as it is meant; what became of it."""
    if game[to.AREA] != to.NOT_IN_HAND:
        put(s, table, lattice, game, before[k], share)
    calls[k, 0], calls[k, 1] = call(game, before[k], share[to.CHOOSING])
    shot = shots[k]
    shot[at.S_V] = share[to.SPEED] * table[to.T_SPEED]
    shot[at.S_A] = (2.0 * share[to.SIDE] - 1.0) * table[to.T_OFFSET]
    shot[at.S_B] = (2.0 * share[to.HEIGHT] - 1.0) * table[to.T_OFFSET]
    place(s, row(before.reshape((before.shape[0], 2 * at.LANES)), k))
    for turn in range(turns):
        shot[at.S_PHI] = 360.0 * (share[to.DIRECTION] + turn / turns)
        if raise_cue(s, table, shots, k, share[to.ELEVATION]):
            return to.PLAYED
    return to.UNSTRUCK


@inner
def aim(s, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns):
    """Decisions are made at once; strokes are aimed: see `aim_straight`."""
    sigmas, draws = noise
    share = np.empty(8)
    for k in range(rows.shape[0]):
        game = games[rows[k]]
        before[k] = places[rows[k]]
        for n in range(8):
            share[n] = (min(max(float(vectors[k, n]), -1.0), 1.0) + 1.0) * 0.5
        if game[to.PHASE] == to.DECISION:
            became[k] = decide(game, before[k, 0, 0] == before[k, 0, 0], share[to.CHOOSING])
            continue
        became[k] = aim_row(s, table, lattice, k, game, share, before, shots, calls, turns)
        if sigmas[at.S_V] > 0.0 and became[k] == to.PLAYED:
            disturb(table, shots[k], sigmas, draws[k])


@compiled
def aim_straight(p, work, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns):
    """Make decisions, aim strokes: `codec.act` of each row, and the game's noise.

    Args:
        p, work: of the physics. table: numbers by `layout`. lattice: (3, m) m, NaN behind the end of each: x of its
            columns, y of its rows, y of its rows in the kitchen.
        vectors: (m, 8). noise: standard deviations (5,) and normal draws (m, 5), columns v, phi, theta, a, b.
        before: (m, 16, 2), filled with the tables, cue balls placed. shots: (m, 5), filled. calls: (m, 2), ball and
            pocket, filled. became: (m,), filled. turns: directions tried, all round.
    """
    aim(
        bare_workspace(p, work),
        table,
        lattice,
        places,
        games,
        rows,
        vectors,
        noise,
        before,
        shots,
        calls,
        became,
        turns,
    )


@compiled
def aim_with_jaws(p, work, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns):
    """`aim_straight` on a table with jaws."""
    s = bare_real_workspace(p, work)
    aim(s, table, lattice, places, games, rows, vectors, noise, before, shots, calls, became, turns)
