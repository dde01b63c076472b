"""One test suite over both clients: `Sync` and `Async` give every test the same verbs."""

import asyncio
import json
import os
import subprocess
import sys
import time
import uuid
from collections.abc import Callable
from importlib.util import find_spec
from typing import Any

import httpx2
import pytest
from support.require import require

import client
from client import MatchRequest
from protocol import AgentToken, MatchView
from referee.play import MatchSeed


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


ORGANISER = "organiser-token-of-the-tests-0123456789"


class Hall:
    """A real server on loopback, and shortcuts to what every test needs of it."""

    def __init__(self, url: str) -> None:
        self.url = url
        self.organiser_token = ORGANISER
        self.organiser = client.Pooliad(url, ORGANISER)

    def register(self, stem: str) -> AgentToken:
        """An agent with a name of its own."""
        return self.organiser.register(f"{stem}-{uuid.uuid4().hex[:8]}")

    def match(self, first: AgentToken, second: AgentToken, seed: int = 1, **terms: Any) -> MatchView:
        """A match that starts at once, with seat 0 to break."""
        secret = next(s for s in map(MatchSeed.of, range(seed, seed + 64)) if s.first_breaker == 0)
        request = MatchRequest(agents=(first.agent.id, second.agent.id), seed=secret.secret.hex(), **terms)
        return self.organiser.create_match(request)


SERVER_LIBRARIES = ("fastapi", "uvicorn", "sqlalchemy", "alembic")


@pytest.fixture(scope="session")
def server_installed():
    """Skip without the server's libraries."""
    for name in SERVER_LIBRARIES:
        require(find_spec(name) is not None, f"{name}, of the server extra")


def until_ready(url):
    """Until the kernels are loaded: beside that a busy machine has no second left for what waits five."""
    end = time.monotonic() + 600.0
    while httpx2.get(f"{url}/readyz").status_code != 200 and time.monotonic() < end:
        time.sleep(0.2)


@pytest.fixture(scope="session")
def hall(server_installed, tmp_path_factory):
    """One server process for the whole session."""
    directory = tmp_path_factory.mktemp("server")
    command = [
        sys.executable,
        "-m",
        "server",
        "--port",
        "0",
        "--database",
        f"sqlite:///{directory / 'test.db'}",
    ]
    environment = os.environ | {"POOLIAD_ORGANISER_TOKEN": ORGANISER}
    with subprocess.Popen(command, stdout=subprocess.PIPE, env=environment, text=True) as process:
        try:
            served = Hall(json.loads(process.stdout.readline())["url"])
            until_ready(served.url)
            yield served
            served.organiser.close()
        finally:
            process.terminate()
            process.wait(20)
