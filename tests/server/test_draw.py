"""Issue: commitment, then the players' seeds, then the rack; reveal at every end. docs/protocol.md, Seeds.

What a player checks afterwards is done here with nothing but the commitment it saw, its own seed and the record.
"""

import hashlib
import json
import time

import pytest
import rfc8785
from sqlalchemy import update
from support.streams import until, watching

from referee.record import verify_record
from server.store.database import Database
from server.store.tables import matches

MINE, THEIRS = "5f" * 32, "a0" * 32


@pytest.fixture
def opening(organiser, new_player):
    """A match that waits for seeds, and its players."""

    def make(seconds=60.0, **terms):
        players = new_player(), new_player()
        request = {"agents": [one.id for one in players], "client_seed_seconds": seconds} | terms
        response = organiser.post("/v1/matches", request)
        assert response.status_code == 201, response.text
        return response.json(), players

    return make


def add(player, match, seed):
    return player.post(f"/v1/matches/{match['id']}/seed", {"seed": seed})


def finish(organiser, match, players):
    """Concede the running game; its record."""
    game = organiser.get(f"/v1/matches/{match['id']}").json()["played"][-1]["id"]
    view = organiser.get(f"/v1/games/{game}").json()["view"]
    mover = players[view["turn"]]
    assert mover.post(f"/v1/games/{game}/concede", version=view["version"]).status_code == 200
    return organiser.get(f"/v1/games/{game}/record").text.splitlines()


def test_a_match_waits_for_both_seeds_and_no_longer(organiser, opening):
    match, (ann, bob) = opening()
    assert (match["status"], match["played"], match["first_breaker"]) == ("opening", [], None)
    wanted = ann.turn()
    assert (wanted["type"], wanted["seat"], wanted["seconds"]) == ("seed_wanted", 0, 60.0)
    assert wanted["commitment"] == match["commitment"]
    first = add(ann, match, MINE).json()
    assert (first["status"], first["client_seeds"]) == ("opening", [MINE, None])
    second = add(bob, match, THEIRS).json()
    assert (second["status"], second["client_seeds"]) == ("running", [MINE, THEIRS])
    assert second["commitment"] == match["commitment"]
    assert len(second["played"]) == 1


def test_the_seeds_of_the_players_are_in_the_record_and_the_commitment_is_the_one_seen_before(organiser, opening):
    match, (ann, bob) = opening()
    add(ann, match, MINE), add(bob, match, THEIRS)
    record = finish(organiser, match, (ann, bob))
    header, end = json.loads(record[0]), json.loads(record[-2])
    assert header["client_seeds"] == [MINE, THEIRS]
    assert header["commitment"] == match["commitment"]
    assert verify_record(record).ok
    link = bytes.fromhex(end["noise_secret"])
    committed = {
        name: header[name]
        for name in (
            *("format", "engine", "match", "games", "rules", "table"),
            *("noise", "racks", "first_breaker", "position"),
        )
    }
    committed["noise_anchor"] = hashlib.sha256(link).hexdigest()
    committed["rack_anchor"] = hashlib.sha256(bytes.fromhex(end["rack_secret"])).hexdigest()
    assert hashlib.sha256(rfc8785.dumps(committed)).hexdigest() == match["commitment"]


def test_nobody_can_hold_a_match_up(organiser, opening):
    """One seed, and the other player silent: it begins when the time is over, with what there is."""
    match, (ann, bob) = opening(seconds=0.3)
    assert add(bob, match, THEIRS).json()["status"] == "opening"
    deadline = time.monotonic() + 20
    while (now := organiser.get(f"/v1/matches/{match['id']}").json())["status"] == "opening":
        assert time.monotonic() < deadline
        time.sleep(0.05)
    assert (now["status"], now["client_seeds"]) == ("running", [None, THEIRS])
    late = add(ann, match, MINE)
    assert (late.status_code, late.json()["code"]) == (409, "wrong_status")
    assert verify_record(finish(organiser, match, (ann, bob))).ok


def test_a_seed_is_added_once_and_not_exchanged(opening):
    match, (ann, _) = opening()
    key = "the same request"
    path = f"/v1/matches/{match['id']}/seed"
    first, again = (ann.post(path, {"seed": MINE}, key=key) for _ in range(2))
    assert (first.status_code, first.content) == (again.status_code, again.content)
    other = ann.post(path, {"seed": THEIRS})
    assert (other.status_code, other.json()["code"]) == (409, "wrong_status")
    assert "seat 0 has added a seed already" in other.json()["detail"]


def test_only_the_players_add_seeds(organiser, opening, new_player):
    match, _ = opening()
    for stranger in (new_player(), organiser):
        response = add(stranger, match, MINE)
        assert (response.status_code, response.json()["code"]) == (403, "forbidden")


@pytest.mark.parametrize("seed", ["", "5f", "5F" * 32, "zz" * 32, 7, None, ["5f" * 32]])
def test_a_bad_seed_is_named(opening, seed):
    match, (ann, _) = opening()
    response = add(ann, match, seed)
    assert (response.status_code, response.json()["field"]) == (422, "seed")


def test_the_challenged_agent_adds_its_seed_with_the_acceptance(new_player):
    ann, bob = new_player(), new_player()
    match = ann.post("/v1/matches", {"agents": [ann.id, bob.id]}).json()
    assert match["status"] == "challenged"
    assert add(ann, match, MINE).json()["client_seeds"] == [MINE, None]
    accepted = bob.post(f"/v1/matches/{match['id']}/accept", {"client_seed": THEIRS}).json()
    assert (accepted["status"], accepted["client_seeds"]) == ("running", [MINE, THEIRS])
    assert accepted["commitment"] == match["commitment"]


