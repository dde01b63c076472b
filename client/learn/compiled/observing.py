"""A game as its player sees it, in a row of numbers: `codec.observe`, compiled."""

import numpy as np

from client.learn.compiled import layout as to
from client.learn.compiled.compiling import compiled
from client.learn.compiled.decisions import count_decisions, decision_at
from client.learn.compiled.groups import group_of
from physics.kernels import layout as at


@compiled
def observe(table, places, games, rows, seats, seen):
    """`codec.observe` of each row, by the seat given for it, into `seen` (m, OBSERVATION_SIZE) float32."""
    seen[:] = 0.0
    for k in range(rows.shape[0]):
        game, lies, out = games[rows[k]], places[rows[k]], seen[k]
        group = group_of(game, seats[k])
        for n in range(at.LANES):
            ball = n
            if group == 1 and n != 0:
                ball = n + 8 if n < 8 else (8 if n == 8 else n - 8)
            x, y = lies[ball, 0], lies[ball, 1]
            if x == x:
                out[3 * n] = np.float32(min(max(x / table[to.T_WIDTH], 0.0), 1.0))
                out[3 * n + 1] = np.float32(min(max(y / table[to.T_LENGTH], 0.0), 1.0))
                out[3 * n + 2] = 1.0
        at_phase = 3 * at.LANES
        phase = game[to.PHASE]
        if phase <= to.DECISION:
            out[at_phase + phase] = 1.0
        out[at_phase + 3 + game[to.AREA]] = 1.0
        out[at_phase + 6 + (0 if group == to.OPEN else 1 + group)] = 1.0
        if phase == to.DECISION:
            here = lies[0, 0] == lies[0, 0]
            for number in range(count_decisions(game, here)):
                out[at_phase + 9 + decision_at(game, here, number)] = 1.0
        out[at_phase + 14] = np.float32(min(1.0, game[to.DRY_VISITS] / 24.0))
        out[at_phase + 15] = np.float32(min(1.0, game[to.STROKE] / 400.0))
