"""Tournaments over HTTP: docs/running-tournaments.md, Over HTTP; docs/protocol.md, Tournaments."""

import signal

import pytest
from support.cup import Cup
from support.streams import until, watching

from referee.record import read_record, verify_record
from tournament import Spec, Tournament, game_seeds
from tournament.ledger import Act, Ledger


@pytest.fixture
def cup(organiser, new_player):
    return lambda *args, **terms: Cup(organiser, new_player, *args, **terms)


def test_an_event_runs_from_start_to_finish(cup):
    event = cup()
    assert event.read()["status"] == "created"
    assert event.running() == []
    assert event.act("start").json()["status"] == "running"
    assert len(event.running()) == 1  # three players: two of them meet, and nobody plays two games at once
    event.play_out()
    view = event.read()
    assert (view["status"], view["games"], view["due"]) == ("finished", 6, 0)
    assert view["started_at"] < view["ended_at"]
    lines = event.read("/standings")["standings"]
    assert [line["points"] for line in lines] == [2.0, 2.0, 2.0]  # everybody conceded every own break
    assert {line["agent"] for line in lines} == {player.id for player in event.players.values()}


@pytest.mark.parametrize(
    ("terms", "games"),
    [
        ({"format": "swiss", "rounds": 3}, 12),
        ({"format": "knockout", "extra_pairs": 1}, 12),
        ({"format": "gauntlet"}, 6),
    ],
    ids=["swiss", "knockout", "gauntlet"],
)
def test_every_format_is_played_to_its_end(cup, terms, games):
    """Everybody concedes the own break: all meetings are drawn, and a knockout plays its extra pairs."""
    event = cup(("ann", "bob", "cat", "dan"), **terms)
    event.act("start")
    assert len(event.play_out()) == games
    view = event.read()
    assert (view["status"], view["games"], view["due"]) == ("finished", games, 0)
    assert sum(line["score"] for line in event.read("/standings")["standings"]) == games


def test_both_games_of_a_pair_have_the_racks_and_the_noise_of_the_events_seed(cup, organiser):
    event = cup(("ann", "bob"))
    event.act("start")
    games = event.play_out()
    spec = Spec.from_dict(event.terms)
    (pair,) = Tournament(spec).pairs
    for leg, game in enumerate(games):
        text = organiser.get(f"/v1/games/{game}/record").text
        assert verify_record(text.splitlines()).ok
        seeds, record = game_seeds(spec, pair, leg), read_record(text.splitlines())
        assert record.end["noise_secret"] == seeds.noise.hex()
        assert record.header["start"]["breaker"] == leg
        assert record.header["players"] != ["seat 0", "seat 1"]


def test_the_seed_is_a_secret_until_the_end(cup, organiser):
    event = cup(("ann", "bob"))
    assert "seed" not in event.read()["terms"]
    event.act("start")
    assert "seed" not in organiser.get(f"/v1/tournaments/{event.id}").json()["terms"]
    event.play_out()
    assert event.read()["terms"]["seed"] == 5


@pytest.mark.parametrize("noise", [{"levels": [3.0625]}, {"range": [3.0625, 3.0625]}], ids=["levels", "range"])
def test_an_unknown_level_of_noise_is_a_secret_until_the_end(cup, server, noise):
    """Whatever is answered while the event goes on: its terms told the level, where each game did not."""
    event = cup(("ann", "bob"), noise=noise | {"told": False})
    answers = [event.organiser.get(f"/v1/tournaments/{event.id}"), event.act("start")]
    (running,) = event.running()
    assert running["noise"] is None
    (game,) = event.organiser.get(f"/v1/matches/{running['match']}").json()["played"]
    paths = [f"tournaments/{event.id}", f"tournaments/{event.id}/standings", "tournaments"]
    paths += [f"matches/{running['match']}", f"games/{game['id']}", f"games/{game['id']}/shots"]
    answers += [event.organiser.get(f"/v1/{path}") for path in paths]
    assert {answer.status_code for answer in answers} == {200}
    told = [answer.text for answer in answers]
    with watching(server, f"/v1/games/{game['id']}/stream") as events:
        told += [str(event.data) for event in until(events, "connections")]
    assert not [text for text in told if "3.0625" in text]
    event.play_out()
    assert {game["noise"] for game in event.read()["played"]} == {3.0625}
    assert event.read()["terms"]["noise"] == noise | {"told": False}


def test_a_pause_lets_games_end_and_begins_none(cup):
    event = cup(("ann", "bob"))
    assert event.act("pause").status_code == 409
    event.act("start")
    assert event.act("pause").json()["status"] == "paused"
    event.concede(event.running()[0])
    assert event.running() == []
    assert event.act("start").json()["status"] == "running"
    assert len(event.running()) == 1


def test_an_aborted_event_calls_its_matches_off(cup, organiser):
    event = cup()
    event.act("start")
    (game,) = event.running()
    assert event.act("abort").json()["status"] == "aborted"
    assert organiser.get(f"/v1/matches/{game['match']}").json()["status"] == "aborted"
    assert event.running() == [game]  # it never got a result
    assert event.act("start").status_code == 409


def test_a_match_that_is_called_off_is_played_again(cup, organiser):
    event = cup(("ann", "bob"))
    event.act("start")
    (game,) = event.running()
    organiser.post(f"/v1/matches/{game['match']}/abort")
    (again,) = event.running()
    assert (again["pair"], again["leg"], again["attempt"]) == (game["pair"], game["leg"], 1)
    assert again["match"] != game["match"]


