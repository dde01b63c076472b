"""The physics alone. Nothing is stored, but what counts against a game's budget: for that an Idempotency-Key is needed.

Requests are read, simulated and answered by threads of their own: however many there are, the games go on beside them.
"""

from collections.abc import Callable

from fastapi import APIRouter, Response
from pydantic import BaseModel

from protocol import (
    BatchAnswer,
    BatchRequest,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
)
from server.errors import BudgetSpent, Forbidden, GameFinished, Unauthorized
from server.http.commands import Command, parse, parse_body
from server.http.dependencies import Body, ContentType, ContextDep, Sent, Simulating, SimulatingMany, Simulation
from server.http.describe import OWNED, describe
from server.services.physics import simulations
from server.services.play import budget
from server.services.runtime.context import Context

GAME_PROBLEMS = (*OWNED, GameFinished, BudgetSpent)
"""What naming a game may be answered with."""

router = APIRouter(prefix="/v1", tags=["physics"])


@router.post(
    "/simulate",
    **describe(
        *(*GAME_PROBLEMS, Unauthorized),
        body=SimulateRequest,
        success={200: SimulateAnswer},
        optional_key=True,
        token=False,
    ),
    summary="Simulate one shot",
)
async def simulate(context: ContextDep, command: Simulation) -> Response:
    """A shot that cannot be played is an answer too; its status says why. With `game` an Idempotency-Key is needed."""

    def work() -> SimulateAnswer:
        request = parse(command, SimulateRequest)
        context.kernels.require(request.table_model)
        budget.count(context, command, request.game, 1)
        context.metrics.simulated.inc()
        return simulations.simulate(request)

    return await _answered(context, work)


@router.post(
    "/simulate/batch",
    **describe(*GAME_PROBLEMS, body=BatchRequest, success={200: BatchAnswer}, optional_key=True),
    summary="Simulate many shots",
)
async def simulate_batch(context: ContextDep, _caller: SimulatingMany, command: Sent) -> Response:
    """From one position, or each from its own. With `game` an Idempotency-Key is needed."""
    return await _answered(context, lambda: _batch(context, command))


def _batch(context: Context, command: Command) -> BatchAnswer:
    request = parse(command, BatchRequest)
    context.kernels.require(request.table_model)
    context.limits.count_shots(command.caller, len(request.shots))
    budget.count(context, command, request.game, len(request.shots))
    context.metrics.simulated.inc(len(request.shots))
    return simulations.simulate_batch(request, context.physics.require_open)


@router.post(
    "/min-elevation",
    **describe(Forbidden, Unauthorized, body=MinElevationRequest, success={200: MinElevationAnswer}, token=False),
    summary="The least elevation of a free cue",
)
async def min_elevation(
    context: ContextDep, _caller: Simulating, body: Body, content_type: ContentType = None
) -> Response:
    """null when there is none up to the table's greatest."""

    def work() -> MinElevationAnswer:
        request = parse_body(body, content_type, MinElevationRequest)
        context.kernels.require(request.table_model)
        return simulations.min_elevation(request)

    return await _answered(context, work)


async def _answered(context: Context, work: Callable[[], BaseModel]) -> Response:
    """The message that `work` makes, as JSON, both by a thread of the physics."""
    content = await context.physics.run(lambda: context.kernels.awaited(work).model_dump_json().encode())
    return Response(content, media_type="application/json")
