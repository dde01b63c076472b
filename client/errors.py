"""Everything a call to a server can raise: one class per problem code.

::

    PooliadError
    ├── ConnectionFailed        no answer: refused, reset, timed out, garbled on its way
    ├── UnexpectedAnswer        an answer that is not of this protocol
    ├── AgentNotFound           no agent of this name, no such import path
    ├── AgentFailed             an agent's command left or was silent; a local agent kept raising an exception
    │   ├── AgentUnstartable    it cannot be made, or its command cannot be started
    │   └── NonsenseAnswer      it answered, but with no action
    └── ApiError                the server answered with a problem
        ├── BadRequest          400
        │   ├── NotJson
        │   └── BadHeader
        ├── Unauthorized        401
        ├── Forbidden           403
        ├── NotFound            404
        ├── MethodNotAllowed    405
        ├── SlowBody            408
        ├── Conflict            409
        │   ├── GameFinished
        │   ├── GameUnfinished
        │   ├── MatchUnfinished
        │   ├── TournamentUnfinished
        │   ├── NotYourTurn
        │   ├── OutOfTime
        │   ├── BudgetSpent
        │   ├── WrongStatus
        │   └── NameTaken
        ├── StaleVersion        412, carries the current view
        ├── TooLarge            413
        ├── UnsupportedMediaType  415
        ├── Unprocessable       422
        │   ├── Invalid
        │   ├── Refused
        │   └── KeyReused
        ├── VersionRequired     428
        ├── TooManyRequests     429
        └── ServerError         5xx
            ├── Internal
            ├── Draining
            └── Unavailable
"""

import contextlib
from typing import ClassVar

import httpx2
from pydantic import ValidationError

from protocol import Problem, ProblemCode, View


class PooliadError(Exception):
    """Base of everything this package raises about servers and agents."""


class ConnectionFailed(PooliadError):
    """No answer came, or none that can be decoded; the cause is the exception of `httpx2`.

    Attributes:
        method, path: the request that was left without an answer.
    """

    def __init__(self, method: str, path: str, cause: object) -> None:
        super().__init__(f"{method} {path}: no answer from the server ({type(cause).__name__}: {cause})")
        self.method = method
        self.path = path


class UnexpectedAnswer(PooliadError):
    """The server says that it worked, but its answer cannot be read: another version, or no Pooliad server.

    Attributes:
        method, path: the request that was answered.
    """

    def __init__(self, method: str, path: str, cause: object) -> None:
        super().__init__(f"{method} {path}: the answer is not what this protocol says: {cause}")
        self.method = method
        self.path = path


class AgentNotFound(PooliadError):
    """The name or the import path of an agent leads nowhere."""


class AgentFailed(PooliadError):
    """An agent fails: its command left or was silent, or it raised the same exception again and again (the cause)."""


class AgentUnstartable(AgentFailed):
    """An agent cannot be made (the cause is what its class raised), or its command cannot be started."""


class NonsenseAnswer(AgentFailed):
    """An agent answered, but with no action."""


class ApiError(PooliadError):
    """The server answered with a problem. A class named like a `ProblemCode` is raised for that code.

    Attributes:
        status: HTTP status.
        problem: the parsed body, or None when it was no problem document (a proxy's page).
        request, response: of `httpx2`.
        retry_after: s, from the header; 0 when there is none.
    """

    code: ClassVar[ProblemCode | None] = None

    def __init_subclass__(cls) -> None:
        cls.code = ProblemCode.of_class(cls.__name__)

    def __init__(self, response: httpx2.Response, problem: Problem | None) -> None:
        self.status = response.status_code
        self.problem = problem
        self.request = response.request
        self.response = response
        super().__init__(f"{self.request.method} {self.request.url.path}: {self._reason()}")

    @property
    def retry_after(self) -> float:
        """Seconds the server asks to wait, 0 when it does not say."""
        text = self.response.headers.get("Retry-After", "")
        return float(text) if text.isdecimal() else 0.0

    def _reason(self) -> str:
        """Status, detail and every fault in one line."""
        if self.problem is None:
            return f"{self.status} {self.response.reason_phrase}"
        faults = "; ".join(fault.detail for fault in self.problem.errors)
        words = f"{self.status} {self.problem.code}: {self.problem.detail}"
        return f"{words} [{faults}]" if faults and faults != self.problem.detail else words


