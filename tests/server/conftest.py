"""A real server for the tests: `python -m server` on loopback, as a process, with a real SQLite file or PostgreSQL."""

import itertools
import json
import math
import os
import random
import secrets
import signal
import subprocess
import sys
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx2
import pytest
from support.postgres import Cluster, cluster

BOTH = ("sqlite", "postgresql")
DATABASES = {
    "test_agents": BOTH,
    "test_crashes": ("sqlite", pytest.param("postgresql", marks=pytest.mark.long)),
    "test_draw": ("sqlite", pytest.param("postgresql", marks=pytest.mark.long)),
    "test_exactly_once": BOTH,
    "test_long_poll": BOTH,
    "test_matches": BOTH,
    "test_migrations": BOTH,
    "test_order_of_checks": BOTH,
    "test_preferences": BOTH,
    "test_query_plans": BOTH,
    "test_stored_once": BOTH,
    "test_tournaments": BOTH,
    "test_whole_match": BOTH,
    "test_several_processes": ("postgresql",),
    "test_stored_answers": BOTH,
    "test_unstorable": BOTH,
    "test_upgrade": BOTH,
}
"""The databases that a module's tests run on; SQLite unless told."""
ORGANISER_TOKEN = secrets.token_urlsafe(32)
PATIENCE = 600.0
"""Seconds to wait for an answer: the first shot after a change of the kernels waits for their compiler."""

_names = itertools.count()


class Running:
    """One server process over one database; it can be stopped, killed and started again."""

    def __init__(self, folder: Path, url: str, environment: dict[str, str], *options: str) -> None:
        self.database_url = url
        self.environment = os.environ | {"POOLIAD_ORGANISER_TOKEN": ORGANISER_TOKEN} | environment
        self._options = options
        self.port = 0
        """A free one at first; a restart listens where clients know it."""
        self._log_file = folder / f"server{next(_names)}.log"
        self._log = self._log_file.open("ab")
        self.start()

    @property
    def database(self) -> Path:
        """The database's file."""
        assert self.database_url.startswith("sqlite:///")
        return Path(self.database_url.removeprefix("sqlite:///"))

    def start(self) -> None:
        command = [
            sys.executable,
            "-m",
            "server",
            "--port",
            str(self.port),
            "--database",
            self.database_url,
            *self._options,
        ]
        self.process = subprocess.Popen(
            command, env=self.environment, stdout=subprocess.PIPE, stderr=self._log, text=True
        )
        assert self.process.stdout is not None
        line = self.process.stdout.readline()
        if not line:
            self.close()
            pytest.fail(f"the server did not start:\n{self.log}")
        announced = json.loads(line)
        assert announced["event"] == "listening"
        self.url = announced["url"]
        self.port = int(self.url.rpartition(":")[2])
        self.http = httpx2.Client(base_url=self.url, timeout=PATIENCE)

    def stop(self, number: int = signal.SIGTERM) -> int:
        """Send a signal and wait for the end; the exit code."""
        self.http.close()
        self.process.send_signal(number)
        self.process.wait(PATIENCE)
        assert self.process.stdout is not None
        self.process.stdout.close()
        return self.process.returncode

    def restart(self, number: int = signal.SIGTERM) -> None:
        self.stop(number)
        self.start()

    def close(self) -> None:
        self.stop(signal.SIGKILL)
        self._log.close()

    @property
    def log(self) -> str:
        return self._log_file.read_text()

    def request(self, method: str, path: str, token: str | None = None, **options: Any) -> httpx2.Response:
        """Send a request, with a token when one is given."""
        if token is not None:
            options["headers"] = {"Authorization": f"Bearer {token}"} | dict(options.get("headers", {}))
        return self.http.request(method, path, **options)


