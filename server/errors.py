"""Why a request is not carried out: one class for each `ProblemCode`, which knows the HTTP status; one handler for all.

::

    SettingsError               the server cannot start
    ServerError                 a class for each code, and
    ├── BadHeader
    │   └── TwoLengths          ends the connection
    ├── TooLarge
    │   └── HeadTooLarge        431
    ├── Invalid
    │   └── Refused             by the referee
    └── TooManyRequests         says whose limit it is and how long to wait
        └── TooManyOpen         streams or long polls
"""

import logging
import re
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

from pydantic import ValidationError
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Match

from physics import PhysicsError
from protocol import PROBLEM_JSON, Fault, Problem, ProblemCode, shown
from tournament.errors import TournamentError

log = logging.getLogger("pooliad.server")


MOST_FAULTS = 20
"""Faults that one problem lists: a body of a hundred thousand wrong fields gets no answer eight times its size."""


class SettingsError(ValueError):
    """A setting the server cannot run with; the message names it, its value and what is allowed."""


class ServerError(Exception):
    """A request that is not carried out.

    A class named like a `ProblemCode` has that code, others that of their base. `extensions` are further members of the
    problem (field, value, view, …).
    """

    code: ClassVar[ProblemCode]
    status: ClassVar[int]
    headers: ClassVar[Mapping[str, str]] = {}
    seconds: int | None = None
    """How long to wait before the next try, where that is known."""

    def __init_subclass__(cls) -> None:
        cls.code = ProblemCode.of_class(cls.__name__) or cls.code
        cls.status = vars(cls).get("status", cls.code.status)

    def __init__(self, detail: str, **extensions: Any) -> None:
        super().__init__(detail)
        self.detail = detail
        self.extensions = extensions

    def problem(self, instance: str) -> Problem:
        """The problem as it goes on the wire, about the address `instance`."""
        return Problem.of(self.code, self.detail, self.status, instance=instance, **self.extensions)


class NotJson(ServerError):
    """The body cannot be read as JSON."""


class BadHeader(ServerError):
    """A header is malformed, or one that is needed is missing."""


class TwoLengths(BadHeader):
    """The message says in two ways where it ends: whatever comes after it on the connection may be a part of it."""

    headers: ClassVar[Mapping[str, str]] = {"connection": "close"}


class Unauthorized(ServerError):
    """No token, or none that is valid."""

    headers: ClassVar[Mapping[str, str]] = {"www-authenticate": 'Bearer realm="pooliad"'}


class Forbidden(ServerError):
    """A valid token, but not for this."""


class NotFound(ServerError):
    """There is no such thing."""


class MethodNotAllowed(ServerError):
    """The address exists, but not for this method."""


class SlowBody(ServerError):
    """The body did not arrive in time; the rest of it is not waited for."""

    headers: ClassVar[Mapping[str, str]] = {"connection": "close"}


class GameFinished(ServerError):
    """The game is over."""


class GameUnfinished(ServerError):
    """The game is still on."""


class MatchUnfinished(ServerError):
    """The match has untold noise and is still on."""


class TournamentUnfinished(ServerError):
    """The tournament has untold noise and is still on."""


class NotYourTurn(ServerError):
    """It is the other player's turn."""


class OutOfTime(ServerError):
    """The mover's clock had run out when the request was complete."""


class BudgetSpent(ServerError):
    """More shots were simulated, or are to be, than the player's budget has left."""


class WrongStatus(ServerError):
    """The match is not in a state that allows this."""


class NameTaken(ServerError):
    """Another agent has this name."""


class StaleVersion(ServerError):
    """The request answers an older view than the current one."""


class TooLarge(ServerError):
    """The body is larger than the server takes."""


class HeadTooLarge(TooLarge):
    """The request line and the header fields together are larger than the server takes."""

    status = 431


class UnsupportedMediaType(ServerError):
    """The body does not say that it is JSON."""


class Invalid(ServerError):
    """Fields that are missing, unknown, of the wrong type or out of range.

    Lists every fault, the first on top.
    """

    def __init__(self, faults: Sequence[Fault]) -> None:
        first = faults[0]
        super().__init__(
            first.detail, errors=tuple(faults), field=first.field, value=first.value, allowed=first.allowed
        )


class Refused(Invalid):
    """The referee does not allow this stroke or decision; nothing happened and the clock runs on."""


class KeyReused(ServerError):
    """The Idempotency-Key came before, with another body."""


class VersionRequired(ServerError):
    """The request does not say which version of the game it answers."""


class TooManyRequests(ServerError):
    """Somebody asked more often than allowed.

    Args:
        key: whose limit it is. seconds: how long to wait. allowed: what is allowed.
    """

    def __init__(self, key: str, seconds: int, allowed: str) -> None:
        super().__init__(
            f"too many requests for the {key}; wait {seconds} s", field="Retry-After", value=seconds, allowed=allowed
        )
        self.key, self.seconds = key, seconds


