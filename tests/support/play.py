"""A drawn scene played by the engine under test."""

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