class BadRequest(ApiError):
    """400."""


class NotJson(BadRequest):
    """The body is not JSON."""


class BadHeader(BadRequest):
    """A header is missing or malformed."""


class Unauthorized(ApiError):
    """No token, or one that is not valid."""


class Forbidden(ApiError):
    """The token may not do this."""


class NotFound(ApiError):
    """No such thing."""


class MethodNotAllowed(ApiError):
    """The address exists, but not for this method."""


class SlowBody(ApiError):
    """The body did not arrive in time."""


class Conflict(ApiError):
    """409: the request does not fit the state of the game or the match."""


class GameFinished(Conflict):
    """The game is over."""


class GameUnfinished(Conflict):
    """The game is still on, and this is for finished ones."""


class MatchUnfinished(Conflict):
    """The match has untold noise and is still on; records of its games are given when it is over."""


class TournamentUnfinished(Conflict):
    """The tournament has untold noise and is still on; records of its games are given when it is over."""


class NotYourTurn(Conflict):
    """It is the other player's turn."""


class OutOfTime(Conflict):
    """The caller's clock has run out."""


class BudgetSpent(Conflict):
    """The caller's budget of simulated shots has fewer left."""


class WrongStatus(Conflict):
    """The match is not in a state that allows this."""


class NameTaken(Conflict):
    """Another agent has this name."""


class StaleVersion(ApiError):
    """The game has moved on since the view that was answered."""

    @property
    def view(self) -> View | None:
        """The current view, when the server sent it."""
        return None if self.problem is None else self.problem.view


class TooLarge(ApiError):
    """The body is too large."""


class UnsupportedMediaType(ApiError):
    """The body must be JSON."""


class Unprocessable(ApiError):
    """422: well-formed, but wrong."""


class Invalid(Unprocessable):
    """A field is missing, unknown, of the wrong type or out of range."""


class Refused(Unprocessable):
    """The referee refuses the stroke or the decision; nothing happened, the clock runs on."""


class KeyReused(Unprocessable):
    """This Idempotency-Key came before with another body."""


class VersionRequired(ApiError):
    """The request needs `If-Match` with the version of the view it answers."""


class TooManyRequests(ApiError):
    """Wait for `retry_after` seconds."""


class ServerError(ApiError):
    """5xx: the server cannot carry out a request that may be right."""


class Internal(ServerError):
    """A fault of the server."""


class Draining(ServerError):
    """The server is shutting down."""


class Unavailable(ServerError):
    """The server's database does not answer."""


def error_of(response: httpx2.Response) -> ApiError:
    """The exception for a response that is no success, by its problem code, else by its status."""
    problem = _problem(response)
    for kind in _kinds(ApiError):
        if problem is not None and kind.code == problem.code:
            return kind(response, problem)
    if response.status_code >= 500:
        return ServerError(response, problem)
    return ApiError(response, problem)


def _problem(response: httpx2.Response) -> Problem | None:
    """The body as a problem document, None when it is not one.

    Its code decides what is raised; a view that a newer or older server words differently must not hide it.
    """
    for left_out in ({}, {"view": None}):
        with contextlib.suppress(ValidationError, ValueError, TypeError):
            return Problem.model_validate(response.json() | left_out)
    return None


def _kinds(base: type[ApiError]) -> list[type[ApiError]]:
    """`base` and every class below it."""
    return [base, *(kind for child in base.__subclasses__() for kind in _kinds(child))]
