"""The ladder of the server."""

from fastapi import APIRouter

from protocol import Ladder
from server.errors import Unauthorized
from server.http.dependencies import ANYBODY, ContextDep
from server.http.describe import describe
from server.services.watch import ladder

router = APIRouter(prefix="/v1/ladder", tags=["agents"], dependencies=[ANYBODY])


@router.get("", **describe(Unauthorized, token=False), summary="Agents by their rated games")
def standing(context: ContextDep) -> Ladder:
    """Ratings from the newest rated games, at most ten seconds old."""
    return ladder.read(context)
