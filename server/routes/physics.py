"""The physics alone. Nothing is stored, so no Idempotency-Key is needed; a token is."""

from fastapi import APIRouter

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
from server.services import physics, simulations
from server.services.commands import parse_body

GAME_PROBLEMS = (*OWNED, GameFinished, BudgetSpent)
"""What naming a game may be answered with."""

router = APIRouter(prefix="/v1", tags=["physics"])


@router.post("/simulate", **describe(*GAME_PROBLEMS, body=SimulateRequest), summary="Simulate one shot")
def simulate(context: Server, caller: Simulating, body: Body, content_type: ContentType = None) -> SimulateAnswer:
    """A shot that cannot be played is an answer too; its status says why."""
    request = parse_body(body, content_type, SimulateRequest)
    simulations.count(context, caller, request.game, 1)
    return physics.simulate(request)


@router.post("/simulate/batch", **describe(*GAME_PROBLEMS, body=BatchRequest), summary="Simulate many shots")
def simulate_batch(context: Server, caller: Simulating, body: Body, content_type: ContentType = None) -> BatchAnswer:
    """From one position, or each from its own."""
    request = parse_body(body, content_type, BatchRequest)
    simulations.count(context, caller, request.game, len(request.shots))
    return physics.simulate_batch(request)


@router.post(
    "/min-elevation", **describe(Forbidden, body=MinElevationRequest), summary="The least elevation of a free cue"
)
def min_elevation(_caller: Simulating, body: Body, content_type: ContentType = None) -> MinElevationAnswer:
    """null when there is none up to the table's greatest."""
    return physics.min_elevation(parse_body(body, content_type, MinElevationRequest))
