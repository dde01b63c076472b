"""Surveys of tables: how hard each group's balls are to make, and the best pots of the player who shoots next."""

import math
from typing import NamedTuple

from client.agents.search import shots as at
from client.agents.search.compiled.compiling import compiled, inner
from client.agents.search.compiled.fans import Layout, even_of, half_of, normal_between
from client.agents.search.compiled.pots import is_seen, placed, straight, usual
from client.agents.search.compiled.resting import EASE, lane_now, remember

BLOCKED = 0.8
"""Chance that a ball no pocket is open for will be made when its turn comes: others move by then, or it is banked."""


class Task(NamedTuple):
    """What to find about a group: whether its player shoots next, with the cue ball in hand, from which y on."""

    shoots: bool
    hand: bool
    kitchen: float


@inner
def survey_ball(view, memory, ball, sigma, task, out):
    """Add one ball to what is known of its group: its difficulty, and if its player shoots next, best pots."""
    easy, even = 0.0, 0.0
    column = at.PLACED if task.hand else at.CHANCE
    for pocket in range(6):
        lane, same = lane_now(view, memory, ball, pocket)
        if lane.fan.low >= lane.fan.high:
            continue
        if same:
            easy = max(easy, memory.lanes[ball, pocket, EASE])
        elif half_of(lane.fan) > even:  # else it is no easier than another
            chance = usual(view.table, lane.fan, sigma)
            if chance > easy:
                easy, even = chance, even_of(lane.fan)
        if not task.shoots:
            continue
        if task.hand:
            fan = placed(view, ball, lane, out[at.EVEN], task.kitchen)
        else:
            _, fan = straight(view, ball, lane, out[at.EVEN])
        if half_of(fan) > out[at.EVEN]:
            chance = normal_between(fan, sigma)
            if chance > out[column]:
                out[column], out[at.EVEN] = chance, max(out[at.EVEN], even_of(fan))
    out[at.LAYOUT] -= math.log(max(easy, BLOCKED))
    if task.shoots and not task.hand and out[at.SEEN] == 0.0 and (out[at.CHANCE] > 0.0 or is_seen(view, ball)):
        out[at.SEEN] = 1.0


@inner
def survey_group(view, memory, group, sigma, task, out):
    """What the balls of a group offer; the 8 counts as one to be made later, and at once if no other is left."""
    out[:] = 0.0
    left = 0
    for ball in range(1 + 8 * group, 8 + 8 * group):
        if view.row[ball, 0] == view.row[ball, 0]:
            left += 1
            survey_ball(view, memory, ball, sigma, task, out)
    if view.row[8, 0] == view.row[8, 0]:
        survey_ball(view, memory, 8, sigma, Task(task.shoots and left == 0, task.hand, task.kitchen), out)
        left += 1
    return left


@compiled
def survey(table, positions, sigma, hand, kitchen, memory, out):
    """What the balls of each group offer to the player who shoots next.

    Args:
        sigma: rad, of the cue's direction.
        hand: (n,) whether the cue ball is in hand. kitchen: the least y it may have then.
        memory: `new_memory`.
        out: (n, 2, 5), solids and stripes; see CHANCE and its fellows.
    """
    for n in range(positions.shape[0]):
        view = Layout(table, positions[n])
        remember(table, memory, positions[n], positions[n], sigma)
        for group in range(2):
            survey_group(view, memory, group, sigma, Task(True, hand[n], kitchen), out[n, group])
