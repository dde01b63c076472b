"""Issue 2, point 5: OpenAPI whose every example is sent by a test and answered as documented."""

import functools
import json
import operator
import re
from typing import Any

import pytest
from pydantic import TypeAdapter

import protocol

ENDLESS = "text/event-stream"
"""Read event by event in test_streams.py; here nobody could wait for the end."""
SOFT = {"v": 0.2, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}


@pytest.fixture(scope="module")
def document(server):
    response = server.request("GET", "/openapi.json")
    assert response.status_code == 200
    return response.json()


def operations(document):
    return [(method, path, operation) for path, item in document["paths"].items() for method, operation in item.items()]


def examples_of(operation):
    """The request bodies shown for an operation; one None for an operation without a body."""
    content = operation.get("requestBody", {}).get("content", {}).get("application/json")
    return [None] if content is None else [example["value"] for example in content["examples"].values()]


def model_of(schema: dict[str, Any]) -> TypeAdapter[Any]:
    """The wire model that a response's schema names."""
    if "$ref" in schema:
        return TypeAdapter(getattr(protocol, schema["$ref"].rsplit("/", 1)[1]))
    if "oneOf" in schema:
        return protocol.TURN_MESSAGE
    if "anyOf" in schema:
        kinds = [getattr(protocol, each["$ref"].rsplit("/", 1)[1]) for each in schema["anyOf"]]
        return TypeAdapter(functools.reduce(operator.or_, kinds))
    return TypeAdapter(dict[str, str])


def test_every_reference_leads_somewhere(document):
    names = set(re.findall(r'"#/components/schemas/([^"]+)"', json.dumps(document)))
    assert names <= set(document["components"]["schemas"])
    assert "HTTPValidationError" not in document["components"]["schemas"]


def test_the_contracts_routes_are_all_there(document):
    assert {(method.upper(), path) for method, path, _ in operations(document)} >= {
        ("POST", "/v1/agents"),
        ("GET", "/v1/agents"),
        ("POST", "/v1/agents/{agent_id}/token"),
        ("DELETE", "/v1/agents/{agent_id}/token"),
        ("POST", "/v1/matches"),
        ("GET", "/v1/matches"),
        ("GET", "/v1/matches/{match_id}"),
        ("POST", "/v1/matches/{match_id}/accept"),
        ("POST", "/v1/matches/{match_id}/abort"),
        ("POST", "/v1/matches/{match_id}/seed"),
        ("GET", "/v1/keys"),
        ("POST", "/v1/tournaments"),
        ("GET", "/v1/tournaments"),
        ("GET", "/v1/tournaments/{tournament_id}"),
        ("GET", "/v1/tournaments/{tournament_id}/standings"),
        ("POST", "/v1/tournaments/{tournament_id}/start"),
        ("POST", "/v1/tournaments/{tournament_id}/pause"),
        ("POST", "/v1/tournaments/{tournament_id}/abort"),
        ("GET", "/v1/turns"),
        ("POST", "/v1/games/{game_id}/shots"),
        ("POST", "/v1/games/{game_id}/decisions"),
        ("POST", "/v1/games/{game_id}/concede"),
        ("GET", "/v1/games/{game_id}"),
        ("GET", "/v1/games/{game_id}/shots"),
        ("GET", "/v1/games/{game_id}/record"),
        ("POST", "/v1/simulate"),
        ("POST", "/v1/simulate/batch"),
        ("POST", "/v1/min-elevation"),
        ("GET", "/healthz"),
        ("GET", "/readyz"),
    }


def test_every_body_has_an_example_that_its_own_schema_accepts(document):
    for method, path, operation in operations(document):
        if "requestBody" not in operation:
            continue
        schema = operation["requestBody"]["content"]["application/json"]["schema"]["$ref"]
        examples = examples_of(operation)
        assert examples, (method, path)
        for example in examples:
            getattr(protocol, schema.rsplit("/", 1)[1]).model_validate_json(json.dumps(example))


@pytest.fixture(params=["sent as shown", "sent where it applies"])
def situation(request, new_table, new_player, organiser, break_shot):
    """Whom the examples meet: nobody in particular, or a game in which they can succeed."""
    return Nowhere(organiser) if request.param == "sent as shown" else Somewhere(new_table, new_player, break_shot)


class Nowhere:
    """The examples to the letter: identifiers of the documentation, which name nothing here."""

    def __init__(self, organiser):
        self.organiser = organiser

    def send(self, method, path, operation, example):
        address = re.sub(r"\{\w+\}", "a1", path)
        headers = {header["name"]: header["example"] for header in headers_of(operation)}
        return self.organiser.request(method.upper(), address, headers=headers, **body_of(example))