class Player:
    """An agent with its token, and the requests it makes."""

    def __init__(self, server: Running, agent_id: str, token: str) -> None:
        self.server, self.id, self.token = server, agent_id, token

    def request(self, method: str, path: str, **options: Any) -> httpx2.Response:
        """A request with the agent's token and nothing else of its own."""
        return self.server.request(method, path, self.token, **options)

    def get(self, path: str, **params: Any) -> httpx2.Response:
        return self.request("GET", path, params=params)

    def post(self, path: str, body: Any = None, *, key: str | None = None, version: Any = None) -> httpx2.Response:
        """A well-formed command: a key of its own unless one is given, If-Match when a version is."""
        headers = {"Idempotency-Key": key or str(uuid.uuid4())}
        if version is not None:
            headers["If-Match"] = f'"{version}"'
        return self.request("POST", path, headers=headers, **({} if body is None else {"json": body}))

    def turn(self, wait: float = 10) -> dict[str, Any]:
        """The next message of the long poll; there must be one."""
        response = self.get("/v1/turns", wait=wait)
        assert response.status_code == 200, response.text
        return dict(response.json())

    def act(self, view: dict[str, Any], action: dict[str, Any], **options: Any) -> httpx2.Response:
        """Answer a view: a shot, or a decision."""
        verb = "decisions" if "decision" in action else "shots"
        return self.post(f"/v1/games/{view['game']}/{verb}", action, version=view["version"], **options)


class Table:
    """A match of two fresh agents, and its players by seat."""

    def __init__(self, server: Running, **terms: Any) -> None:
        self.players = (register(server), register(server))
        self.organiser = Player(server, "organiser", ORGANISER_TOKEN)
        request = {"agents": [player.id for player in self.players], "seed": "5" * 64} | terms
        response = self.organiser.post("/v1/matches", request)
        assert response.status_code == 201, response.text
        self.match = response.json()
        self.news: tuple[list[dict[str, Any]], list[dict[str, Any]]] = ([], [])

    @property
    def game(self) -> str:
        """The id of the game now played."""
        match = self.organiser.get(f"/v1/matches/{self.match['id']}").json()
        return str(match["played"][-1]["id"])

    def mover(self) -> tuple[Player, dict[str, Any]]:
        """Who is to play, and the view delivered for it; news that comes before it is put aside in `news`."""
        turn = self.organiser.get(f"/v1/games/{self.game}").json()["view"]["turn"]
        while (message := self.players[turn].turn())["type"] != "turn":
            self.news[turn].append(message)
        return self.players[turn], message["view"]

    def play(self, strokes: int, seed: int = 1) -> list[dict[str, Any]]:
        """Play on with both hands, at random but legally; the answers, at most so many, fewer at the end."""
        chance = random.Random(seed)
        answers: list[dict[str, Any]] = []
        while len(answers) < strokes and self.is_running:
            mover, view = self.mover()
            response = mover.act(view, scripted(view, chance))
            assert response.status_code in (200, 422), response.text
            answers += [response.json()] if response.status_code == 200 else []
        return answers

    @property
    def is_running(self) -> bool:
        """Whether the match goes on."""
        status = self.organiser.get(f"/v1/matches/{self.match['id']}").json()["status"]
        return bool(status == "running")


def scripted(view: dict[str, Any], chance: random.Random) -> dict[str, Any]:
    """Something to do: the first decision allowed, or a shot at a ball that may be called."""
    allowed, balls = view["allowed"], dict(view["balls"])
    if "decision" in allowed["actions"]:
        return {"decision": allowed["decisions"][0]}
    cue_ball = None
    if area := view["cue_ball_area"]:
        cue_ball = balls["0"] = [chance.uniform(*area["x"]), chance.uniform(*area["y"])]
    target = chance.choice(view["callable_balls"] or [ball for ball in map(int, balls) if ball])
    (x, y), (to_x, to_y) = balls["0"], balls[str(target)]
    phi = math.degrees(math.atan2(to_y - y, to_x - x)) + chance.choice((1, 1, 1, 90)) * chance.uniform(-2, 2)
    call: dict[str, Any] | str | None = None
    if allowed["call_required"]:  # nothing may be called on an open table with the 8 alone
        call = {"ball": target, "pocket": chance.randrange(6)} if view["callable_balls"] else "safety"
    v, theta = 9.0 if call is None else chance.uniform(1, 6), chance.uniform(20, 65)
    shot = {"v": v, "phi": phi, "theta": theta, "a": 0.0, "b": 0.0}
    return {"shot": shot, "call": call, "cue_ball": cue_ball}


