"""CONTRACT, HTTP: matches by the organiser, by challenge and acceptance; abort; commitment; R50."""

import json

import pytest

from referee.record import verify_record


def test_the_organiser_starts_a_match_at_once(new_table):
    table = new_table(games=2)
    assert table.match["status"] == "running"
    assert table.match["agents"] == [player.id for player in table.players]
    assert len(table.match["played"]) == 1
    game = table.match["played"][0]
    assert (game["status"], game["breaker"]) == ("running", table.match["first_breaker"])


def test_a_challenge_waits_for_its_acceptance(new_player):
    ann, bob = new_player(), new_player()
    match = ann.post("/v1/matches", {"agents": [ann.id, bob.id]}).json()
    assert (match["status"], match["challenger"], match["played"]) == ("challenged", 0, [])
    listed = bob.get("/v1/matches", agent=bob.id, status="challenged").json()["matches"]
    assert [found["id"] for found in listed] == [match["id"]]
    own = ann.post(f"/v1/matches/{match['id']}/accept")
    assert (own.status_code, own.json()["code"]) == (403, "forbidden")
    accepted = bob.post(f"/v1/matches/{match['id']}/accept").json()
    assert accepted["status"] == "running"
    again = bob.post(f"/v1/matches/{match['id']}/accept")
    assert (again.status_code, again.json()["code"]) == (409, "wrong_status")


def test_a_challenge_can_be_declined(new_player):
    ann, bob = new_player(), new_player()
    match = ann.post("/v1/matches", {"agents": [bob.id, ann.id]}).json()
    assert match["challenger"] == 1
    assert bob.post(f"/v1/matches/{match['id']}/abort").json()["status"] == "aborted"
    accepted = bob.post(f"/v1/matches/{match['id']}/accept")
    assert (accepted.status_code, accepted.json()["code"]) == (409, "wrong_status")


def test_only_the_organiser_makes_matches_of_others(new_player):
    ann, bob, eve = new_player(), new_player(), new_player()
    response = eve.post("/v1/matches", {"agents": [ann.id, bob.id]})
    assert (response.status_code, response.json()["code"]) == (403, "forbidden")


@pytest.mark.parametrize(
    ("change", "field"),
    [
        ({"agents": ["agent_0", "agent_1"]}, "agents.0"),
        ({"games": 0}, "games"),
        ({"games": "2"}, "games"),
        ({"noise": {"level": 5.1}}, "noise.level"),
        ({"noise": {"level": 1.0, "told": 1}}, "noise.told"),
        ({"noise": {"sigmas": {"v": 1.5}}}, "noise.sigmas.v"),
        ({"noise": {"sigmas": {"w": 0.1}}}, "noise.sigmas.w"),
        ({"clock": {"seconds": 0}}, "clock.seconds"),
        ({"clock": {"seconds": 1e-10}}, "clock.seconds"),
        ({"table": {"name": "olympiad", "mu_slide": -1.0}}, "table"),
        ({"table": "snooker"}, "table"),
        ({"rules": "nine_ball"}, "rules"),
        ({"speed": 1}, "speed"),
        ({"seed": "5"}, "seed"),
    ],
)
def test_bad_terms_are_named(organiser, new_player, change, field):
    request = {"agents": [new_player().id, new_player().id]} | change
    response = organiser.post("/v1/matches", request)
    assert response.status_code == 422, response.text
    problem = response.json()
    assert problem["code"] == "invalid"
    assert problem["field"].startswith(field)
    assert problem["allowed"]


def test_an_agent_does_not_play_itself(organiser, new_player):
    ann = new_player()
    response = organiser.post("/v1/matches", {"agents": [ann.id, ann.id]})
    assert (response.status_code, response.json()["field"]) == (422, "agents")


def test_only_the_organiser_gives_a_seed(new_player):
    ann, bob = new_player(), new_player()
    response = ann.post("/v1/matches", {"agents": [ann.id, bob.id], "seed": "5" * 64})
    assert (response.status_code, response.json()["field"]) == (422, "seed")


def test_players_cannot_abort_a_match_that_runs(new_table):
    table = new_table()
    response = table.players[0].post(f"/v1/matches/{table.match['id']}/abort")
    assert (response.status_code, response.json()["code"]) == (403, "forbidden")


def test_an_aborted_match_tells_both_players_and_reveals_the_seed(new_table):
    table = new_table()
    game = table.match["played"][0]
    assert game["noise_seed"] is None
    aborted = table.organiser.post(f"/v1/matches/{table.match['id']}/abort").json()
    assert aborted["status"] == "aborted"
    assert aborted["winner"] is None
    for player in table.players:
        over, done = player.turn(), player.turn()
        assert (over["type"], over["outcome"]["reason"], over["won"]) == ("game_over", "aborted", None)
        assert (done["type"], done["status"]) == ("match_over", "aborted")
        assert over["noise_seed"] is not None
        assert player.get("/v1/turns").status_code == 204
    record = table.organiser.get(f"/v1/games/{game['id']}/record").text.splitlines()
    assert json.loads(record[0])["commitment"] == game["commitment"]
    assert verify_record(record).ok


