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
from server.routes.dependencies import Authenticated, Body, ContentType
from server.routes.describe import describe
from server.services import physics
from server.services.commands import parse_body

router = APIRouter(prefix="/v1", tags=["physics"])


@router.post("/simulate", **describe(body=SimulateRequest), summary="Simulate one shot")
def simulate(_caller: Authenticated, body: Body, content_type: ContentType = None) -> SimulateAnswer:
    """A shot that cannot be played is an answer too; its status says why."""
    return physics.simulate(parse_body(body, content_type, SimulateRequest))


@router.post("/simulate/batch", **describe(body=BatchRequest), summary="Simulate many shots")
def simulate_batch(_caller: Authenticated, body: Body, content_type: ContentType = None) -> BatchAnswer:
    """From one position, or each from its own."""
    return physics.simulate_batch(parse_body(body, content_type, BatchRequest))


@router.post("/min-elevation", **describe(body=MinElevationRequest), summary="The least elevation of a free cue")
def min_elevation(_caller: Authenticated, body: Body, content_type: ContentType = None) -> MinElevationAnswer:
    """null when there is none up to the table's greatest."""
    return physics.min_elevation(parse_body(body, content_type, MinElevationRequest))
