"""One test suite over both clients: `Sync` and `Async` give every test the same verbs."""

import asyncio
from collections.abc import Callable
from typing import Any

import httpx2
import pytest

import client


class Sync:
    """The synchronous client."""

    def __init__(self, url: str = "http://server", token: str | None = "secret", **options: Any) -> None:
        self._api = client.Pooliad(url, token, **options)

    def __getattr__(self, name: str) -> Callable[..., Any]:
        return getattr(self._api, name)


class Async:
    """The asynchronous client, each call run to its end."""

    def __init__(self, url: str = "http://server", token: str | None = "secret", **options: Any) -> None:
        self._options = (url, token), options

    def __getattr__(self, name: str) -> Callable[..., Any]:
        async def call(*args: Any, **kwargs: Any) -> Any:
            positional, options = self._options
            async with client.AsyncPooliad(*positional, **options) as api:
                return await getattr(api, name)(*args, **kwargs)

        return lambda *args, **kwargs: asyncio.run(call(*args, **kwargs))


@pytest.fixture(params=[Sync, Async], ids=["sync", "async"])
def make(request):
    """Makes a client of either kind; closed at the end of the test."""
    made = []

    def build(*args, **options):
        made.append(request.param(*args, **options))
        return made[-1]

    yield build
    for each in made:
        if isinstance(each, Sync):
            each.close()


class Script:
    """A transport that answers from a list and keeps what it was asked."""

    def __init__(self, *answers: httpx2.Response | Exception) -> None:
        self.answers = list(answers)
        self.requests: list[httpx2.Request] = []
        self.transport = httpx2.MockTransport(self._answer)

    def _answer(self, request: httpx2.Request) -> httpx2.Response:
        self.requests.append(request)
        answer = self.answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        return answer


@pytest.fixture
def script():
    """`Script`, for tests to fill."""
    return Script


@pytest.fixture
def pauses(monkeypatch):
    """Every pause a client makes, without making it."""
    made: list[float] = []

    async def sleep(seconds: float) -> None:
        made.append(seconds)

    monkeypatch.setattr("client.http.time.sleep", made.append)
    monkeypatch.setattr("client.aio.asyncio.sleep", sleep)
    return made
