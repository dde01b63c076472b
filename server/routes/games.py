"""Games: how they stand, the players' actions, the history and the record."""

from collections.abc import Callable
from functools import partial
from typing import Annotated, Any, Final

from fastapi import APIRouter, Query, Request, Response

from protocol import (
    ClockLedger,
    DecisionRequest,
    ForfeitRequest,
    GameAnswer,
    MinimalAnswer,
    ShotRequest,
    ShotsPage,
    StrokeAnswer,
)
from server.errors import (
    BudgetSpent,
    GameFinished,
    GameUnfinished,
    Invalid,
    MatchUnfinished,
    NotFound,
    NotYourTurn,
    OutOfTime,
    Refused,
    StaleVersion,
    TournamentUnfinished,
    Unauthorized,
    VersionRequired,
)
from server.http.dependencies import (
    ANYBODY,
    ContextDep,
    Cursor,
    InHand,
    Limit,
    MoveDep,
    Reader,
    Sent,
    context_of,
    flag,
    in_hand,
    move_of,
    respond,
)
from server.http.describe import OWNED, describe
from server.http.express import Direct
from server.services.play import forfeits, history, strokes
from server.services.play.clock import ledger
from server.services.watch import pictures

router = APIRouter(prefix="/v1/games/{game_id}", tags=["games"])

ACTION_PROBLEMS = (*OWNED, VersionRequired, GameFinished, StaleVersion, NotYourTurn, OutOfTime, BudgetSpent)
RECORD_TYPE = "application/x-ndjson"

SVG = "image/svg+xml"
PNG = "image/png"
STANDS_ALONE = {"Content-Security-Policy": "default-src 'none'"}
Theme = Annotated[str, Query(description="`dark` for screens, `light` for paper")]
Upright = Annotated[
    str,
    Query(
        description="true: the head string on top instead of on the left", json_schema_extra={"enum": ["true", "false"]}
    ),
]


@router.get("", **describe(NotFound, Unauthorized, success={200: GameAnswer}, token=False), summary="How a game stands")
def game(game_id: str, context: ContextDep, reader: Reader) -> Response:
    """As a spectator sees it, or as the caller does who plays in it. `ETag` is the version."""
    return respond(history.game(context, game_id, reader))


@router.post(
    "/shots",
    **describe(
        *ACTION_PROBLEMS,
        Refused,
        body=ShotRequest,
        success={200: StrokeAnswer | MinimalAnswer},
        key=True,
        version=True,
        minimal=True,
    ),
    summary="Play a stroke",
)
async def shoot(game_id: str, request: Request) -> Response:
    """The shot as played (with noise), its events, the ruling and the next view.

    With `Prefer: return=minimal` the view alone. A request that is sent again gets the answer that it got,
    whatever it prefers then.
    """
    context = context_of(request)
    move = move_of(request)
    ordinary = partial(request.app.state.batches.carry_out, partial(strokes.attempt_of, context, game_id, move))
    long = partial(strokes.shoot, context, game_id, move)
    with in_hand(game_id, request):
        return respond(await context.long_strokes.play(game_id, ordinary, long))


async def _shoot(request: Request) -> Response:
    return await shoot(request.path_params["game_id"], request)


DIRECT: Final[dict[Callable[..., Any], Direct]] = {shoot: _shoot}
"""For `server.http.express`."""


@router.post(
    "/decisions",
    **describe(
        *ACTION_PROBLEMS,
        Refused,
        body=DecisionRequest,
        success={200: StrokeAnswer | MinimalAnswer},
        key=True,
        version=True,
        minimal=True,
    ),
    dependencies=[InHand],
    summary="Choose after a break",
)
def decide(game_id: str, context: ContextDep, move: MoveDep) -> Response:
    """One of the choices that the view allows."""
    return respond(strokes.decide(context, game_id, move))