def test_the_break_alternates_and_every_game_has_its_own_noise(new_table):
    """R50, by concession; one commitment stands before the first break, and every record fits it afterwards."""
    table = new_table(games=4)
    committed = {}
    for _ in range(4):
        mover, view = table.mover()
        committed[view["game"]] = view["commitment"]
        response = mover.post(f"/v1/games/{view['game']}/concede", version=view["version"])
        assert response.status_code == 200, response.text
        for player in table.players:
            assert player.turn()["type"] == "game_over"
    match = table.organiser.get(f"/v1/matches/{table.match['id']}").json()
    first = match["first_breaker"]
    assert [game["breaker"] for game in match["played"]] == [first, 1 - first, first, 1 - first]
    assert (match["status"], match["score"], match["winner"]) == ("finished", [2.0, 2.0], None)
    assert set(committed.values()) == {table.match["commitment"]}
    assert len({game["noise_seed"] for game in match["played"]}) == 4
    for game in match["played"]:
        record = table.organiser.get(f"/v1/games/{game['id']}/record").text.splitlines()
        assert json.loads(record[0])["commitment"] == table.match["commitment"]
        assert verify_record(record).ok
    for player in table.players:
        assert player.turn()["type"] == "match_over"


def test_the_noise_level_is_told_to_nobody_unless_it_is_told_to_the_players(new_table):
    table = new_table(noise={"level": 3.0, "told": False})
    _, view = table.mover()
    match = table.organiser.get(f"/v1/matches/{table.match['id']}").json()
    assert view["noise"] == match["noise"] == {"told": False, "level": None}
    aborted = table.organiser.post(f"/v1/matches/{table.match['id']}/abort").json()
    assert aborted["noise"] == {"told": False, "level": 3.0}


@pytest.mark.parametrize("told", [True, False])
def test_a_match_with_standard_deviations_of_its_own(new_table, told):
    """They are part of the commitment, told with the level, and every record has them."""
    sigmas = {"v": 0.01, "phi": 0.4, "theta": 0.1, "a": 0.5, "b": 0.5}
    table = new_table(noise={"level": 1.0, "told": told, "sigmas": {"v": 0.01, "phi": 0.4}})
    mover, view = table.mover()
    shown = {"told": True, "level": 1.0, "sigmas": sigmas} if told else {"told": False, "level": None}
    assert view["noise"] == table.organiser.get(f"/v1/matches/{table.match['id']}").json()["noise"] == shown
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    for player in table.players:
        assert player.turn()["type"] == "game_over"
    record = table.organiser.get(f"/v1/games/{view['game']}/record").text.splitlines()
    assert json.loads(record[0])["noise"] == {"level": 1.0, "told": told, "sigmas": sigmas}
    assert json.loads(record[0])["commitment"] == view["commitment"]
    assert verify_record(record).ok


def test_matches_of_a_status_there_is_not_are_refused(server):
    response = server.request("GET", "/v1/matches", params={"status": "zzz"})
    assert response.status_code == 422
    problem = response.json()
    assert (problem["code"], problem["field"], problem["value"]) == ("invalid", "status", "zzz")
    assert problem["allowed"] == "one of challenged, opening, running, finished, aborted"


def test_matches_are_searched_by_their_players_names(server, organiser, new_player):
    ann, bob, cat = (new_player() for _ in range(3))
    looked_up = [server.request("GET", "/v1/agents", params={"search": one.id}).json() for one in (ann, bob, cat)]
    names = {one["id"]: one["name"] for page in looked_up for one in page["agents"]}
    first, second = (organiser.post("/v1/matches", {"agents": [one.id, cat.id]}).json()["id"] for one in (ann, bob))

    def found(search, **params):
        answer = server.request("GET", "/v1/matches", params={"search": search} | params).json()
        return [one["id"] for one in answer["matches"]]

    assert found(names[ann.id]) == [first]
    assert found(names[cat.id].upper()) == [second, first]
    assert found(names[cat.id], agent=bob.id) == [second]
    assert found(names[cat.id], status="finished") == []
    assert found(second) == [second]


def test_a_match_may_be_asked_for_that_does_not_count(organiser, new_player):
    ann, bob = new_player(), new_player()
    terms = {"agents": [ann.id, bob.id], "rated": False}
    assert ann.post("/v1/matches", terms).json()["rated"] is False
    assert organiser.post("/v1/matches", terms | {"rated": True}).json()["rated"] is True
    problem = ann.post("/v1/matches", terms | {"rated": 0})
    assert (problem.status_code, problem.json()["field"]) == (422, "rated")