def test_a_void_game_is_played_again(cup):
    event = cup(("ann", "bob"))
    event.act("start")
    event.concede(event.running()[0])
    view = event.act("void", {"pair": "r0-m0-p0", "leg": 0, "reason": "wrong table"}).json()
    assert [game["status"] for game in view["played"]] == ["void", "running"]
    assert view["log"][-1]["fields"]["reason"] == "wrong table"
    event.play_out()
    assert [(game["leg"], game["attempt"], game["status"]) for game in event.read()["played"]] == [
        (0, 0, "void"),
        (0, 1, "finished"),
        (1, 0, "finished"),
    ]


def test_who_is_disqualified_leaves_the_game_and_the_event(cup, organiser):
    event = cup()
    event.act("start")
    (game,) = event.running()
    loser = game["players"][0]
    assert event.act("disqualify", {"name": loser, "reason": "two accounts"}).status_code == 200
    assert organiser.get(f"/v1/matches/{game['match']}").json()["status"] == "aborted"
    event.play_out()
    assert event.read()["status"] == "finished"
    assert {line["name"]: line["withdrawn"] for line in event.read("/standings")["standings"]}[loser]


@pytest.mark.parametrize(
    ("terms", "agents", "field"),
    [
        ({"pairs": 0}, {}, "terms.pairs"),
        ({"name": ""}, {}, "terms.name"),
        ({"noise": {"levels": [9]}}, {}, "terms.noise.levels.0"),
        ({"seconds": 1e-10}, {}, "terms.seconds"),
        ({"sed": 3}, {}, "terms.sed"),
        ({"table": {"name": "olympiad", "mu_slide": -1}}, {}, "terms.table.mu_slide"),
        ({}, {"ann": "agent_0"}, "agents.ann"),
        ({}, {"nobody": "agent_0"}, "agents"),
    ],
)
def test_bad_terms_are_named(organiser, new_player, terms, agents, field):
    players = {name: new_player().id for name in ("ann", "bob")}
    body = {"terms": {"name": "Cup", "entrants": ["ann", "bob"], **terms}, "agents": players | agents}
    response = organiser.post("/v1/tournaments", body)
    assert response.status_code == 422, response.text
    assert response.json()["field"] == field


def test_decisions_are_checked_and_carried_out_once(cup, organiser):
    event = cup(("ann", "bob"))
    first = event.act("start", key="once")
    assert event.act("start", key="once").text == first.text
    assert event.act("start").status_code == 409
    bad = event.act("void", {"pair": "r0-m0-p0", "leg": 0})
    assert (bad.status_code, bad.json()["field"]) == (422, "pair")
    assert event.act("disqualify", {"name": "zoe"}).status_code == 422
    assert organiser.get("/v1/tournaments/none").status_code == 404
    assert organiser.get("/v1/tournaments", status="odd").status_code == 422


def test_the_entries_are_everything_that_was_noted_in_its_order(cup):
    """Whoever keeps the same books needs no more than the terms and these."""
    event = cup(("ann", "bob"))
    event.act("start")
    event.concede(event.running()[0])
    event.act("void", {"pair": "r0-m0-p0", "leg": 0})
    event.play_out()
    read = lambda **query: event.organiser.get(f"/v1/tournaments/{event.id}/entries", **query).json()  # noqa: E731
    first, cursor = [], 0
    while cursor is not None:
        page = read(limit=2, cursor=cursor)
        assert len(page["entries"]) == 2
        first += page["entries"]
        cursor = page["next_cursor"]
    assert [entry["kind"] for entry in first] == ["opened", "go_on", "game", "void", "game", "game"]
    assert first == event.read("/entries")["entries"]
    ledger = Ledger(Tournament(Spec.from_dict(event.terms))).after(Act(each["kind"], each["fields"]) for each in first)
    assert ledger.event.finished
    assert read(cursor=first[-1]["number"]) == {"entries": [], "next_cursor": None, "lots": None}


def test_players_do_not_organise(cup):
    event = cup(("ann", "bob"))
    ann = event.players["ann"]
    assert ann.post("/v1/tournaments", {"terms": event.terms}).status_code == 403
    for verb in ("start", "pause", "abort"):
        assert ann.post(f"/v1/tournaments/{event.id}/{verb}").status_code == 403
    assert ann.get(f"/v1/tournaments/{event.id}").status_code == 200
    assert ann.get(f"/v1/tournaments/{event.id}/entries").status_code == 403


def test_events_are_listed_the_newest_first(cup, organiser):
    """The cursor counted the rows before: an event made between two pages had one told twice."""
    first, second = cup(("ann", "bob")), cup(("ann", "bob"))
    page = organiser.get("/v1/tournaments", limit=1).json()
    assert [each["id"] for each in page["tournaments"]] == [second.id]
    cup(("ann", "bob"))
    page = organiser.get("/v1/tournaments", limit=1, cursor=page["next_cursor"]).json()
    assert [each["id"] for each in page["tournaments"]] == [first.id]
    assert organiser.get("/v1/tournaments", cursor="x").status_code == 422


def test_an_event_goes_on_after_the_server_was_killed(own_server, organiser_at, player_at):
    """The result and the next match are written in the transaction of the last stroke."""
    server = own_server()
    event = Cup(organiser_at(server), lambda: player_at(server), ("ann", "bob"))
    event.act("start")
    event.concede(event.running()[0])
    server.restart(signal.SIGKILL)
    assert event.read()["games"] == 1
    event.play_out()
    assert event.read()["status"] == "finished"
