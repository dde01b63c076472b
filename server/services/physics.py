"""The physics alone, for clients in any language."""

from collections.abc import Callable
from typing import TypeVar

from physics import PhysicsError
from referee.wire import (
    BatchAnswer,
    BatchRequest,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
    simulations,
)
from server.errors import invalid_physics

Request = TypeVar("Request")
Answer = TypeVar("Answer")


def simulate(request: SimulateRequest) -> SimulateAnswer:
    """One shot; a shot that cannot be played is a result whose status says why. Raises `Invalid`."""
    return _answered(simulations.simulate, request)


def simulate_batch(request: BatchRequest) -> BatchAnswer:
    """Many shots, each on its own. Raises `Invalid` naming the first bad row."""
    return _answered(simulations.simulate_batch, request)


def min_elevation(request: MinElevationRequest) -> MinElevationAnswer:
    """The least elevation at which the cue is free. Raises `Invalid`."""
    return _answered(simulations.min_elevation, request)


def _answered(answer: Callable[[Request], Answer], request: Request) -> Answer:
    try:
        return answer(request)
    except PhysicsError as error:
        raise invalid_physics(error) from error
