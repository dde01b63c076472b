"""Server-sent events for spectators."""

from collections.abc import AsyncIterator
from typing import Annotated, Any, Final

from fastapi import APIRouter, Depends, Header, Query, Request, Response
from fastapi.sse import EventSourceResponse

from server.errors import BadHeader, Draining, Invalid, NotFound, Unauthorized, invalid_field
from server.http.connections import WRITE
from server.http.dependencies import A_PLACE_TO_WATCH, ContextDep
from server.http.describe import EVENT_STREAM, NO_NUL, NUMBER, describe
from server.services.watch.spectators import Spectators, Write, never
from server.store import paging

router = APIRouter(prefix="/v1", tags=["streams"])

MOST_GAMES: Final = 64
"""Games one stream may carry."""
AN_ID: Final = {"type": "string", "pattern": r"^[^\x00]*$"}
SOME_GAMES: Final[dict[str, Any]] = {"minItems": 1, "maxItems": MOST_GAMES, "items": {"type": "string"} | NO_NUL}


def _spectators(request: Request, context: ContextDep) -> Spectators:
    if context.wakeups.draining.is_set():
        raise Draining("the server is shutting down")
    spectators: Spectators = request.app.state.spectators
    return spectators


Watching = Annotated[Spectators, Depends(_spectators)]


@router.get(
    "/games/{game_id}/stream",
    **describe(NotFound, BadHeader, Invalid, Unauthorized, Draining, success={200: EVENT_STREAM}, token=False),
    dependencies=[A_PLACE_TO_WATCH],
    summary="Watch a game",
)
async def watch_game(
    game_id: str,
    request: Request,
    spectators: Watching,
    after: Annotated[
        str | None, Query(description="the id of the last event one has", json_schema_extra=NUMBER)
    ] = None,
    last_event_id: Annotated[
        str | None, Header(description="the same, as browsers send it", json_schema_extra=NUMBER)
    ] = None,
) -> Response:
    """How the game stands, its strokes so far (after the given one), then everything as it happens."""
    return _streamed(await spectators.watch_one(game_id, _sequence(last_event_id, after), at_once(request)))


@router.get(
    "/stream",
    **describe(NotFound, Invalid, Unauthorized, Draining, success={200: EVENT_STREAM}, token=False),
    dependencies=[A_PLACE_TO_WATCH],
    summary="Watch several games",
)
async def watch_games(
    request: Request,
    spectators: Watching,
    game: Annotated[list[str] | None, Query(description="ids of games, 1 to 64", json_schema_extra=SOME_GAMES)] = None,
) -> Response:
    """How each of them stands, then everything as it happens; every event says which game it is about."""
    games = list(dict.fromkeys(game or ()))
    if not 1 <= len(games) <= MOST_GAMES:
        raise invalid_field("game", f"{len(games)} games", f"1 to {MOST_GAMES} games")
    return _streamed(await spectators.watch_many(games, at_once(request)))


def _sequence(header: str | None, query: str | None) -> int:
    """The id of the last event the caller has; 0 for none. The header, the later news, goes before the address."""
    after = paging.number("after", query, "the id of an event")
    if header is None:
        return after
    if not (header.isascii() and header.isdigit() and len(header) <= paging.LONGEST_NUMBER):
        raise BadHeader("Last-Event-ID is no event's id", field="Last-Event-ID", value=header, allowed="digits")
    return int(header)


def at_once(request: Request) -> Write:
    """Return what writes to the request's sender past the framework: 100 spectators cost 100 writes and no more."""
    write: Write = request.scope.get("extensions", {}).get(WRITE, never)
    return write


def _streamed(events: AsyncIterator[bytes]) -> Response:
    """Not to be kept by anybody on the way, nor held back until a buffer is full."""
    return EventSourceResponse(events, headers={"Cache-Control": "no-store", "X-Accel-Buffering": "no"})
