"""Polls and strokes are carried past the framework's router (`server.http.express`): nobody can tell by the answer."""

import asyncio
import re

import httpx2
import pytest

import server.app
from server.app import create_app, prepare
from server.routes import DIRECT
from server.settings import Settings, organiser_digest

TOKEN = "organiser-" * 4
CHANGES = re.compile(rb'"seconds_left":[0-9.e-]+')
"""What depends on when an answer is given."""
SHOT = {"shot": {"v": 9.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}, "call": None, "cue_ball": [0.558, 1.8]}
AGENT, KEY, VERSION = {"authorization": "Bearer {mover}"}, {"idempotency-key": "k"}, {"if-match": '"1"'}
SHOTS = "/v1/games/{game}/shots"
REQUESTS = {
    "no token": ("POST", SHOTS, {}, SHOT),
    "no such token": ("POST", SHOTS, {"authorization": "Bearer x"}, SHOT),
    "not a player's": ("POST", SHOTS, {"authorization": f"Bearer {TOKEN}"} | KEY | VERSION, SHOT),
    "no such game": ("POST", "/v1/games/game_0/shots", AGENT | KEY | VERSION, SHOT),
    "a game of any name": ("POST", "/v1/games/%C3%A9%20%0A/shots", AGENT | KEY | VERSION, SHOT),
    "no game": ("POST", "/v1/games//shots", AGENT | KEY | VERSION, SHOT),
    "a slash in a game's name": ("POST", "/v1/games/a%2Fb/shots", AGENT | KEY | VERSION, SHOT),
    "a slash at the end": ("POST", SHOTS + "/", AGENT | KEY | VERSION, SHOT),
    "no key": ("POST", SHOTS, AGENT | VERSION, SHOT),
    "no version": ("POST", SHOTS, AGENT | KEY, SHOT),
    "a stale version": ("POST", SHOTS, AGENT | KEY | {"if-match": '"7"'}, SHOT),
    "not their turn": ("POST", SHOTS, {"authorization": "Bearer {other}"} | KEY | VERSION, SHOT),
    "no number": ("POST", SHOTS, AGENT | KEY | VERSION, {"shot": {"v": "fast"}}),
    "refused": ("POST", SHOTS, AGENT | KEY | VERSION, SHOT | {"cue_ball": [0.558, 0.1]}),
    "no JSON": ("POST", SHOTS, AGENT | KEY | VERSION, b"{"),
    "a request's own id": ("POST", SHOTS, AGENT | {"x-request-id": "mine"}, SHOT),
    "read strokes": ("GET", SHOTS, {}, None),
    "delete strokes": ("DELETE", SHOTS, AGENT, None),
    "a turn": ("GET", "/v1/turns", AGENT, None),
    "a turn, waited for": ("GET", "/v1/turns?wait=1", AGENT, None),
    "the last of two waits": ("GET", "/v1/turns?wait=x&wait=1", AGENT, None),
    "no turn": ("GET", "/v1/turns?wait=0", {"authorization": "Bearer {other}"}, None),
    "an empty wait": ("GET", "/v1/turns?wait=", AGENT, None),
    "a wait without end": ("GET", "/v1/turns?wait=inf", AGENT, None),
    "a turn of nobody": ("GET", "/v1/turns?wait=x", {}, None),
    "an organiser's turn": ("GET", "/v1/turns?wait=x", {"authorization": f"Bearer {TOKEN}"}, None),
    "send a turn": ("POST", "/v1/turns", AGENT, {}),
    "the head of a turn": ("HEAD", "/v1/turns", AGENT, None),
}


@pytest.fixture(scope="module")
def both(tmp_path_factory):
    """Two applications on one database, the second without what is under test; ids and tokens of a game on it."""
    settings = Settings(
        database=f"sqlite:///{tmp_path_factory.mktemp('express') / 'pooliad.db'}",
        organiser_digest=organiser_digest(TOKEN),
    )
    express = create_app(settings)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(server.app, "DIRECT", {})
        plain = create_app(settings)
    prepare(express.state.context)
    names = asyncio.run(begin(express))
    yield express, plain, names
    for app in (express, plain):
        app.state.context.database.dispose()


async def begin(app):
    """A game whose first turn has been fetched: its id, and both players' tokens."""
    organiser = {"authorization": f"Bearer {TOKEN}"}
    async with client_of(app) as http:
        made = [
            (await http.post("/v1/agents", json={"name": name}, headers=organiser | {"idempotency-key": name})).json()
            for name in ("ann", "bob")
        ]
        terms = {"agents": [one["agent"]["id"] for one in made]}
        match = (await http.post("/v1/matches", json=terms, headers=organiser | {"idempotency-key": "m"})).json()
        first = match["first_breaker"]
        names = {
            "game": match["played"][0]["id"],
            "mover": made[first]["token"],
            "other": made[1 - first]["token"],
        }
        fetched = await http.get("/v1/turns", headers={"authorization": f"Bearer {names['mover']}"})
        assert fetched.status_code == 200
        return names


def client_of(app):
    return httpx2.AsyncClient(transport=httpx2.ASGITransport(app), base_url="http://express")


@pytest.mark.parametrize("what", REQUESTS)
def test_the_answer_is_the_one_that_the_framework_would_give(both, what):
    express, plain, names = both
    method, path, headers, body = REQUESTS[what]
    headers = {name: value.format(**names) for name, value in headers.items()}
    sent = {"content": body} if isinstance(body, bytes) else {} if body is None else {"json": body}
    if isinstance(body, bytes):
        headers["content-type"] = "application/json"

    async def answer(app):
        async with client_of(app) as http:
            got = await http.request(method, path.format(**names), headers=headers, **sent)
        fields = {name: value for name, value in got.headers.items() if name != "x-request-id" or value == "mine"}
        return got.status_code, fields, CHANGES.sub(b"", got.content)

    direct, framework = (asyncio.run(answer(app)) for app in (express, plain))
    fields = [
        {name: value for name, value in one[1].items() if name != "content-length"} for one in (direct, framework)
    ]
    assert (direct[0], fields[0], direct[2]) == (framework[0], fields[1], framework[2])


def test_what_is_carried_directly_are_routes_that_the_framework_describes(both):
    express, plain, _ = both
    described = {route.endpoint for route in express.state.endpoints if hasattr(route, "endpoint")}
    assert DIRECT.keys() <= described
    assert express.openapi() == plain.openapi()


def test_strokes_and_polls_are_carried_past_the_router(both, monkeypatch):
    """Else the comparison above compares the framework with itself."""
    express, plain, names = both
    for app in (express, plain):
        monkeypatch.setattr(app, "middleware_stack", None)
        for dependent in app.router.routes:
            monkeypatch.setattr(dependent, "handle", unreachable, raising=False)

    async def status(app, method, path):
        async with httpx2.AsyncClient(
            transport=httpx2.ASGITransport(app, raise_app_exceptions=False), base_url="http://express"
        ) as http:
            return (await http.request(method, path.format(**names))).status_code

    for method, path in (("POST", SHOTS), ("GET", "/v1/turns")):
        assert asyncio.run(status(express, method, path)) == 401
        assert asyncio.run(status(plain, method, path)) == 500


async def unreachable(*_):
    raise AssertionError("the framework's router was asked")