class TooManyOpen(TooManyRequests):
    """Somebody holds more streams or long polls open than allowed.

    Args:
        key: whose limit it is. what: `streams` or `polls`. taken: how many are open. most: how many may be.
    """

    AGAIN = 10
    """Seconds after which another one may have ended."""

    def __init__(self, key: str, what: str, taken: int, most: int) -> None:
        ServerError.__init__(
            self,
            f"the {key} has {taken} {what} open: must be at most {most} at once",
            field=what,
            value=taken,
            allowed=f"at most {most} at once of the {key}",
        )
        self.key, self.seconds = key, self.AGAIN


class Internal(ServerError):
    """A fault of the server; the log has the traceback."""


class Draining(ServerError):
    """The server is shutting down."""

    headers: ClassVar[Mapping[str, str]] = {"retry-after": "1"}


class Unavailable(ServerError):
    """The database does not answer: it is lost, or somebody has it locked."""

    headers: ClassVar[Mapping[str, str]] = {"retry-after": "1"}


def invalid_field(field: str, value: object, allowed: str) -> Invalid:
    """The error for one field found wrong by hand."""
    return Invalid([_value_fault(field, value, allowed)])


def _value_fault(field: str, value: object, allowed: str) -> Fault:
    detail = f"{field} = {shown(value)!r}: must be {allowed}"
    return Fault(code="value", field=field, value=shown(value), allowed=allowed, detail=detail)


def invalid_fields(error: ValidationError) -> Invalid:
    """pydantic's findings as ours, one fault each, the first of them when there are many."""
    return Invalid([_fault(dict(found)) for found in error.errors(include_url=False)[:MOST_FAULTS]])


def _fault(found: Mapping[str, Any]) -> Fault:
    # a field that the request made up has any name, of any length
    parts = [str(shown(str(part))) for part in found["loc"] if not str(part).startswith("function-")]
    cause = found.get("ctx", {}).get("error")
    if isinstance(cause, TournamentError):
        inner = re.sub(r"\[(\d+)\]", r".\1", cause.field)  # as everywhere on the wire
        place = ".".join([*parts, inner] if inner else parts)
        return _value_fault(place, cause.value, cause.allowed.removeprefix("must be "))
    if isinstance(cause, PhysicsError):
        # what pydantic looked at may be the whole of a table: the physics knows which parameter it was
        return _physics_fault(cause, parts, found["type"])
    field = ".".join(parts)
    return Fault(
        code=found["type"],
        field=field or None,
        value=None if found["type"] == "missing" else shown(found["input"]),
        allowed=found["msg"],
        detail=f"{field or 'the body'}: {found['msg']}",
    )


def invalid_physics(error: PhysicsError, place: Sequence[str] = ()) -> Invalid:
    """What the physics does not take, by the name that the field has at `place` of the request."""
    return Invalid([_physics_fault(error, place, type(error).__name__)])


def _physics_fault(error: PhysicsError, place: Sequence[str], code: str) -> Fault:
    """A fault at `place` of the request, or below it."""
    inner = error.field
    for theirs, ours in _PHYSICS_FIELDS:
        inner = re.sub(theirs, ours, inner)
    field = ".".join(place if place and place[-1] == inner else [*place, inner])
    value = shown(error.value)
    return Fault(
        code=code, field=field, value=value, allowed=error.allowed, detail=f"{field} is {value!r}: {error.allowed}"
    )


_PHYSICS_FIELDS = (
    (r"^states\[(\d+)\]\[(\d+)\]", r"tables.\1.\2"),
    (r"^positions\[(\d+)\]", r"balls.\1"),
    (r"^shots\[(\d+)\]", r"shots.\1"),
)
"""What the physics calls a field, and what requests call it."""


def render(error: ServerError, instance: str) -> Response:
    """The one place where an error becomes a response."""
    body = error.problem(instance).model_dump_json(exclude_unset=True)
    headers = dict(error.headers) | ({} if error.seconds is None else {"retry-after": str(error.seconds)})
    return Response(body, error.status, headers=headers, media_type=PROBLEM_JSON)


async def handle_server_error(request: Request, error: Exception) -> Response:
    """Exception handler for our own errors."""
    assert isinstance(error, ServerError)
    return render(error, request.url.path)


async def handle_framework_error(request: Request, error: Exception) -> Response:
    """Exception handler for the framework's own 404 and 405."""
    assert isinstance(error, HTTPException)
    if error.status_code == 405:
        response = render(MethodNotAllowed(f"{request.method} is not allowed here"), request.url.path)
        response.headers["allow"] = ", ".join(_methods(request))
        return response
    return render(NotFound(f"there is nothing at {request.url.path}"), request.url.path)


def _methods(request: Request) -> list[str]:
    """What is allowed at the request's address, over all routes: the framework knows of the first alone."""
    here = [route for route in request.app.state.endpoints if route.matches(request.scope)[0] is not Match.NONE]
    return sorted({method for route in here for method in route.methods})


async def handle_fault(request: Request, error: Exception) -> Response:
    """Exception handler for what should never happen."""
    log.error("fault while answering %s %s", request.method, request.url.path, exc_info=error)
    return render(Internal("the server has a fault; it was logged"), request.url.path)
