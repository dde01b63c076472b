"""A break played in every way there is: on every machine the same digest, bit for bit."""

import dataclasses
import hashlib

from physics.batch import simulate_batch
from physics.cue import check, min_elevation
from physics.rack import rack
from physics.shot import Shot
from physics.simulation import simulate
from physics.table import Table

SEED = 7


@dataclasses.dataclass(frozen=True, slots=True)
class SelfTest:
    """What the break came to.

    Attributes:
        ok: whether the shot can be played, and every way of simulating it ends with the same bits.
        digest: SHA-256 (hex) of the final positions.
        events: how many there were.
    """

    ok: bool
    digest: str
    events: int


def self_test(jaws: bool = False) -> SelfTest:
    """Play it on the Olympiad's table, or on one with jaws.

    Afterwards all the compiled functions that playing and serving on such tables need are loaded.
    """
    table = Table.nine_foot() if jaws else Table.olympiad()
    state = rack(table, "eight_ball", seed=SEED)
    shot = Shot(9.0, 270.0, min_elevation(table, state, 270.0))
    result = simulate(table, state, shot)
    row = [[shot.v, shot.phi, shot.theta, shot.a, shot.b]]
    batch = simulate_batch(table, state.positions[None].copy(), row)
    finals = {result.final, simulate(table, state, shot, trace=False).final, batch.state(0)}
    returns = bool(abs(result.at(0.0).positions - state.positions).max() < 1e-12)
    digest = hashlib.sha256(result.final.positions.tobytes()).hexdigest()
    return SelfTest(check(table, state, shot) is None and len(finals) == 1 and returns, digest, result.n_events)
