"""The physics alone. Nothing is stored, so no Idempotency-Key is needed; a token is.

Requests are read, simulated and answered by threads of their own: however many there are, the games go on beside them.
"""

from collections.abc import Callable

from fastapi import APIRouter, Response
from pydantic import BaseModel

from referee.wire import (
    BatchAnswer,
    BatchRequest,
    MinElevationAnswer,
    MinElevationRequest,
    SimulateAnswer,
    SimulateRequest,
)
from server.errors import BudgetSpent, Forbidden, GameFinished
from server.routes.dependencies import Body, ContentType, Server, Simulating
from server.routes.describe import OWNED, describe
from server.security.callers import Caller
from server.services import physics, simulations
from server.services.commands import parse_body
from server.services.context import Context

GAME_PROBLEMS = (*OWNED, GameFinished, BudgetSpent)
"""What naming a game may be answered with."""

router = APIRouter(prefix="/v1", tags=["physics"])


@router.post(
    "/simulate",
    **describe(*GAME_PROBLEMS, body=SimulateRequest, success={200: SimulateAnswer}),
    summary="Simulate one shot",
)
async def simulate(context: Server, caller: Simulating, body: Body, content_type: ContentType = None) -> Response:
    """A shot that cannot be played is an answer too; its status says why."""

    def work() -> SimulateAnswer:
        request = parse_body(body, content_type, SimulateRequest)
        simulations.count(context, caller, request.game, 1)
        context.metrics.simulated.inc()
        return physics.simulate(request)

    return await _answered(context, work)


@router.post(
    "/simulate/batch",
    **describe(*GAME_PROBLEMS, body=BatchRequest, success={200: BatchAnswer}),
    summary="Simulate many shots",
)
async def simulate_batch(context: Server, caller: Simulating, body: Body, content_type: ContentType = None) -> Response:
    """From one position, or each from its own."""
    return await _answered(context, lambda: _batch(context, caller, body, content_type))


def _batch(context: Context, caller: Caller, body: bytes, content_type: str | None) -> BatchAnswer:
    request = parse_body(body, content_type, BatchRequest)
    context.limits.count_shots(caller, len(request.shots))
    simulations.count(context, caller, request.game, len(request.shots))
    context.metrics.simulated.inc(len(request.shots))
    return physics.simulate_batch(request)


@router.post(
    "/min-elevation",
    **describe(Forbidden, body=MinElevationRequest, success={200: MinElevationAnswer}),
    summary="The least elevation of a free cue",
)
async def min_elevation(context: Server, _caller: Simulating, body: Body, content_type: ContentType = None) -> Response:
    """null when there is none up to the table's greatest."""
    return await _answered(context, lambda: physics.min_elevation(parse_body(body, content_type, MinElevationRequest)))


async def _answered(context: Context, work: Callable[[], BaseModel]) -> Response:
    """The message that `work` makes, as JSON, both by a thread of the physics."""
    content = await context.physics.run(lambda: work().model_dump_json().encode())
    return Response(content, media_type="application/json")