class Somewhere:
    """A fresh match for every request, its identifiers put in the documentation's places."""

    def __init__(self, new_table, new_player, break_shot):
        self.new_table, self.new_player, self.break_shot = new_table, new_player, break_shot

    def send(self, method, path, operation, example):
        table = self.new_table(noise={"level": 0.0})
        caller, example = table.organiser, dict(example) if example else example
        mover, view = table.mover()
        if path.endswith(("/shots", "/decisions", "/concede")) and method == "post":
            mover, view = self.lead_up(table, mover, view, example or {})
            caller = mover
        if path in ("/v1/turns", "/v1/agents/me"):
            caller = mover
        if path.endswith("/{number}.svg"):
            assert mover.act(view, self.break_shot | {"shot": SOFT}).status_code == 200
        if path.endswith("/record"):
            mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
        if path == "/v1/tournaments" and method == "post":
            example["agents"] = {name: self.new_player().id for name in example["agents"]}
        elif "agents" in (example or {}):
            example["agents"] = [self.new_player().id, self.new_player().id]
        event = self.event(table.organiser, path) if "{tournament_id}" in path else ""
        if path == "/v1/agents" and method == "post":
            example["name"] = f"example {view['game'][-8:]}"
        match, agent = table.match["id"], table.players[0].id
        if path.endswith(("/accept", "/seed")):
            ann, bob = self.new_player(), self.new_player()
            match = ann.post("/v1/matches", {"agents": [ann.id, bob.id]}).json()["id"]
            caller = bob
        token = {"name": "example", "scopes": ["read"]}
        token_id = table.organiser.post("/v1/tokens", token).json()["id"]
        ids = {"agent_id": agent, "match_id": match, "game_id": view["game"], "token_id": token_id}
        address = path.format(**ids, tournament_id=event, name="nine_foot", number=0)
        headers = {header["name"]: header["example"] for header in headers_of(operation)}
        if "If-Match" in headers:
            headers["If-Match"] = f'"{view["version"]}"'
        return caller.request(method.upper(), address, headers=headers, **body_of(example))

    def event(self, organiser, path):
        """A tournament between ann and bob, as far as the request needs it."""
        players = {name: self.new_player() for name in ("ann", "bob")}
        terms = {"name": "Cup", "entrants": list(players), "pairs": 1, "seed": 5}  # no match waits for seeds
        body = {"terms": terms, "agents": {name: player.id for name, player in players.items()}}
        event = organiser.post("/v1/tournaments", body).json()["id"]
        if path.endswith(("/pause", "/void", "/disqualify")):
            organiser.post(f"/v1/tournaments/{event}/start")
        if path.endswith("/void"):
            breaker = organiser.get(f"/v1/tournaments/{event}").json()["played"][0]["players"][0]
            view = players[breaker].turn()["view"]
            assert (
                players[breaker].post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
            )
        return event

    def lead_up(self, table, mover, view, example):
        """Play up to a position in which the example is due."""
        if "decision" in example:
            assert mover.act(view, self.break_shot | {"shot": SOFT}).status_code == 200
        elif example.get("call") is not None:
            assert mover.act(view, self.break_shot | {"shot": SOFT}).status_code == 200
            mover, view = table.mover()
            assert mover.act(view, {"decision": "accept_table"}).status_code == 200
        return table.mover()


def headers_of(operation):
    return [parameter for parameter in operation.get("parameters", []) if parameter["in"] == "header"]


def body_of(example):
    return {} if example is None else {"json": example}


def test_every_example_is_answered_as_documented(document, situation):
    for method, path, operation in operations(document):
        if ENDLESS in operation["responses"].get("200", {}).get("content", {}):
            continue
        for example in examples_of(operation):
            response = situation.send(method, path, operation, example)
            where = (method, path, example, response.status_code, response.text[:500])
            assert str(response.status_code) in operation["responses"], where
            assert response.status_code < 500, where
            if isinstance(situation, Somewhere):
                assert response.status_code < 300, where
            check_body(operation["responses"][str(response.status_code)], response)


def check_body(documented, response):
    """The body is of the documented type and of the documented model."""
    content = documented.get("content", {})
    if not content:
        assert response.content == b""
        return
    kind = response.headers["content-type"].partition(";")[0]
    assert kind in content
    if kind in ("application/json", "application/problem+json"):
        model_of(content[kind]["schema"]).validate_json(response.content)
