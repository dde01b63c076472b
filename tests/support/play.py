"""A drawn scene played by the engine under test."""

import math
from dataclasses import replace

from support.scenes import Scene

import physics

OPEN = physics.Table.olympiad().replace(cue_test=False)
"""The default table without the test of the cue: every drawn stroke is played."""


def state_of(scene: Scene) -> physics.TableState:
    return physics.TableState.from_positions(scene.positions)


def play(scene: Scene, table: physics.Table = OPEN, **options: bool) -> physics.Result:
    return physics.simulate(table, state_of(scene), physics.Shot(*scene.stroke), **options)


def joint(result: physics.Result) -> bool:
    """Did the contact rule act on more than a lone pair: a ball in two contacts at one instant, or a parting?"""
    seen: dict[float, set[int]] = {}
    for event in result.events:
        if event.kind.value == "contact":
            return True
        if event.kind.value == "ball_collision":
            balls = seen.setdefault(event.time, set())
            if balls & {event.ball, event.other}:
                return True
            balls |= {event.ball, event.other}
    return False


def apart(one: physics.TableState, two: physics.TableState) -> float:
    """Largest distance between the places of a ball in two ends (m); infinite if it is in play in one only."""
    if one.balls != two.balls:
        return math.inf
    return max((math.dist(one.positions[ball], two.positions[ball]) for ball in one.balls), default=0.0)


def sensitivity(scene: Scene, table: physics.Table = OPEN) -> float:
    """How far the end moves when v moves by one ulp, up or down (m): what rounding alone can do to this shot."""
    v, phi, theta, a, b = scene.stroke
    end = play(scene, table, trace=False).final
    nudged = [replace(scene, stroke=(math.nextafter(v, to), phi, theta, a, b)) for to in (0.0, 10.0)]
    return max(apart(end, play(other, table, trace=False).final) for other in nudged)
