"""The best strokes of the games that ended last."""

from fastapi import APIRouter

from protocol import BestStrokes
from server.errors import Unauthorized
from server.http.dependencies import ANYBODY, ContextDep
from server.http.describe import describe
from server.services.watch import best_strokes

router = APIRouter(prefix="/v1/best-strokes", tags=["games"], dependencies=[ANYBODY])


@router.get("", **describe(Unauthorized, token=False), summary="The best strokes of the games that ended last")
def listing(context: ContextDep) -> BestStrokes:
    """Where a player's chance to win rose the most, at most one stroke of each of the newest 24 games."""
    return best_strokes.read(context)
