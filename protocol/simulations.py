"""The physics asked by message and answering by message, for whoever serves other languages."""

import dataclasses
import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

import physics
from physics import InvalidState, Status, TableState
from physics.constants import N_BALLS
from protocol.outcomes import EventView
from protocol.physics import (
    BatchAnswer,
    BatchRequest,
    BatchRow,
    FactsView,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
)

ON_TABLE = 0
"""`batch.pocket` is -1 for a ball on the table and -2 for one that was never there."""


def simulate(request: SimulateRequest, run: Callable[..., physics.Result] = physics.simulate) -> SimulateAnswer:
    """One shot; a shot that cannot be played is a result whose status says why. Raises `PhysicsError`."""
    table, state = request.table_model, TableState.from_positions(request.balls)
    result = run(table, state, request.shot.to_shot(), trace=request.trace)
    return SimulateAnswer(
        status=result.status.name.lower(),
        reason=result.status.explain(),
        duration=result.duration,
        n_events=result.n_events,
        balls=_balls(result.final.positions),
        facts=_facts(result),
        events=tuple(EventView.of(event) for event in result.events) if request.trace else None,
    )


def simulate_batch(request: BatchRequest, run: Callable[..., physics.Batch] = physics.simulate_batch) -> BatchAnswer:
    """Many shots, each on its own. Raises `PhysicsError` naming the first bad row."""
    batch = run(request.table_model, _tables(request), _shots(request))
    columns = (batch.status, batch.duration, batch.n_events, batch.positions, batch.pocket)
    rows = zip(*(column.tolist() for column in columns), strict=True)
    return BatchAnswer.model_construct(results=tuple(_row(*row) for row in rows))


def min_elevation(request: MinElevationRequest) -> MinElevationAnswer:
    """The least elevation at which the cue is free. Raises `PhysicsError`."""
    state = TableState.from_positions(request.balls)
    theta = physics.min_elevation(request.table_model, state, request.phi, request.a, request.b)
    return MinElevationAnswer(theta=None if math.isnan(theta) else theta)


def _facts(result: physics.Result) -> FactsView:
    """The facts by name; what cannot happen on a table without jaws is not said of it."""
    facts: FactsView = _plain(dataclasses.asdict(result.facts)) | {"status": result.status.name.lower()}
    if not result.table.has_jaws:
        del facts["miscue"]
    return facts


def _tables(request: BatchRequest) -> TableState | NDArray[np.float64]:
    if (request.balls is None) == (request.tables is None):
        raise InvalidState("balls", request.balls, "exactly one of balls (for all shots) and tables (one for each)")
    if request.balls is not None:
        return TableState.from_positions(request.balls)
    tables = request.tables or ()
    if len(tables) != len(request.shots):
        raise InvalidState("tables", len(tables), f"{len(request.shots)} tables, one for each shot")
    positions = np.full((len(tables), N_BALLS, 2), np.nan)
    for row, balls in zip(positions, tables, strict=True):
        row[list(balls)] = list(balls.values()) or np.empty((0, 2))
    return positions


def _shots(request: BatchRequest) -> NDArray[np.float64]:
    rows = [(shot.v, shot.phi, shot.theta, shot.a, shot.b) for shot in request.shots]
    return np.array(rows, dtype=np.float64)


def _row(status: int, duration: float, n_events: int, positions: list[list[float]], pocket: list[int]) -> BatchRow:
    """One row; there may be ten thousand, so that what the physics says is not validated again."""
    return BatchRow.model_construct(
        status=_NAMES[status],
        duration=duration,
        n_events=n_events,
        balls={ball: (x, y) for ball, (x, y) in enumerate(positions) if x == x},
        pocketed={ball: where for ball, where in enumerate(pocket) if where >= ON_TABLE},
    )


_NAMES = {status.value: status.name.lower() for status in Status}


def _balls(positions: NDArray[np.float64]) -> dict[int, tuple[float, float]]:
    on_table = np.flatnonzero(~np.isnan(positions[:, 0])).tolist()
    return {ball: (float(positions[ball, 0]), float(positions[ball, 1])) for ball in on_table}


def _plain(value: Any) -> Any:
    """Facts without NaN, which JSON lacks: null where something did not happen."""
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return None if isinstance(value, float) and math.isnan(value) else value
