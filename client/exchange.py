"""One logical request from its first attempt to its answer, without any input or output.

The synchronous and the asynchronous client drive the same generator: it yields what to do next (send this
call, or wait that many seconds) and is sent what came of it. So what is retried, when, and how an answer is
read is written once and tested without a network.
"""

from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass, field
from typing import Any, Generic, TypeVar

import httpx2
from pydantic import ValidationError

from client.errors import ConnectionFailed, PooliadError, UnexpectedAnswer, error_of
from client.retry import Retry

Answer = TypeVar("Answer")

IDEMPOTENCY_KEY = "Idempotency-Key"
CONNECT_TIMEOUT = 10.0
"""Seconds to reach the server before an attempt counts as failed."""
ANSWER_TIMEOUT = 30.0
"""Seconds to wait for an answer, beyond the time a long poll was asked to take."""


@dataclass(frozen=True, slots=True)
class ApiCall(Generic[Answer]):
    """A request, independent of who sends it and how often.

    Args:
        method, path: as in HTTP; the path is relative to the server's address.
        read: turns a successful response into what the caller gets.
        params, headers, body: query, extra headers, and the JSON body (None: no body).
        poll: s, how long the server was asked to hold the answer back.
        pure: the request changes nothing although it is not a GET (simulations).
    """

    method: str
    path: str
    read: Callable[[httpx2.Response], Answer]
    params: Mapping[str, str] = field(default_factory=dict)
    headers: Mapping[str, str] = field(default_factory=dict)
    body: Any = None
    poll: float = 0.0
    pure: bool = False

    @property
    def is_repeatable(self) -> bool:
        """Whether sending this twice cannot do anything twice."""
        return self.method == "GET" or self.pure or IDEMPOTENCY_KEY in self.headers

    def arguments(self) -> dict[str, Any]:
        """Keyword arguments of `httpx2.Client.request`."""
        timeout = httpx2.Timeout(ANSWER_TIMEOUT + self.poll, connect=CONNECT_TIMEOUT)
        arguments: dict[str, Any] = {"params": self.params, "headers": self.headers, "timeout": timeout}
        return arguments if self.body is None else arguments | {"json": self.body}


@dataclass(frozen=True, slots=True)
class Wait:
    """Do nothing for so many seconds."""

    seconds: float


Step = ApiCall[Any] | Wait
Outcome = httpx2.Response | httpx2.RequestError | None
"""What came of a step: a response, none that can be read, or None after a pause."""


def exchange(call: ApiCall[Answer], retry: Retry) -> Generator[Step, Outcome, Answer]:
    """Yield what to do until there is an answer, and return it.

    Raises `client.errors.PooliadError` when the answer is a problem or none came.
    """
    failures = 0
    while True:
        outcome = yield call
        if isinstance(outcome, httpx2.Response) and outcome.is_success:
            return _read(call, outcome)
        failures += 1
        error = _failure(call, outcome)
        pause = retry.pause(failures, error) if call.is_repeatable else None
        if pause is None:
            raise error
        yield Wait(pause)


def _read(call: ApiCall[Answer], response: httpx2.Response) -> Answer:
    """The answer in a successful response."""
    try:
        return call.read(response)
    except ValidationError as error:
        raise UnexpectedAnswer(call.method, call.path, error) from error


def _failure(call: ApiCall[Any], outcome: Outcome) -> PooliadError:
    """The exception for an attempt that brought no answer."""
    if isinstance(outcome, httpx2.Response):
        return error_of(outcome)
    error = ConnectionFailed(call.method, call.path, outcome)
    error.__cause__ = outcome
    return error
