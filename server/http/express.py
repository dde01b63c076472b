"""What every turn takes, a poll and a stroke, carried past the framework's router.

The framework finds a route by asking one after the other, and makes a tree of dependencies and clean-up for each
request: that takes it longer than the server takes to check, play and rule upon a stroke. An endpoint here is the
framework's own, called with the same arguments; the framework goes on to describe it, and to carry everything else.
"""

from collections.abc import Awaitable, Callable, Iterable, Mapping
from typing import Any, Final

from fastapi.routing import APIRoute
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import BaseRoute
from starlette.types import ASGIApp, Receive, Scope, Send

from server.errors import ServerError, render

Direct = Callable[[Request], Awaitable[Response]]
"""An endpoint that takes its arguments from the request by itself."""


class Express:
    """ASGI middleware, the last before the framework's router.

    Args:
        app: what carries all other requests.
        routes: all routes of the server.
        direct: by the endpoint of a route, what is called in its place.
    """

    def __init__(
        self, app: ASGIApp, *, routes: Iterable[BaseRoute], direct: Mapping[Callable[..., Any], Direct]
    ) -> None:
        self._app = app
        self._routes: Final = tuple(
            (method, route, direct[route.endpoint])
            for route in routes
            if isinstance(route, APIRoute) and route.endpoint in direct
            for method in route.methods or ()
        )

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer the request, or let it through."""
        if scope["type"] == "http":
            for method, route, endpoint in self._routes:
                if scope["method"] == method and (found := route.path_regex.fullmatch(scope["path"])):
                    scope["route"], scope["path_params"] = route, found.groupdict()
                    return await _answered(endpoint, scope, receive, send)
        return await self._app(scope, receive, send)


async def _answered(endpoint: Direct, scope: Scope, receive: Receive, send: Send) -> None:
    request = Request(scope, receive, send)
    try:
        response = await endpoint(request)
    except ServerError as error:
        response = render(error, request.url.path)
    await response(scope, receive, send)
