"""Text that not every database stores, on SQLite and PostgreSQL: NUL, lone surrogates, ids of any length.

PostgreSQL: "The character with the code zero cannot be in a string constant"
(https://www.postgresql.org/docs/current/sql-syntax-lexical.html). Never a fault, never stored.
"""

import json

import pytest

ODD = ["%00", "a%00b", "%ED%A0%80", "%FF%FE", "x" * 5000, "%F0%9F%8E%B1", "'%3B--", "%25", "%2E%2E"]
ROUTES = [
    ("GET", "/v1/games/{}"),
    ("GET", "/v1/games/{}/shots"),
    ("GET", "/v1/games/{}/stream"),
    ("POST", "/v1/games/{}/shots"),
    ("POST", "/v1/games/{}/forfeit"),
    ("GET", "/v1/matches/{}"),
    ("POST", "/v1/matches/{}/accept"),
    ("POST", "/v1/agents/{}/token"),
    ("DELETE", "/v1/agents/{}/token"),
    ("GET", "/v1/tournaments/{}/standings"),
    ("GET", "/v1/tournaments/{}/entries"),
    ("POST", "/v1/tournaments/{}/start"),
    ("GET", "/web/{}"),
]


@pytest.mark.parametrize(("method", "route"), ROUTES)
def test_an_id_that_cannot_be_is_not_found(organiser, method, route):
    for odd in ODD:
        headers = {"Idempotency-Key": "k", "If-Match": "1", "Content-Type": "application/json"}
        content = b'{"seat": 0, "reason": "crash"}' if method == "POST" else None
        response = organiser.request(method, route.format(odd), content=content, headers=headers)
        assert response.status_code in (403, 404), (odd, response.text)


@pytest.mark.parametrize(
    "query",
    ["matches?agent=", "matches?status=", "agents?cursor=", "agents?house=", "stream?game=", "tournaments?status="],
)
def test_a_query_that_cannot_be_is_named_or_finds_nothing(organiser, query):
    for odd in ODD:
        response = organiser.request("GET", f"/v1/{query}{odd}")
        assert response.status_code in (200, 404, 422), (odd, response.text)
        if "%00" in odd:
            assert response.json()["field"] == query.partition("?")[2][:-1]
        if response.status_code == 200:
            assert response.json()["matches"] == []


NUL = "a\0b"


@pytest.mark.parametrize(
    ("path", "body", "field"),
    [
        ("/v1/agents", {"name": NUL}, "name"),
        ("/v1/matches", {"agents": [NUL, "agent_0"]}, "agents.0"),
        ("/v1/tournaments", {"terms": {"name": NUL}, "agents": {}}, "terms.name"),
        ("/v1/tournaments", {"terms": {}, "agents": {NUL: "x"}}, "agents.key"),
        ("/v1/tokens", {"name": NUL, "scopes": ["read"]}, "name"),
        ("/v1/simulate", {"game": NUL, "balls": {"0": [0.5, 0.5]}, "shot": None}, "game"),
    ],
)
def test_a_text_that_cannot_be_stored_is_named(organiser, path, body, field):
    problem = organiser.post(path, body)
    assert (problem.status_code, problem.json()["code"], problem.json()["field"]) == (422, "invalid", field)


def test_half_a_character_is_no_json(organiser):
    """RFC 8259, 8.2: a lone surrogate is no character that could be sent back."""
    headers = {"Content-Type": "application/json", "Idempotency-Key": "k"}
    for path in ("/v1/agents", "/v1/matches", "/v1/tournaments"):
        response = organiser.request("POST", path, content=b'{"name": "a\\ud800"}', headers=headers)
        assert (response.status_code, response.json()["code"]) == (400, "not_json")


def test_what_looks_like_a_nul_and_is_none_may_be_said(organiser):
    """A backslash and five characters: text like any other."""
    body = json.dumps({"agents": ["\\u0000", "agent_0"]})
    headers = {"Content-Type": "application/json", "Idempotency-Key": "k"}
    problem = organiser.request("POST", "/v1/matches", content=body, headers=headers).json()
    assert "NUL" not in problem["detail"]
