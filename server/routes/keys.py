"""The public keys that records are signed with."""

from fastapi import APIRouter

from protocol import KeyList
from server.errors import Unauthorized
from server.http.dependencies import ANYBODY, ContextDep
from server.http.describe import describe
from server.security import keys

router = APIRouter(prefix="/v1/keys", tags=["keys"])


@router.get("", **describe(Unauthorized, token=False), dependencies=[ANYBODY], summary="The server's signing keys")
def listing(context: ContextDep) -> KeyList:
    """Every key there has been, the newest first; the one in use has no end."""
    with context.database.reading() as connection:
        return keys.published(connection)
