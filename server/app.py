"""The composition root: the only place where the server's parts are put together."""

import logging
from collections.abc import AsyncIterator, Callable
from contextlib import AbstractAsyncContextManager, AsyncExitStack, asynccontextmanager
from functools import partial
from importlib.metadata import version

from fastapi import FastAPI
from starlette.exceptions import HTTPException

from server import failpoints, openapi
from server.errors import ServerError, handle_fault, handle_framework_error, handle_server_error
from server.http.body_gate import BodyGate
from server.http.drain import DrainAnswers
from server.http.express import Express
from server.ops.telemetry import Telemetry
from server.routes import DIRECT, ROUTERS
from server.security import keys
from server.services.accounts.house_processes import House
from server.services.matches.matches import abort_foreign
from server.services.play.clock.flag import timer
from server.services.runtime.batches import Batches
from server.services.runtime.context import Context
from server.services.runtime.heartbeat import Heartbeat
from server.services.runtime.relay import Relay
from server.services.runtime.retention import retention
from server.services.runtime.time import DatabaseTime, TimeSource
from server.services.tournaments import progress
from server.services.watch.spectators import Spectators
from server.settings import Settings
from server.store.database import Database
from server.store.upgrade import upgrade

log = logging.getLogger("pooliad.server")

DESCRIPTION = """Matches between pool-playing programs under a referee. Units: metres, seconds, degrees;
millimetres
for the tip offset. Every state-changing request but registration carries an `Idempotency-Key`; sent again it
gets the stored answer. Errors are RFC 9457 problem details with a stable `code`."""


def create_app(settings: Settings) -> FastAPI:
    """The server as an ASGI application; `prepare` its database before it starts.

    Once it listens, `app.state.heartbeat.listening()` lets games go on, and `app.state.house.listening(url)` the bots.
    """
    database = Database(settings.database, settings.database_seconds, group_commit=settings.group_commit)
    context = Context(
        settings,
        database,
        DatabaseTime(database.clock) if database.is_shared else TimeSource(),
        failpoint=failpoints.parse(settings.failpoint),
        match_over=progress.match_over,
    )
    app = FastAPI(
        title="Pooliad",
        version=version("pooliad"),
        description=DESCRIPTION,
        lifespan=_lifespan(context),
        docs_url=None,
        redoc_url=None,
        redirect_slashes=False,
        exception_handlers={
            ServerError: handle_server_error,
            HTTPException: handle_framework_error,
            Exception: handle_fault,
        },
    )
    app.state.context = context
    app.state.spectators = Spectators(context)
    app.state.house = House(context)
    app.state.heartbeat = Heartbeat(context)
    app.state.batches = Batches(context)
    app.openapi = partial(openapi.document, app)  # type: ignore[method-assign]
    endpoints = tuple(route for router in ROUTERS for route in router.routes)
    app.state.endpoints = (*app.routes, *endpoints)
    app.add_middleware(Express, routes=endpoints, direct=DIRECT)
    app.add_middleware(BodyGate, settings=settings, time=context.time)
    app.add_middleware(DrainAnswers, draining=context.wakeups.draining)
    app.add_middleware(Telemetry, metrics=context.metrics)
    for router in ROUTERS:
        app.include_router(router)
    return app


def prepare(context: Context) -> None:
    """Take the database, bring it to this version's tables, and call off what another engine would play.

    Raises `SettingsError` when the database is not to be had, `Unavailable` when it does not answer.
    """
    context.database.membership.enter()
    context.time.adjust()
    upgrade(context.database)
    if warning := context.database.exposure():
        log.warning(warning)
    with context.writing() as writing:
        keys.ensure(writing.connection, writing.now)
    abort_foreign(context)


def _lifespan(context: Context) -> Callable[[FastAPI], AbstractAsyncContextManager[None]]:
    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        context.wakeups.start()
        context.kernels.straight.start()
        parts = (
            *(Relay(context), app.state.heartbeat, timer(context), retention(context)),
            *(app.state.spectators, app.state.batches, app.state.house),
        )
        async with AsyncExitStack() as stack:
            for part in parts:
                await stack.enter_async_context(part.running())
            yield
        context.wakeups.drain()
        context.physics.close()
        context.database.dispose()

    return lifespan
