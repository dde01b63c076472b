"""Bad input is refused by an error that names the field, the value and what is allowed; nothing else escapes."""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import physics
from physics import InvalidShot, InvalidState, InvalidTable, PhysicsError, Shot, Table, TableState

TABLE = Table.olympiad()
STATE = TableState.from_positions({0: (0.5, 1.0), 3: (0.4, 0.6)})
FLIGHT = physics.simulate(TABLE, STATE, Shot(3.0, 250.0, 10.0)).at(0.3)


def changed(**parts: Any) -> Callable[[], object]:
    return lambda: physics.resume(TABLE, dataclasses.replace(FLIGHT, **parts))


CASES: dict[str, tuple[type[PhysicsError], Callable[[], object]]] = {
    "table name of another type": (InvalidTable, lambda: Table.from_dict({"name": []})),
    "table, text for a number": (InvalidTable, lambda: Table.from_dict({"name": "olympiad", "mu_slide": "x"})),
    "table, roll above slide": (InvalidTable, lambda: TABLE.replace(mu_roll=0.5)),
    "table, roll above new slide": (InvalidTable, lambda: TABLE.replace(mu_slide=0.01, mu_roll=0.02)),
    "table, unknown parameter": (InvalidTable, lambda: Table.from_dict({"name": "olympiad", "zzz": None})),
    "table, derived quantity": (InvalidTable, lambda: Table.from_dict({"name": "olympiad", "ball_radius": 0.028575})),
    "table, fixed dimension": (InvalidTable, lambda: Table("olympiad", width=2.0)),
    "table, not a mapping": (InvalidTable, lambda: Table.from_dict([])),  # type: ignore[arg-type]
    "shot, huge integer": (InvalidShot, lambda: Shot(3, 10**400)),
    "shot, array": (InvalidShot, lambda: Shot(np.array([1.0, 2.0]), 0)),  # type: ignore[arg-type]
    "shot, truth value": (InvalidShot, lambda: Shot(np.True_, 0)),  # type: ignore[arg-type]
    "shot, not a mapping": (InvalidShot, lambda: Shot.from_dict([1])),  # type: ignore[arg-type]
    "shot, unknown parameter": (InvalidShot, lambda: Shot(1, 2).replace(x=1)),
    "check of a tuple": (InvalidShot, lambda: physics.check(TABLE, STATE, (1, 2, 3, 4, 5))),  # type: ignore[arg-type]
    "state, text": (InvalidState, lambda: TableState.from_positions("abc")),
    "state, ragged": (InvalidState, lambda: TableState.from_positions([[1.0], [2.0, 3.0]])),
    "state, no mapping": (InvalidState, lambda: TableState.from_dict(None)),
    "state, ball 03": (InvalidState, lambda: TableState.from_dict({"03": [0.5, 0.5]})),
    "no cue ball to raise": (InvalidState, lambda: physics.min_elevation(TABLE, STATE.removed(0), 0.0)),
    "contact, text": (PhysicsError, lambda: physics.contact_time("ab", (0, 0), (0, 0), 1.0)),
    "contact, time as text": (PhysicsError, lambda: physics.contact_time((1, 0), (0, 0), (0, 0), "5")),  # type: ignore[arg-type]
    "rack, gap as text": (InvalidState, lambda: physics.rack(TABLE, seed=1, gap="x")),  # type: ignore[arg-type]
    "batch of float32": (InvalidShot, lambda: physics.simulate_batch(TABLE, STATE, np.ones((5, 5), np.float32))),
    "batch of text": (InvalidShot, lambda: physics.simulate_batch(TABLE, STATE, [["3"] * 5])),
    "batch of complex": (InvalidShot, lambda: physics.simulate_batch(TABLE, STATE, np.ones((5, 5), complex))),
    "snapshot without positions": (InvalidState, changed(positions=np.full((16, 2), np.nan))),
    "snapshot off the table": (InvalidState, changed(positions=FLIGHT.positions + 9.0)),
    "snapshot, unknown motion": (InvalidState, changed(motion=np.full(16, 9, np.int8))),
    "snapshot, moving at rest": (InvalidState, changed(motion=np.where(FLIGHT.motion < 4, 0, FLIGHT.motion))),
    "snapshot, rolling at rest": (
        InvalidState,
        changed(velocities=np.zeros((16, 2)), motion=np.where(FLIGHT.motion < 4, 3, FLIGHT.motion)),
    ),
    "snapshot, infinite spin": (InvalidState, changed(spins=np.full((16, 3), np.inf))),
    "snapshot, wrong shape": (InvalidState, changed(spins=np.zeros(3))),
}


@pytest.mark.parametrize("case", CASES)
def test_refused_by_name(case):
    kind, call = CASES[case]
    with pytest.raises(kind) as caught:
        call()
    assert caught.value.field
    assert caught.value.allowed
    assert caught.value.field in str(caught.value)


@pytest.mark.parametrize("counters", [np.zeros((1, 4), np.int64), np.zeros((5, 2), np.int64), np.zeros((5, 4))])
def test_counters_of_another_kind_are_refused(counters):
    """Kernels write there without looking: a wrong shape was heap corruption."""
    with pytest.raises(ValueError, match="counters"):
        physics.simulate_batch(TABLE, STATE, np.ones((5, 5)), counters=counters)


def test_an_empty_batch_is_a_batch():
    assert len(physics.simulate_batch(TABLE, STATE, np.empty((0, 5)))) == 0
    assert len(physics.simulate_batch(TABLE, np.empty((0, 16, 2)), np.empty((0, 5)))) == 0
