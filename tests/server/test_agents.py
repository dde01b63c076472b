"""CONTRACT, HTTP: agents and tokens."""

import uuid

import pytest

from server.store.database import Database
from server.store.tables import metadata


def test_a_token_is_shown_once_and_works(server, new_player):
    player = new_player()
    assert player.token.startswith("pool_agt_")
    assert player.get("/v1/turns").status_code == 204
    assert player.token not in server.request("GET", "/v1/agents", params={"limit": 200}).text


def test_only_the_hash_of_a_token_is_stored(server, new_player):
    player = new_player()
    database = Database(server.database_url)
    with database.reading() as connection:
        dump = str([connection.execute(table.select()).all() for table in metadata.sorted_tables])
    database.dispose()
    assert player.id in dump
    assert player.token not in dump


def test_tokens_have_256_bits_and_differ(new_player):
    tokens = {new_player().token for _ in range(3)}
    assert len(tokens) == 3
    assert all(len(token.removeprefix("pool_agt_")) == 43 for token in tokens)


def test_a_taken_name_is_refused(server, new_player):
    new_player()
    name = server.request("GET", "/v1/agents", params={"limit": 1}).json()["agents"][0]["name"]
    response = server.request("POST", "/v1/agents", json={"name": name})
    assert response.status_code == 409
    problem = response.json()
    assert (problem["code"], problem["field"], problem["value"]) == ("name_taken", "name", name)


def test_rotation_voids_the_old_token(new_player):
    player = new_player()
    response = player.post(f"/v1/agents/{player.id}/token")
    assert response.status_code == 200
    assert player.get("/v1/turns").status_code == 401
    player.token = response.json()["token"]
    assert player.get("/v1/turns").status_code == 204


def test_a_rotation_sent_again_by_the_organiser_gives_the_same_token(organiser, new_player):
    player = new_player()
    path = f"/v1/agents/{player.id}/token"
    first, again = (organiser.post(path, key="rotate") for _ in range(2))
    assert first.content == again.content
    player.token = first.json()["token"]
    assert player.get("/v1/turns").status_code == 204


def test_a_rotation_sent_again_with_the_new_token_shows_no_token_that_was_never_made(new_player):
    player = new_player()
    path = f"/v1/agents/{player.id}/token"
    player.token = player.post(path, key="rotate").json()["token"]
    again = player.post(path, key="rotate")
    assert (again.status_code, again.json()["code"]) == (422, "key_reused")
    assert player.get("/v1/turns").status_code == 204


def test_revocation_leaves_an_agent_without_a_token_until_the_organiser_gives_one(organiser, new_player):
    player = new_player()
    assert player.request("DELETE", f"/v1/agents/{player.id}/token").status_code == 204
    assert player.get("/v1/turns").status_code == 401
    player.token = organiser.post(f"/v1/agents/{player.id}/token").json()["token"]
    assert player.get("/v1/turns").status_code == 204


def test_nobody_touches_the_token_of_another(new_player):
    player, other = new_player(), new_player()
    response = player.post(f"/v1/agents/{other.id}/token")
    assert (response.status_code, response.json()["code"]) == (403, "forbidden")
    assert player.request("DELETE", f"/v1/agents/{other.id}/token").status_code == 403
    assert other.get("/v1/turns").status_code == 204


def test_the_list_is_complete_in_pages(server, new_player):
    registered = [new_player().id for _ in range(3)]
    found, cursor = [], "0"
    while cursor is not None:
        page = server.request("GET", "/v1/agents", params={"limit": 2, "cursor": cursor}).json()
        found += [agent["id"] for agent in page["agents"]]
        cursor = page["next_cursor"]
    assert len(found) == len(set(found))
    assert set(registered) <= set(found)


def test_a_server_without_an_organiser_token_has_no_organiser(own_server, organiser):
    running = own_server(POOLIAD_ORGANISER_TOKEN="")
    assert running.request("GET", "/v1/turns", organiser.token).status_code == 401


def test_a_search_finds_names_by_any_part_of_them_in_pages(server, new_player):
    """Capitals or not; what is special in SQL is not here; an id is found too."""
    mark = uuid.uuid4().hex[:8]
    names = [f"{mark} Ann_1", f"{mark} ann 2", f"{mark} bob"]
    ids = [server.request("POST", "/v1/agents", json={"name": name}).json()["agent"]["id"] for name in names]

    def found(search, **params):
        answer = server.request("GET", "/v1/agents", params={"search": search} | params)
        assert answer.status_code == 200, answer.text
        return answer.json()

    assert [one["id"] for one in found(f"{mark} ANN")["agents"]] == ids[:2]
    assert [one["id"] for one in found(f"{mark} ann_")["agents"]] == ids[:1]
    assert found(f"{mark}%")["agents"] == []
    assert [one["id"] for one in found(ids[2])["agents"]] == ids[2:]
    first = found(mark, limit=2)
    rest = found(mark, limit=2, cursor=first["next_cursor"])
    assert [one["id"] for one in first["agents"] + rest["agents"]] == ids
    assert rest["next_cursor"] is None


@pytest.mark.parametrize("route", ["agents", "matches", "tournaments"])
@pytest.mark.parametrize("bad", ["", "x" * 65, "a\x7fb", "\n"])
def test_what_cannot_be_searched_for_is_named(server, route, bad):
    problem = server.request("GET", f"/v1/{route}", params={"search": bad})
    assert (problem.status_code, problem.json()["field"]) == (422, "search")
    assert "64" in problem.json()["allowed"]
