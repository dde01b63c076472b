"""Tokens and registration: docs/protocol.md."""

import sqlite3
import time

import pytest

from server.security.tokens import digest


def make(organiser, *scopes, **options):
    response = organiser.post("/v1/tokens", {"name": "a cup", "scopes": scopes} | options)
    assert response.status_code == 201, response.text
    return response.json()


def stored(server):
    with sqlite3.connect(f"file:{server.database}?mode=ro", uri=True) as database:
        dump = "\n".join(database.iterdump())
    database.close()
    return dump


def test_a_token_is_stored_as_a_hash_and_nowhere_else(server, organiser):
    made = make(organiser, "organiser")
    dump = stored(server)
    assert made["token"] not in dump
    assert digest(made["token"]) in dump
    assert made["token"] not in server.log


def test_tokens_of_staff_have_256_bits(organiser):
    token = make(organiser, "read")["token"]
    assert token.startswith("pool_stf_")
    assert len(token.removeprefix("pool_stf_")) == 43


def test_an_organiser_makes_matches_and_no_tokens(server, organiser, new_player):
    token = make(organiser, "organiser")["token"]
    pair = [new_player().id, new_player().id]
    headers = {"Idempotency-Key": "m"}
    assert server.request("POST", "/v1/matches", token, json={"agents": pair}, headers=headers).status_code == 201
    assert server.request("GET", "/v1/tokens", token).status_code == 403


def test_a_request_sent_again_shows_the_same_token(organiser):
    body = {"name": "again", "scopes": ["read"], "seconds": 60.0}
    first, again = (organiser.post("/v1/tokens", body, key="again") for _ in range(2))
    assert first.content == again.content


@pytest.mark.parametrize(
    ("path", "body"),
    [("/v1/tokens", {"name": "again", "scopes": ["read"]}), ("/v1/invitations", {"count": 2})],
)
def test_a_request_sent_again_with_a_rotated_token_shows_no_secret_that_was_never_made(organiser, server, path, body):
    """The answer was derived from the token presented now: 201, with secrets that the server did not know."""
    made = make(organiser, "admin")
    admin = type(organiser)(server, made["id"], made["token"])
    assert admin.post(path, body, key="again").status_code == 201
    admin.token = admin.post(f"/v1/tokens/{made['id']}/rotate").json()["token"]
    again = admin.post(path, body, key="again")
    assert (again.status_code, again.json()["code"]) == (422, "key_reused")
    assert admin.post(path, body).status_code == 201


def test_an_expired_token_is_refused_and_says_so(server, organiser):
    made = make(organiser, "read", seconds=1.5)
    assert server.request("GET", "/v1/agents", made["token"]).status_code == 200
    time.sleep(1.6)
    response = server.request("GET", "/v1/agents", made["token"])
    assert (response.status_code, response.json()["code"]) == (401, "unauthorized")
    assert "expired" in response.json()["detail"]


def test_a_rotated_token_is_void_at_once(server, organiser):
    made = make(organiser, "read")
    renewed = organiser.post(f"/v1/tokens/{made['id']}/rotate").json()
    assert renewed["id"] == made["id"]
    assert server.request("GET", "/v1/agents", made["token"]).status_code == 401
    assert server.request("GET", "/v1/agents", renewed["token"]).status_code == 200


def test_a_revoked_token_is_void_for_good(server, organiser):
    made = make(organiser, "read")
    for _ in range(2):
        assert organiser.request("DELETE", f"/v1/tokens/{made['id']}").status_code == 204
    assert server.request("GET", "/v1/agents", made["token"]).status_code == 401
    assert organiser.post(f"/v1/tokens/{made['id']}/rotate").json()["code"] == "wrong_status"


def test_the_list_shows_no_secrets_and_is_complete_in_pages(organiser):
    made = [make(organiser, "read") for _ in range(3)]
    found, cursor = [], None
    while True:
        response = organiser.get("/v1/tokens", limit=2, **({} if cursor is None else {"cursor": cursor}))
        assert all(each["token"] not in response.text for each in made)
        found += [each["id"] for each in response.json()["tokens"]]
        cursor = response.json()["next_cursor"]
        if cursor is None:
            break
    assert {each["id"] for each in made} <= set(found)
    assert len(found) == len(set(found))


