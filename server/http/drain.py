"""Who is still being answered when the time for stopping is over is told so, and not left with a fault."""

import asyncio

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from server.errors import Draining, render


class DrainAnswers:
    """ASGI middleware: a request that is cancelled because the server stops is answered 503.

    It may have been carried out: the same request, sent to the next server with the same key, is told.
    """

    def __init__(self, app: ASGIApp, *, draining: asyncio.Event) -> None:
        self._app = app
        self._draining = draining

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let the request through."""
        if scope["type"] != "http":
            return await self._app(scope, receive, send)
        begun = False

        async def noted(message: Message) -> None:
            nonlocal begun
            begun = True
            await send(message)

        try:
            return await self._app(scope, receive, noted)
        except asyncio.CancelledError:
            if begun or not self._draining.is_set():
                raise
            error = Draining("the server is shutting down; send the same request again, with the same Idempotency-Key")
            return await render(error, scope["path"])(scope, receive, send)
