"""What endpoints are given: the context, the caller, the command, the page."""

from collections.abc import AsyncIterator
from contextlib import AbstractContextManager
from typing import Annotated

from fastapi import Depends, Header, Query, Request, Response
from sqlalchemy import Connection

from server.errors import Unauthorized, invalid_field
from server.http.commands import Answer, Command
from server.http.connections import GONE
from server.http.describe import NUMBER, PAGE_LIMIT, PLACE, SEARCH
from server.http.preferences import wants_minimal
from server.security.addresses import origin
from server.security.callers import Caller, identify
from server.security.tokens import bearer
from server.services.play.strokes import Move
from server.services.play.turns import Sender
from server.services.runtime.context import Context
from server.store import paging


def context_of(request: Request) -> Context:
    """The server's parts."""
    context: Context = request.app.state.context
    return context


async def _server(request: Request) -> Context:
    """What takes no time is done on the loop: to hand it to a thread would take longer."""
    return context_of(request)


ContextDep = Annotated[Context, Depends(_server)]


def _caller(request: Request) -> Caller:
    context = context_of(request)
    with context.database.reading() as connection:
        caller = _identified(connection, request)
    context.limits.count(caller)
    return caller


def _identified(connection: Connection, request: Request) -> Caller:
    """The caller; whoever comes without a valid token is counted by address."""
    context = context_of(request)
    try:
        return identify(connection, _token(request), context.settings.organiser_digest, context.time.now())
    except Unauthorized:
        context.limits.count_stranger(_address(request))
        raise


def _token(request: Request) -> str | None:
    return bearer(request.headers.get("authorization"))


def _address(request: Request) -> str:
    return origin(request.client.host if request.client else None)


def _simulating(request: Request) -> Caller:
    if not context_of(request).settings.public_physics:
        caller = _caller(request)
        caller.require_player()
        return caller
    return _visitor(request) or Caller.stranger(_address(request))


def _simulating_many(caller: Annotated[Caller, Depends(_caller)]) -> Caller:
    caller.require_player()
    return caller


def _visitor(request: Request) -> Caller | None:
    if _token(request) is not None:
        return _caller(request)
    context_of(request).limits.count_stranger(_address(request))
    return None


def _reader(request: Request) -> Caller | None:
    return _visitor(request) if context_of(request).settings.public_reads else _caller(request)


Authenticated = Annotated[Caller, Depends(_caller)]
"""Somebody with a valid token; 401 for anybody else."""
Simulating = Annotated[Caller, Depends(_simulating)]
"""The caller of single shots: anybody, or players and organisers only, as `public_physics` says."""
SimulatingMany = Annotated[Caller, Depends(_simulating_many)]
"""Somebody who plays or organises: may send batches."""
Visitor = Annotated[Caller | None, Depends(_visitor)]
"""Somebody who needs no token; one that is sent must be valid all the same."""
Address = Annotated[str, Depends(_address)]
"""Where the request comes from, as `origin` has it."""
Reader = Annotated[Caller | None, Depends(_reader)]
"""Whoever reads something public: anybody, unless the settings ask for a token, whatever its scope."""
ANYBODY = Depends(_reader)
"""The same for an endpoint that shows everybody the same."""


async def _watching(context: ContextDep, caller: Reader, request: Request) -> AsyncIterator[None]:
    """The framework ends this when the whole response is sent, or the reader is gone before its first byte."""
    with context.limits.watching(caller, _address(request)):
        yield


A_PLACE_TO_WATCH = Depends(_watching)
"""For an endpoint that answers with a stream: counts it among the reader's for as long as it lasts."""


async def _body(request: Request) -> bytes:
    body: bytes = request.state.body
    return body


Body = Annotated[bytes, Depends(_body)]
ContentType = Annotated[str | None, Header(include_in_schema=False)]


def _sent(request: Request, caller: Caller) -> Command:
    """Headers are read here: each one that the framework is told of takes it longer than the look-up."""
    headers, state = request.headers, request.state
    return Command(
        caller=caller,
        route=request.url.path,
        key=headers.get("idempotency-key"),
        if_match=headers.get("if-match"),
        content_type=headers.get("content-type"),
        body=state.body,
        arrived=state.arrived,
        minimal=wants_minimal(headers.getlist("prefer")),
    )


async def _command(caller: Authenticated, request: Request) -> Command:
    return _sent(request, caller)


Sent = Annotated[Command, Depends(_command)]
"""A state-changing request."""


async def _simulation(caller: Simulating, request: Request) -> Command:
    return _sent(request, caller)


Simulation = Annotated[Command, Depends(_simulation)]
"""A request for one simulated shot."""


def sender_of(request: Request) -> Sender:
    """The sender of a poll, looked up by the transaction that looks for them."""
    return lambda connection: _identified(connection, request)


async def is_gone(request: Request) -> bool:
    """Whether the sender has hung up."""
    asked = request.scope.get("extensions", {}).get(GONE)
    return await request.is_disconnected() if asked is None else bool(asked())


def move_of(request: Request) -> Move:
    """A player's move; its sender is looked up by the transaction that looks at the game."""
    return lambda connection: _sent(request, _identified(connection, request))


async def _move(request: Request) -> Move:
    return move_of(request)


MoveDep = Annotated[Move, Depends(_move)]
"""See `move_of`."""


def in_hand(game_id: str, request: Request) -> AbstractContextManager[None]:
    """Tell the timer that a complete request of this game is being worked on, for as long as the block lasts.

    Entered on the loop, before any queueing; left when there is an answer, whether or not it is being read.
    """
    return context_of(request).in_hand.working_on(game_id, request.state.arrived)


async def _in_hand(game_id: str, request: Request) -> AsyncIterator[None]:
    with in_hand(game_id, request):
        yield


InHand = Depends(_in_hand, scope="function")


async def _cursor(
    cursor: Annotated[
        str | None, Query(description="`next_cursor` of the page before", json_schema_extra=NUMBER)
    ] = None,
) -> int:
    return paging.cursor(cursor)


async def _place(
    cursor: Annotated[
        str | None, Query(description="`next_cursor` of the page before", json_schema_extra=PLACE)
    ] = None,
) -> paging.PagePosition | None:
    return paging.place(cursor)


async def _limit(
    limit: Annotated[
        str | None, Query(description="rows a page, 1 to 200; 50 unless told", json_schema_extra=PAGE_LIMIT)
    ] = None,
) -> int:
    return paging.limit(limit)


async def _search(
    search: Annotated[
        str | None, Query(description="only rows whose names contain this, or whose id it is", json_schema_extra=SEARCH)
    ] = None,
) -> str | None:
    return paging.search(search)


Cursor = Annotated[int, Depends(_cursor)]
"""Of a list whose rows are numbered."""
PageDep = Annotated[paging.PagePosition | None, Depends(_place)]
"""Of a list whose rows are in the order they were made."""
Limit = Annotated[int, Depends(_limit)]
Search = Annotated[str | None, Depends(_search)]


def flag(field: str, text: str | None) -> bool | None:
    """A parameter that is true, false or not given; raises `Invalid`, which the framework's own refusal is not."""
    if text not in (None, "true", "false"):
        raise invalid_field(field, text, "true or false")
    return None if text is None else text == "true"


def respond(answer: Answer) -> Response:
    """An answer as an HTTP response, its bytes as they are."""
    return Response(answer.body, answer.status, headers=dict(answer.headers), media_type="application/json")