@router.post(
    "/concede",
    **describe(*ACTION_PROBLEMS, success={200: StrokeAnswer | MinimalAnswer}, key=True, version=True, minimal=True),
    dependencies=[InHand],
    summary="Give the game up",
)
def concede(game_id: str, context: ContextDep, move: MoveDep) -> Response:
    """In turn. The request has no body."""
    return respond(strokes.concede(context, game_id, move))


@router.post(
    "/forfeit",
    **describe(*OWNED, GameFinished, body=ForfeitRequest, success={200: GameAnswer}, key=True),
    summary="End a game against a player",
)
def forfeit(game_id: str, context: ContextDep, command: Sent) -> Response:
    """For the organiser, who saw a player crash, stall, stay away or break the terms."""
    return respond(forfeits.forfeit(context, game_id, command))


@router.get(
    "/clock",
    **describe(NotFound, Unauthorized, token=False),
    dependencies=[ANYBODY],
    summary="The ledger of a game's clocks",
)
def clock(game_id: str, context: ContextDep) -> ClockLedger:
    """What every turn took, what of it was given back, and what was charged."""
    return ledger.read(context, game_id)


@router.get(
    "/shots",
    **describe(NotFound, Invalid, Unauthorized, token=False),
    dependencies=[ANYBODY],
    summary="The strokes of a game, in pages",
)
def shots(game_id: str, context: ContextDep, cursor: Cursor, limit: Limit) -> ShotsPage:
    """Strokes and decisions in order, with their events."""
    return history.shots(context, game_id, cursor, limit)


@router.get(
    "/position.svg",
    **describe(NotFound, Invalid, Unauthorized, success={200: SVG}, token=False),
    dependencies=[ANYBODY],
    summary="A picture of how the balls lie",
)
def position_picture(game_id: str, context: ContextDep, theme: Theme = "dark", upright: Upright = "false") -> Response:
    """To scale. `ETag` is the game's version."""
    drawn, version = pictures.position(context, game_id, theme, flag("upright", upright) is True)
    return Response(drawn, media_type=SVG, headers=STANDS_ALONE | {"ETag": f'"{version}"', "Cache-Control": "no-cache"})


@router.get(
    "/position.png",
    **describe(NotFound, Unauthorized, success={200: PNG}, token=False),
    dependencies=[ANYBODY],
    summary="The same as PNG, 800 pixels wide",
)
def position_preview(game_id: str, context: ContextDep) -> Response:
    """For link previews. 404 where the server is without the extra `pictures`."""
    drawn, version = pictures.position_as_png(context, game_id)
    return Response(drawn, media_type=PNG, headers=STANDS_ALONE | {"ETag": f'"{version}"', "Cache-Control": "no-cache"})


@router.get(
    "/shots/{number}.svg",
    **describe(NotFound, Invalid, Unauthorized, success={200: SVG}, token=False),
    dependencies=[ANYBODY],
    summary="A picture of what a stroke did",
)
def stroke_picture(
    game_id: str, number: str, context: ContextDep, theme: Theme = "dark", upright: Upright = "false"
) -> Response:
    """Paths, ghost ball, cue and call, to scale. `number` counts the strokes and decisions of the history from 0."""
    drawn = pictures.stroke(context, game_id, number, theme, flag("upright", upright) is True)
    return Response(drawn, media_type=SVG, headers=STANDS_ALONE | {"Cache-Control": "public, max-age=86400"})


@router.get(
    "/record",
    **describe(
        *(NotFound, GameUnfinished, MatchUnfinished, TournamentUnfinished, Unauthorized),
        success={200: RECORD_TYPE},
        token=False,
    ),
    dependencies=[ANYBODY],
    summary="The record of a finished game",
)
def record(game_id: str, context: ContextDep) -> Response:
    """JSON lines with everything that happened and the revealed seed, for `pooliad replay verify`.

    With noise that the players are not told: when the match is over, and the tournament that it belongs to.
    """
    return Response(history.record(context, game_id), media_type=RECORD_TYPE)