def test_an_agents_token_is_not_staffs_to_list_or_revoke(organiser, server, new_player):
    player = new_player()
    with sqlite3.connect(f"file:{server.database}?mode=ro", uri=True) as database:
        query = "SELECT id FROM tokens WHERE agent_id = ?"
        ((token_id,),) = database.execute(query, (player.id,)).fetchall()
    database.close()
    assert organiser.request("DELETE", f"/v1/tokens/{token_id}").status_code == 404


@pytest.mark.parametrize(
    "body",
    [
        {"name": "x", "scopes": []},
        {"name": "x", "scopes": ["agent"]},
        {"name": "x", "scopes": ["root"]},
        {"name": "x", "scopes": ["read"], "seconds": 0},
        {"name": "x", "scopes": ["read"], "seconds": 1e300},
        {"scopes": ["read"]},
    ],
)
def test_a_token_that_cannot_be_made_is_named(organiser, body):
    response = organiser.post("/v1/tokens", body)
    assert (response.status_code, response.json()["code"]) == (422, "invalid")


# registration


def register(server, name, token=None, **fields):
    return server.request("POST", "/v1/agents", token, json={"name": name} | fields)


def test_closed_registration_is_for_organisers(own_server, organiser):
    server = own_server(POOLIAD_REGISTRATION="closed")
    assert register(server, "ann").status_code == 403
    made = register(server, "ann", organiser.token)
    assert made.status_code == 201
    assert register(server, "bob", made.json()["token"]).status_code == 403


def test_an_invitation_is_good_for_one_registration(own_server, organiser):
    server = own_server(POOLIAD_REGISTRATION="invited")
    headers = {"Idempotency-Key": "i"}
    invited = server.request("POST", "/v1/invitations", organiser.token, json={"count": 2}, headers=headers)
    first, second = invited.json()["invitations"]
    assert register(server, "ann").status_code == 403
    assert register(server, "ann", invitation="pool_inv_guess").status_code == 403
    assert register(server, "ann", invitation=first).status_code == 201
    assert register(server, "bob", invitation=first).status_code == 403
    assert register(server, "ann", invitation=second).json()["code"] == "name_taken"
    assert register(server, "bob", invitation=second).status_code == 201
    assert first not in stored(server)


def test_an_expired_invitation_is_none(own_server, organiser):
    server = own_server(POOLIAD_REGISTRATION="invited")
    headers = {"Idempotency-Key": "i"}
    body = {"count": 1, "seconds": 0.1}
    invited = server.request("POST", "/v1/invitations", organiser.token, json=body, headers=headers)
    time.sleep(0.15)
    assert register(server, "ann", invitation=invited.json()["invitations"][0]).status_code == 403


def test_agents_tokens_expire_where_the_settings_say_so(own_server):
    server = own_server(POOLIAD_TOKEN_SECONDS="1.5")
    token = register(server, "ann").json()["token"]
    assert server.request("GET", "/v1/turns", token).status_code == 204
    time.sleep(1.6)
    assert server.request("GET", "/v1/turns", token).status_code == 401


def test_reads_take_a_token_where_they_are_not_public(own_server, organiser):
    server = own_server(POOLIAD_PUBLIC_READS="false")
    token = register(server, "ann").json()["token"]
    for path in ("/v1/agents", "/v1/matches", "/v1/games/none/record"):
        assert server.request("GET", path).status_code == 401
        assert server.request("GET", path, token).status_code in (200, 404)


# lists in pages


def test_a_row_that_is_added_meanwhile_moves_no_other(organiser, new_player):
    """Matches are listed the newest first: with offsets a new one would repeat the last row given."""
    ann, bob = new_player(), new_player()

    def new_match():
        return organiser.post("/v1/matches", {"agents": [ann.id, bob.id]}).json()["id"]

    made = [new_match() for _ in range(4)][::-1]
    first = organiser.get("/v1/matches", agent=ann.id, limit=2).json()
    new_match()
    rest = organiser.get("/v1/matches", agent=ann.id, limit=2, cursor=first["next_cursor"]).json()
    assert [match["id"] for match in first["matches"] + rest["matches"]] == made
    assert rest["next_cursor"] is None


@pytest.mark.parametrize("cursor", ["1", "x", "1.", ".x", "1." + "x" * 65, "99999999999999999999.x", "1.\u0661"])
def test_a_cursor_that_is_none_is_refused(organiser, cursor):
    response = organiser.get("/v1/matches", cursor=cursor)
    assert (response.status_code, response.json()["field"]) == (422, "cursor")
