"""Chained shots: every final position, through JSON, is the start of the next shot. None may be refused.

A shot is drawn among those that can be played. The balls are racked again when the cue ball or nearly all others are
gone. Nothing here looks inside the physics: only its public functions are called.
"""

import dataclasses
import json

import numpy as np

import physics
from benchmarks.command import main
from benchmarks.recording import Row, Tables
from physics import Shot, Status, TableState

SEED = 2048
TABLE = physics.Table.olympiad()
FEWEST = 3
"""Balls below which they are racked again."""
MOST_FAILURES = 24
"""Failures kept in the data line; the table counts all."""


@dataclasses.dataclass
class Tally:
    """What came of the shots.

    Attributes:
        shots: tried. racks: how often the balls were racked. longest: most shots from one rack.
        refused: starts that the physics did not take. changed: positions that JSON brought back with other bits.
        unended: shots that did not come to rest.
    """

    shots: int = 0
    racks: int = 0
    longest: int = 0
    events: int = 0
    refused: int = 0
    changed: int = 0
    unended: int = 0
    failures: list[Row] = dataclasses.field(default_factory=list)

    def fail(self, fault: str, state: TableState, words: str) -> None:
        """Count a fault, and keep where it happened."""
        setattr(self, fault, getattr(self, fault) + 1)
        if len(self.failures) < MOST_FAILURES:
            self.failures.append({"fault": fault, "start": json.dumps(state.to_dict()), "words": words})


def measure(full: bool) -> Tables:
    """Play the shots; a row of counts, and the failures."""
    tally = chain(100_000 if full else 2_000, SEED)
    counts = dataclasses.asdict(tally)
    failures = counts.pop("failures")
    return {"chained": [{"table": TABLE.name, **counts}], "failures": failures}


def chain(shots: int, seed: int) -> Tally:
    """Play ``shots`` shots, each from where the last one ended."""
    rng, tally = np.random.default_rng(seed), Tally()
    while tally.shots < shots:
        state: TableState | None = physics.rack(TABLE, "eight_ball", seed=tally.racks)
        tally.racks += 1
        first = tally.shots
        while state is not None and goes_on(state) and tally.shots < shots:
            tally.shots += 1
            state = follow(state, rng, tally)
        tally.longest = max(tally.longest, tally.shots - first)
    return tally


def goes_on(state: TableState) -> bool:
    """Whether there is a shot to play and something to play it at."""
    return state.position(0) is not None and len(state.balls) >= FEWEST


def follow(state: TableState, rng: np.random.Generator, tally: Tally) -> TableState | None:
    """Play one shot: where it ends, read back from JSON; None when that cannot be played on."""
    try:
        shot = any_shot(state, rng)
        result = physics.simulate(TABLE, state, shot, trace=False)
        again = through_json(result.final)
    except physics.InvalidState as error:
        tally.fail("refused", state, str(error))
        return None
    tally.events += result.n_events
    if result.status != Status.AT_REST:
        tally.fail("unended", state, f"{result.status.name}: {shot!r}")
        return None
    if again != result.final:
        tally.fail("changed", state, repr(shot))
    return again


def any_shot(state: TableState, rng: np.random.Generator) -> Shot:
    """Any shot that can be played: every direction, speeds to 10 m/s, tip offsets to 10 mm, cue up to 15 deg raised."""
    while True:
        v, phi, lift, a, b = (float(x) for x in rng.uniform([0.1, 0, 0, -10, -10], [10, 360, 15, 10, 10]))
        theta = physics.min_elevation(TABLE, state, phi, a, b) + lift
        if not theta <= TABLE.theta_max:  # NaN too: blocked at every elevation
            continue
        shot = Shot(v, phi, theta, a, b)
        if physics.check(TABLE, state, shot) is None:
            return shot


def through_json(state: TableState) -> TableState:
    """The state as it reads back from its JSON text."""
    return TableState.from_dict(json.loads(json.dumps(state.to_dict())))


if __name__ == "__main__":
    main("chained", measure)
