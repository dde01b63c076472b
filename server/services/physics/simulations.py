"""The physics alone, for clients in any language."""

import time
from collections.abc import Callable
from functools import partial
from typing import TypeVar

import physics
from physics import PhysicsError, Result, Shot, Table, TableState
from protocol import (
    BatchAnswer,
    BatchRequest,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
    simulations,
)
from server.errors import invalid_field, invalid_physics

Answer = TypeVar("Answer")


LONGEST_SECONDS = 20.0
"""A batch takes no longer, as is looked at every 64 shots: ordinary ones take a quarter of a second, and some tables
have shots of 10^5 events."""
LONGEST_TRACE = 20_000
"""Events of an answer, some 8 MB of JSON."""


def simulate(request: SimulateRequest) -> SimulateAnswer:
    """One shot; a shot that cannot be played is a result whose status says why. Raises `Invalid`."""
    return _answered(lambda: simulations.simulate(request, _of_bounded_trace))


def simulate_batch(request: BatchRequest, go_on: Callable[[], None] = lambda: None) -> BatchAnswer:
    """Many shots, each on its own. Raises `Invalid` naming the first bad row, and what `go_on`, asked often, raises."""
    ends = time.monotonic() + LONGEST_SECONDS

    def check() -> None:
        go_on()
        if time.monotonic() > ends:
            raise invalid_field("shots", len(request.shots), f"what takes {LONGEST_SECONDS:g} s: send fewer at a time")

    return _answered(lambda: simulations.simulate_batch(request, partial(physics.simulate_batch, check=check)))


def min_elevation(request: MinElevationRequest) -> MinElevationAnswer:
    """The least elevation at which the cue is free. Raises `Invalid`."""
    return _answered(lambda: simulations.min_elevation(request))


def _of_bounded_trace(table: Table, state: TableState, shot: Shot, trace: bool) -> Result:
    result = physics.simulate(table, state, shot, trace=trace)
    if trace and result.n_events > LONGEST_TRACE:
        allowed = f"false for a shot of {result.n_events} events: no answer has more than {LONGEST_TRACE}"
        raise invalid_field("trace", trace, allowed)
    return result


def _answered(answer: Callable[[], Answer]) -> Answer:
    try:
        return answer()
    except PhysicsError as error:
        raise invalid_physics(error) from error
