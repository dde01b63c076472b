"""A real browser, Debian's Chromium, before a real server; every page is watched for what a page must never do."""

import itertools
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
import uuid
from collections.abc import Callable, Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import httpx2
import pytest
from support.play_along import Match, play_on
from support.require import require

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
ORGANISER = "organiser-of-the-browser-tests-0123456789"
PATIENCE = 900.0
"""Seconds: after a change of the kernels the first server compiles them before it is ready."""
A_LOADED_MACHINE = 60.0
"""Seconds that a page may take for anything."""
ROOMY = {"POOLIAD_NO_SHOW_SECONDS": "86400"}
"""However slowly the tests play, nobody loses for it."""

_names = itertools.count()


class Server:
    """`python -m server` on a port it keeps when it is started again."""

    def __init__(self, database: Path, **environment: str) -> None:
        self._database, self._port = database, 0
        self._environment = os.environ | {"POOLIAD_ORGANISER_TOKEN": ORGANISER} | ROOMY | environment
        self._log = database.with_suffix(".log").open("ab")
        self.start()

    def start(self) -> None:
        arguments = ["--port", str(self._port), "--database", f"sqlite:///{self._database}"]
        self.process = subprocess.Popen(
            [sys.executable, "-m", "server", *arguments],
            env=self._environment,
            stdout=subprocess.PIPE,
            stderr=self._log,
            text=True,
        )
        assert self.process.stdout is not None
        self.url = json.loads(self.process.stdout.readline())["url"]
        self._port = int(self.url.rpartition(":")[2])
        self.http = httpx2.Client(base_url=self.url, timeout=PATIENCE)
        end = time.monotonic() + PATIENCE
        while self.http.get("/readyz").status_code != 200:
            assert time.monotonic() < end, "the server is not ready"
            time.sleep(0.05)

    def stop(self, number: int = signal.SIGTERM) -> None:
        self.http.close()
        self.process.send_signal(number)
        self.process.wait(PATIENCE)
        assert self.process.stdout is not None
        self.process.stdout.close()

    def close(self) -> None:
        self.stop(signal.SIGKILL)
        self._log.close()

    def send(self, method: str, path: str, token: str = ORGANISER, **options: Any) -> httpx2.Response:
        headers = {"Authorization": f"Bearer {token}", "Idempotency-Key": uuid.uuid4().hex}
        return self.http.request(method, path, headers=headers | options.pop("headers", {}), **options)

    def register(self, name: str = "") -> dict[str, Any]:
        """A fresh agent: `agent` and `token`."""
        made = self.http.post("/v1/agents", json={"name": name or f"player {next(_names)}"})
        assert made.status_code == 201, made.text
        return dict(made.json())

    def match(self, *, games: int = 1, names: tuple[str, str] = ("", ""), **terms: Any) -> Match:
        """A running match of two fresh agents."""
        players = [self.register(name) for name in names]
        agents = [one["agent"]["id"] for one in players]
        request = {"agents": agents, "games": games, "seed": "5" * 64, "clock": {"seconds": 3600}} | terms
        made = self.send("POST", "/v1/matches", json=request)
        assert made.status_code == 201, made.text
        return Match(self, made.json(), [one["token"] for one in players])


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """A server that the tests leave running."""
    running = Server(tmp_path_factory.mktemp("browser") / "pooliad.db")
    yield running
    running.close()


@pytest.fixture
def own_server(tmp_path: Path) -> Iterator[Server]:
    """A server to stop and start."""
    running = Server(tmp_path / "pooliad.db")
    yield running
    running.close()


@pytest.fixture
def own_server_for_one(tmp_path: Path) -> Iterator[Server]:
    """A server that lets an address watch once at a time."""
    running = Server(tmp_path / "pooliad.db", POOLIAD_STREAMS="1")
    yield running
    running.close()


class Folder(SimpleHTTPRequestHandler):
    """Gives the files of a folder, and says nothing."""

    def log_request(self, code: Any = "-", size: Any = "-") -> None:
        """Nothing."""


@pytest.fixture
def embedder(tmp_path: Path) -> Iterator[tuple[str, Path]]:
    """Another origin, and the folder whose files it shows."""
    folder = tmp_path / "pages"
    folder.mkdir()
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Folder, directory=str(folder))) as http:
        threading.Thread(target=http.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{http.server_port}", folder
        http.shutdown()


@pytest.fixture
def own_server_in_frames(tmp_path: Path, embedder: tuple[str, Path]) -> Iterator[Server]:
    """A server whose games another page may show."""
    running = Server(tmp_path / "pooliad.db", POOLIAD_FRAME_ANCESTORS=embedder[0])
    yield running
    running.close()


@pytest.fixture
def own_server_with_bot(tmp_path: Path) -> Iterator[Server]:
    """A server that keeps a house bot."""
    running = Server(tmp_path / "pooliad.db", POOLIAD_HOUSE_BOTS="random")
    yield running
    running.close()


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium, without a window. Not for the whole session: Playwright keeps an event loop running meanwhile."""
    require(find_spec("playwright") is not None, "playwright, of the test extra")
    require(CHROMIUM is not None, "Chromium (Debian's package chromium)")
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []
        chromium = playwright.chromium.launch(executable_path=CHROMIUM, args=sandbox)
        yield chromium
        chromium.close()


class Watched:
    """What a page did that it must not: errors, breaches of its policy, requests to anywhere else."""

    def __init__(self, home: str) -> None:
        self._home = home
        self.faults: list[str] = []
        self.forgiven: tuple[str, ...] = ()

    def watch(self, page: Any) -> None:
        page.on("pageerror", lambda error: self.faults.append(f"error: {error}"))
        page.on("console", lambda told: self.faults.append(told.text) if told.type in ("error", "warning") else None)
        page.on("request", self._request)

    def _request(self, request: Any) -> None:
        if not request.url.startswith((self._home, "data:", "blob:")):
            self.faults.append(f"a request to {request.url}")

    def unforgiven(self) -> list[str]:
        return [fault for fault in self.faults if not any(text in fault for text in self.forgiven)]


@pytest.fixture
def watched(request: pytest.FixtureRequest) -> Watched:
    """What is seen of the test's pages; `forgiven` names the faults a test provokes."""
    own = [name for name in request.fixturenames if name.startswith("own_server")]
    return Watched(request.getfixturevalue(own[0] if own else "server").url)


@pytest.fixture
def new_page(browser: Any, watched: Watched) -> Iterator[Callable[..., Any]]:
    """Makes a page with a context of its own; options as of a browser context."""
    contexts = []

    def make(width: int = 1200, height: int = 900, **options: Any) -> Any:
        context = browser.new_context(viewport={"width": width, "height": height}, **options)
        context.set_default_timeout(1000 * A_LOADED_MACHINE)
        contexts.append(context)
        page = context.new_page()
        watched.watch(page)
        return page

    yield make
    for context in contexts:
        context.close()
    assert watched.unforgiven() == []


@pytest.fixture
def foretold() -> Callable[[Any], str]:
    """Waits until the laboratory shows what the shot does that is set now; what it says of it."""

    def wait(page: Any) -> str:
        shown = page.locator(".lab .outcome:not([aria-busy])", has_text="events in")
        shown.wait_for()
        return str(shown.inner_text())

    return wait


@pytest.fixture
def page(new_page: Callable[..., Any]) -> Any:
    """A page on a screen of middling size."""
    return new_page()


@pytest.fixture
def play() -> Callable[..., int]:
    """Plays a match on with both hands: see `support.play_along`."""
    return play_on