def test_the_organiser_accepts_without_a_seed(organiser, new_player):
    ann, bob = new_player(), new_player()
    match = ann.post("/v1/matches", {"agents": [ann.id, bob.id]}).json()
    response = organiser.post(f"/v1/matches/{match['id']}/accept", {"client_seed": MINE})
    assert (response.status_code, response.json()["field"]) == (422, "client_seed")
    assert organiser.post(f"/v1/matches/{match['id']}/accept").json()["status"] == "running"


def test_an_opening_match_is_called_off_by_the_organiser_alone(organiser, opening):
    match, (ann, bob) = opening()
    assert ann.post(f"/v1/matches/{match['id']}/abort").status_code == 403
    assert organiser.post(f"/v1/matches/{match['id']}/abort").json()["status"] == "aborted"
    for player in (ann, bob):
        assert [player.turn()["type"] for _ in range(2)] == ["seed_wanted", "match_over"]
    assert add(ann, match, MINE).json()["code"] == "wrong_status"


def test_a_restart_does_not_lose_an_opening(own_server, table_at):
    server = own_server()
    table = table_at(server, client_seed_seconds=0.5)
    assert table.match["status"] == "opening"
    server.restart()
    deadline = time.monotonic() + 20
    while server.request("GET", f"/v1/matches/{table.match['id']}").json()["status"] == "opening":
        assert time.monotonic() < deadline
        time.sleep(0.05)
    _, view = table.mover()
    assert view["phase"] == "break"


def test_two_matches_share_racks_and_nothing_else(new_table):
    """Paired games: the racks of the other match with the break swapped, the noise of its own."""
    shared = {"racks": {"seed": "77" * 32}, "games": 2}
    one = new_table(**shared, seed="1" * 64, first_breaker=0)
    other = new_table(**shared, seed="2" * 64, first_breaker=1)
    views = [table.mover()[1] for table in (one, other)]
    assert views[0]["balls"] == views[1]["balls"]
    assert [view["breaker"] for view in views] == [0, 1]
    assert one.match["racks"] == {"shared": True, "paired": False}
    assert one.match["commitment"] != other.match["commitment"]
    records = [finish(table.organiser, table.match, table.players) for table in (one, other)]
    assert all(verify_record(record).ok for record in records)
    ends = [json.loads(record[-2]) for record in records]
    assert ends[0]["rack_secret"] == ends[1]["rack_secret"]
    assert ends[0]["noise_secret"] != ends[1]["noise_secret"]


def test_the_games_of_a_pair_share_racks(new_table):
    table = new_table(games=3, racks={"paired": True})
    starts = [json.loads(finish(table.organiser, table.match, table.players)[0])["start"] for _ in range(3)]
    assert starts[0]["state"] == starts[1]["state"] != starts[2]["state"]
    first = starts[0]["breaker"]
    assert [start["breaker"] for start in starts] == [first, 1 - first, first]


@pytest.mark.parametrize(
    ("terms", "field"),
    [({"racks": {"seed": "77" * 32}}, "racks.seed"), ({"first_breaker": 1}, "first_breaker")],
)
def test_only_the_organiser_says_what_is_not_drawn(new_player, terms, field):
    ann, bob = new_player(), new_player()
    response = ann.post("/v1/matches", {"agents": [ann.id, bob.id]} | terms)
    assert (response.status_code, response.json()["field"]) == (422, field)


def test_nothing_that_yields_noise_is_told_before_the_end(server, new_table, break_shot):
    """Views, answers, lists, streams of a running game: none holds a secret, an anchor or a seed of it."""
    table = new_table(noise={"level": 2.0, "told": False}, racks={"seed": "77" * 32})
    mover, view = table.mover()
    told = [json.dumps(view), mover.act(view, break_shot).text]
    game = table.game
    paths = (f"/v1/games/{game}", f"/v1/games/{game}/shots", f"/v1/matches/{table.match['id']}")
    told += [table.organiser.get(path).text for path in paths]
    for path in (f"/v1/games/{game}/stream", f"/v1/stream?game={game}"):
        with watching(server, path) as events:
            told += [json.dumps(event.data) for event in until(events, "connections")]
    assert sum('"entry": 0' in text for text in told) == 1, "the stroke was told by the stream"
    while table.is_running:
        mover, view = table.mover()
        mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
    record = table.organiser.get(f"/v1/games/{game}/record").text.splitlines()
    assert verify_record(record).ok
    end = json.loads(record[-2])
    secrets = ["5" * 64, "77" * 32, end["noise_secret"], end["rack_secret"]]
    secrets += [hashlib.sha256(bytes.fromhex(end[name])).hexdigest() for name in ("noise_secret", "rack_secret")]
    secrets.append(table.organiser.get(f"/v1/games/{game}").json()["noise_seed"])
    told.append(server.log)
    assert not [secret for secret in secrets for text in told if secret in text]


@pytest.mark.slow
def test_a_match_committed_to_another_engine_is_called_off_at_the_start(own_server, table_at):
    """Its records would not be what was committed to; the record of the game that was on says how it ended."""
    server = own_server()
    table = table_at(server)
    table.play(1)
    game, other = table.game, table_at(server)
    server.stop()
    database = Database(server.database_url)
    with database.writing() as connection:
        connection.execute(update(matches).where(matches.c.id == table.match["id"]).values(engine="another"))
    database.dispose()
    server.start()
    assert server.request("GET", f"/v1/matches/{table.match['id']}").json()["status"] == "aborted"
    assert other.is_running
    record = server.request("GET", f"/v1/games/{game}/record").text.splitlines()
    assert json.loads(record[-2])["outcome"]["reason"] == "aborted"
    assert verify_record(record).ok
    assert f"match {table.match['id']} is committed to another engine" in server.log
