"""For whoever runs the server: is the process alive, can it do its work."""

from functools import partial

from fastapi import APIRouter, Response
from prometheus_client import CONTENT_TYPE_PLAIN_0_0_4

from referee.record import this_engine
from server.errors import Draining, Unavailable
from server.http.dependencies import ContextDep
from server.http.describe import describe
from server.services.runtime.context import Context
from server.store.upgrade import head, is_current

router = APIRouter(tags=["operations"])


@router.head("/healthz", include_in_schema=False)
@router.get("/healthz", **describe(token=False, limited=False), summary="The process runs")
async def healthz() -> dict[str, str]:
    """Answers as long as the process serves requests at all, whatever its threads are busy with."""
    return {"status": "ok"}


@router.head("/readyz", include_in_schema=False)
@router.get("/readyz", **describe(Draining, token=False, limited=False), summary="The server can take games")
async def readyz(context: ContextDep) -> dict[str, str]:
    """The kernels are loaded and pass their self-test, the database is written to and has this version's tables.

    And nobody shuts the server down.
    """
    return await context.run_aside(partial(readiness, context))


def readiness(context: Context) -> dict[str, str]:
    """What the server is ready with; raises `Draining` or `Unavailable`."""
    if context.wakeups.draining.is_set():
        raise Draining("the server is shutting down")
    kernels = context.kernels.straight
    if kernels.failed.is_set():
        raise Draining("the physics kernels could not be loaded; the log says why")
    if kernels.tested is None or not kernels.ready.is_set():
        raise Draining("the physics kernels are being loaded")
    if context.pulse.is_lost(context.time.now()):
        raise Unavailable("the database does not take this process's heartbeats")
    if context.database.writes_fail.is_set():
        raise Unavailable("the database does not take what is written")
    if not context.database.has_room():
        raise Unavailable("the database's disk is full")
    if not is_current(context.database):
        raise Draining("the database has the tables of another version")
    return {
        "status": "ready",
        "engine": this_engine().digest,
        "self_test": kernels.tested.digest,
        "database": "postgresql" if context.database.is_shared else "sqlite",
        "schema": str(head()),
    }


@router.get(
    "/metrics",
    **describe(success={200: "text/plain"}, token=False, limited=False),
    summary="What the server counts and measures, for Prometheus",
)
async def metrics(context: ContextDep) -> Response:
    """In Prometheus' text format."""
    text = await context.run_aside(partial(context.metrics.text, context.database))
    return Response(text, media_type=CONTENT_TYPE_PLAIN_0_0_4)