def register(server: Running) -> Player:
    """A fresh agent. The organiser registers it: the tests are one address, which may register so many a minute."""
    name = f"player {next(_names)} {uuid.uuid4().hex[:8]}"
    response = server.request("POST", "/v1/agents", ORGANISER_TOKEN, json={"name": name})
    assert response.status_code == 201, response.text
    made = response.json()
    return Player(server, made["agent"]["id"], made["token"])


BREAK = {
    "shot": {"v": 9.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0},
    "call": None,
    "cue_ball": [0.558, 1.8],
}
"""A break from straight behind the rack: legal at every noise level the tests use."""


@pytest.fixture(scope="session")
def new_running(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Callable[..., Running]]:
    """Makes a server on a database that is there already; it lives as long as the tests."""
    started: list[Running] = []

    def make(database: str, **environment: str) -> Running:
        started.append(Running(tmp_path_factory.mktemp("server"), database, environment))
        return started[-1]

    yield make
    for running in started:
        running.close()


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """Every test runs on the databases of its module, or on those it names itself."""
    named = [mark for mark in metafunc.definition.iter_markers("parametrize") if mark.args[0] == "database_kind"]
    if "database_kind" in metafunc.fixturenames and not named:
        kinds = DATABASES.get(metafunc.module.__name__.rpartition(".")[2], BOTH[:1])
        metafunc.parametrize("database_kind", kinds, indirect=True, scope="session")


@pytest.fixture(scope="session")
def database_kind(request: pytest.FixtureRequest) -> str:
    return str(request.param)


@pytest.fixture(scope="session")
def postgres() -> Iterator[Cluster]:
    """A PostgreSQL for as long as the tests run."""
    with cluster() as made:
        yield made


@pytest.fixture(scope="session")
def new_database(
    database_kind: str, request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[], str]:
    """Makes the URL of a fresh database."""
    if database_kind == "postgresql":
        made: Cluster = request.getfixturevalue("postgres")
        return made.new
    return lambda: f"sqlite:///{tmp_path_factory.mktemp('database') / 'pooliad.db'}"


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory, new_database: Callable[[], str]) -> Iterator[Running]:
    """A server that lives as long as the tests; they must not stop it."""
    running = Running(tmp_path_factory.mktemp("server"), new_database(), {})
    yield running
    running.close()


@pytest.fixture
def own_server(tmp_path: Path, new_database: Callable[[], str]) -> Iterator[Callable[..., Running]]:
    """Makes a server of the test's own, with settings from the environment, to be stopped as it likes.

    `database`: one that is there already; `options`: more of the command line.
    """
    started: list[Running] = []

    def make(database: str | None = None, options: tuple[str, ...] = (), **environment: str) -> Running:
        started.append(Running(tmp_path, database or new_database(), environment, *options))
        return started[-1]

    yield make
    for running in started:
        running.close()


@pytest.fixture
def organiser(server: Running) -> Player:
    return Player(server, "organiser", ORGANISER_TOKEN)


@pytest.fixture
def new_player(server: Running) -> Callable[[], Player]:
    return lambda: register(server)


@pytest.fixture
def new_table(server: Running) -> Callable[..., Table]:
    """Makes a running match of two fresh agents; terms as in `POST /v1/matches`."""
    return lambda **terms: Table(server, **terms)


@pytest.fixture(scope="session")
def table_at() -> Callable[..., Table]:
    """The same at a server of the test's own."""
    return Table


@pytest.fixture(scope="session")
def player_at() -> Callable[[Running], Player]:
    """A fresh agent at a server of the test's own."""
    return register


@pytest.fixture(scope="session")
def player_with() -> Callable[[Running, str, str], Player]:
    """An agent, or an organiser, that is there already: by id and token."""
    return lambda server, id, token: Player(server, id, token)  # noqa: A006 - as in the data


@pytest.fixture(scope="session")
def organiser_at() -> Callable[[Running], Player]:
    """The organiser at a server of the test's own."""
    return lambda server: Player(server, "organiser", ORGANISER_TOKEN)


@pytest.fixture(scope="session")
def script() -> Callable[..., dict[str, Any]]:
    """What somebody plays who has a view and a source of chance."""
    return scripted


@pytest.fixture
def break_shot() -> dict[str, Any]:
    return BREAK
