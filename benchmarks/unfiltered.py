"""Kernels without a filter of pairs and without a broad phase, in a process of their own, to compare bits with.

Every pair of balls is solved for, and every ball, rolling or flying, looks at all noses, jaws and holes each time. What
the shipped kernels leave out must have been nothing: positions, pockets, facts and counts of events are the same bits.
"""

import hashlib
import importlib
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import physics
from benchmarks import hostile_scenes, variants

Hashes = NDArray[np.uint64]

PREDICTION = "physics.kernels.detect.prediction"


def look_at_everything(*_: object) -> None:
    """In a new process: replaces the filter and the broad phase before the kernels load."""
    from physics.kernels import layout as at
    from physics.kernels.compiling import kernel, load, load_integer
    from physics.kernels.detect import mouths
    from physics.kernels.detect.air import meet_in_air
    from physics.kernels.detect.boundary import Coming, meet_octagon
    from physics.kernels.path import along, rise_of
    from physics.kernels.workspace import by_table

    usual = importlib.import_module(PREDICTION).partners
    reached, beside_long_nose, beside_short_nose = mouths.reached, mouths.beside_long_nose, mouths.beside_short_nose
    meet_mouth = mouths.meet_mouth

    @kernel
    def everyone(s: Any, i: int, path: Any, now: float, limit: float) -> int:
        return usual(s, i, path, now, limit) | 0xFFFF

    @kernel
    def near_all(_half: float, _place: float, _speed: float, _lasts: float) -> tuple[float, float]:
        return -1.0, -1.0

    @kernel
    def always(_s: Any, _pocket: int, _path: Any, _lasts: float) -> bool:
        return True

    @kernel
    def meet_octagon_of(s: Any, _i: int, path: Any, _now: float, lasts: float) -> Any:
        return meet_octagon(s, path, lasts)

    @kernel
    def meet_everything(s: Any, i: int, path: Any, now: float, lasts: float) -> Any:
        if load_integer(s.k, at.MOTION + i) == at.FLYING:
            return meet_in_air(s, path, rise_of(s, i, now), lasts)
        best = Coming(lasts, at.NOTHING, 0)
        for line in range(4):
            sign = 1.0 if line & 1 else -1.0
            if line <= at.EAST:
                gap = load(s.p, at.P_LINE_X) - sign * path.x
                t = reached(gap, sign * path.vx, sign * path.hx, beside_long_nose(s, path.y))
                on_nose = t < lasts and beside_long_nose(s, along(path.y, path.vy, path.hy, t))
            else:
                gap = load(s.p, at.P_LINE_Y) - sign * path.y
                t = reached(gap, sign * path.vy, sign * path.hy, beside_short_nose(s, path.x))
                on_nose = t < lasts and beside_short_nose(s, along(path.x, path.vx, path.hx, t))
            if on_nose and t < best.time:
                best = Coming(t, at.MEET_CUSHION, line)
        for pocket in range(6):
            best = meet_mouth(s, pocket, path, lasts, best)
        return best

    variants.replace(PREDICTION, "partners", everyone)
    variants.replace(PREDICTION, "meet_boundary", by_table(meet_octagon_of, meet_everything))
    variants.replace("physics.kernels.detect.air", "nearest_to", near_all)
    variants.replace("physics.kernels.detect.air", "may_come_to", always)


def hashes_of(batch: physics.Batch) -> Hashes:
    """(n,) of all that each shot of a batch left."""
    facts = [batch.facts[name] for name in batch.facts.dtype.names]
    rows = zip(batch.positions, batch.pocket, batch.status, *facts, strict=True)
    digests = [hashlib.sha256(b"".join(np.asarray(part).tobytes() for part in row)).digest()[:8] for row in rows]
    return np.frombuffer(b"".join(digests), np.uint64)


def replayed(jobs: list[tuple[str, int, int]]) -> list[Hashes]:
    """Hashes of chunks (class, seed, shots) of the stress run."""
    found = []
    for done, job in enumerate(jobs):
        found.append(hashes_of(physics.simulate_batch(*hostile_scenes.scene_of(*job))))
        if done % 10 == 0:
            print(f"{done} of {len(jobs)} chunks without filter", flush=True)
    return found


def left_by(scenes: Sequence[tuple[physics.Table, dict[int, tuple[float, float]], physics.Shot]]) -> list[Hashes]:
    """Hashes of single shots."""
    return [
        hashes_of(physics.simulate_batch(table, physics.TableState.from_positions(balls), [shot]))
        for table, balls, shot in scenes
    ]
