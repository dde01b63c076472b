"""The long poll."""

from collections.abc import Callable
from functools import partial
from typing import Annotated, Any, Final

from fastapi import APIRouter, Query, Request, Response

from protocol import TurnMessage
from server.errors import Forbidden, Invalid, invalid_field
from server.http.dependencies import context_of, is_gone, sender_of
from server.http.describe import describe
from server.http.express import Direct
from server.services.play.turns import poll

WAIT: Final[dict[str, Any]] = {"type": "number", "minimum": 0, "maximum": 60, "default": 0, "examples": [30]}

router = APIRouter(prefix="/v1/turns", tags=["turns"])


@router.get(
    "",
    **describe(Forbidden, Invalid, success={200: TurnMessage, 204: ""}),
    summary="The caller's next message",
)
async def next_message(
    request: Request,
    wait: Annotated[
        str, Query(description="seconds to wait for a message, 0 to 60", examples=["30"], json_schema_extra=WAIT)
    ] = "0",
) -> Response:
    """`turn` (until it is played), `game_over` or `match_over` (once each); 204 when there is none."""
    context = context_of(request)
    seconds = partial(_seconds, wait, context.settings.longest_wait)
    message = await poll(context, request.app.state.batches, sender_of(request), seconds, partial(is_gone, request))
    return Response(status_code=204) if message is None else Response(message, media_type="application/json")


async def _next_message(request: Request) -> Response:
    return await next_message(request, request.query_params.get("wait", "0"))


DIRECT: Final[dict[Callable[..., Any], Direct]] = {next_message: _next_message}
"""For `server.http.express`."""


def _seconds(text: str, longest: float) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0.0 <= seconds <= longest:
        raise invalid_field("wait", text, f"seconds, 0 to {longest:g}")
    return seconds
