"""The smallest scene that still fails: balls left out and values made plain while the fault stays."""

from collections.abc import Callable, Iterator

import numpy as np

import physics
from benchmarks import soundness
from benchmarks.scenes import N_BALLS, Floats

Scene = tuple[physics.Table, Floats, Floats]
"""Table, positions (16, 2), stroke (5,)."""


def faults(scene: Scene, instants: int = 400) -> set[str]:
    """Names of what is wrong with one shot, at its end or in flight."""
    table, state, shot = scene
    batch = physics.simulate_batch(table, state[None], shot[None])
    found = {name for name, rows in soundness.judge(table, state[None], batch).faults.items() if rows[0]}
    if batch.status[0] == physics.Status.AT_REST:
        result = physics.simulate(table, physics.TableState.trusted(state.copy()), physics.Shot(*shot.tolist()))
        deep, out, finite = soundness.judge_flight(table, result, instants)
        permitted = max(float(soundness.overlap(table, state[None])[0]), soundness.PERMITTED)
        found |= {"overlap"} if deep > permitted else set()
        found |= {"escape"} if out > max(float(soundness.beyond(table, state[None])[0]), soundness.PERMITTED) else set()
        found |= set() if finite else {"nan"}
    return found


def simpler(scene: Scene) -> Iterator[Scene]:
    """Scenes one step simpler: a ball fewer, a table parameter as usual, a value of the stroke plain."""
    table, state, shot = scene
    for ball in range(1, N_BALLS):
        if state[ball, 0] == state[ball, 0]:
            fewer = state.copy()
            fewer[ball] = np.nan
            yield table, fewer, shot
    usual = physics.Table.olympiad().to_dict()
    for name, value in table.to_dict().items():
        if value != usual[name] and name != "cue_test":
            try:
                yield table.replace(**{name: usual[name]}), state, shot
            except physics.InvalidTable:
                continue
    for column, values in enumerate(((1.0, 10.0), (), (0.0,), (0.0,), (0.0,))):
        for value in values:
            if shot[column] not in (value, 1.0):
                plain = shot.copy()
                plain[column] = value
                yield table, state, plain
    for digits in (1, 3, 6):
        rounded = shot.round(digits)
        if (rounded != shot).any():
            yield table, state, rounded


def shrink(scene: Scene, fault: str, fails: Callable[[Scene], set[str]] = faults) -> Scene:
    """Simplify while ``fault`` stays."""
    while True:
        for candidate in simpler(scene):
            if fault in fails(candidate):
                scene = candidate
                break
        else:
            return scene
