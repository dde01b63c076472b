"""Balls racked for the break (R1 to R7), by draws that are given."""

import numpy as np

from client.learn.compiled.compiling import compiled, inner
from client.learn.compiled.groups import EIGHT
from physics.kernels import layout as at


@inner
def shuffle(items, draws, first):
    """Put items in random order, by the draws from the first one on."""
    for i in range(items.shape[0] - 1, 0, -1):
        j = int(draws[first + i - 1] * (i + 1))
        items[i], items[j] = items[j], items[i]


@compiled
def rack(triangle, diameter, sigma, cue_ball, uniforms, normals, places):
    """Balls racked for a break (R1 to R7), each rack by its own draws.

    Args:
        triangle: (15, 2) m, the places row by row. cue_ball: (2,) m. sigma: m, standard deviation of a coordinate.
        uniforms: (m, 15) in [0, 1). normals: (m, tries, 15, 2): where two balls would touch, the next are taken; the
            exact triangle when all do.
        places: (m, 16, 2), filled.
    """
    order, others, moved = np.empty(15, np.int64), np.empty(12, np.int64), np.empty((15, 2))
    for k in range(places.shape[0]):
        draws = uniforms[k]
        solid, stripe = 1 + int(draws[0] * 7), 9 + int(draws[1] * 7)
        west_is_solid = draws[2] < 0.5
        n = 0
        for ball in range(1, at.LANES):
            if ball != EIGHT and ball != solid and ball != stripe:
                others[n] = ball
                n += 1
        shuffle(others, draws, 3)
        n = 0
        for spot in range(15):
            if spot == 4:
                order[spot] = EIGHT
            elif spot == 10:
                order[spot] = solid if west_is_solid else stripe
            elif spot == 14:
                order[spot] = stripe if west_is_solid else solid
            else:
                order[spot] = others[n]
                n += 1
        moved[:] = triangle
        for attempt in range(normals.shape[1]):
            clear = True
            for spot in range(15):
                for axis in range(2):
                    moved[spot, axis] = triangle[spot, axis] + sigma * normals[k, attempt, spot, axis]
                for other in range(spot):
                    dx, dy = moved[spot, 0] - moved[other, 0], moved[spot, 1] - moved[other, 1]
                    clear &= dx * dx + dy * dy > diameter * diameter
            if clear:
                break
            moved[:] = triangle
        places[k, 0] = cue_ball
        for spot in range(15):
            places[k, order[spot]] = moved[spot]
