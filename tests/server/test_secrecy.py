"""Secrets that outlast a game: the dice of events (docs/protocol.md, Seeds), noise that is not told (Record).

Attacks that worked: 66 of 66 strokes of an event were recomputed from the public seed 0, a seed of four digits was
found from a commitment, and the record of a finished game told the level at which the next one was still played.
"""

import itertools
import json

import pytest
from support.cup import SEEDS, Cup
from support.server_time import Stage
from support.streams import until, watching

from referee.record import read_record, verify_record
from server.security.callers import ORGANISER
from server.services.matches import matches
from server.services.tournaments import tournaments
from tournament import InvalidSpec, Spec, Tournament, game_seeds
from tournament.ledger import Act, Ledger
from tournament.seeds import match_seed

UNTOLD = {"level": 3.0625, "told": False}


@pytest.fixture
def cup(organiser, new_player):
    return lambda *args, **terms: Cup(organiser, new_player, *args, **terms)


# the dice of an event


def test_an_event_without_a_seed_has_dice_that_nobody_knows(cup, organiser):
    """Its terms and whatever an integer gives lead to no noise; the secret is drawn anew, and the players add to it."""
    events = [cup(("ann", "bob"), seed=None) for _ in range(2)]
    for event in events:
        assert event.read()["terms"]["foreseeable"] is event.read()["foreseeable"] is False
        event.act("start")
        (game,) = event.running()
        match = organiser.get(f"/v1/matches/{game['match']}").json()
        assert (match["status"], match["client_seed_seconds"]) == ("opening", 5.0)
        assert event.players["ann"].turn()["type"] == "seed_wanted"
        games = event.play_out()
        texts = [organiser.get(f"/v1/games/{each}/record").text.splitlines() for each in games]
        noise = {read_record(text).end["noise_secret"] for text in texts}
        for seed in range(100):
            spec = Spec.from_dict(event.terms | {"seed": seed})
            (pair,) = Tournament(spec).pairs
            assert noise.isdisjoint(game_seeds(spec, pair, leg).noise.hex() for leg in (0, 1))
        for text in texts:
            assert verify_record(text).ok
            header = read_record(text).header
            assert header["client_seeds"] == [SEEDS[name] for name in game["players"]]
        assert organiser.get(f"/v1/matches/{game['match']}").json()["rated"] is True
        assert len(event.read("/standings")["ratings"]) == 2
    seeds = [event.read()["terms"][name] for event in events for name in ("seed", "lots")]
    assert len(set(seeds)) == 4
    assert {len(seed) for seed in seeds} == {64}


def test_the_revealed_seed_leads_to_every_record(cup, organiser):
    event = cup(("ann", "bob"), seed=None)
    event.act("start")
    games = event.play_out()
    spec = Spec.from_dict(event.read()["terms"])
    (pair,) = Tournament(spec).pairs
    for leg, game in enumerate(games):
        end = read_record(organiser.get(f"/v1/games/{game}/record").text.splitlines()).end
        assert end["noise_secret"] == match_seed(spec, pair, leg).game(0).noise.hex()


@pytest.mark.parametrize("seed", [0, 5, "5f" * 32])
def test_an_event_with_a_chosen_seed_is_foreseeable_and_rates_nobody(cup, organiser, seed):
    event = cup(("ann", "bob"), seed=seed)
    event.act("start")
    (game,) = event.running()
    match = organiser.get(f"/v1/matches/{game['match']}").json()
    assert (match["status"], match["foreseeable"], match["rated"]) == ("running", True, False)
    event.play_out()
    view = event.read()
    assert (view["foreseeable"], view["terms"]["foreseeable"], view["terms"]["seed"]) == (True, True, seed)
    listed = organiser.get("/v1/tournaments", search=event.id).json()["tournaments"]
    assert [each["foreseeable"] for each in listed] == [True]
    standings = event.read("/standings")
    assert (len(standings["standings"]), standings["ratings"]) == (2, [])


def test_a_match_with_a_chosen_seed_is_foreseeable_and_counts_for_no_rating(new_table):
    chosen, drawn = new_table(rated=True).match, new_table(seed=None).match
    assert (chosen["foreseeable"], chosen["rated"]) == (True, False)
    assert (drawn["foreseeable"], drawn["rated"]) == (False, True)


@pytest.mark.parametrize(
    ("terms", "field"),
    [
        ({"lots": "5f" * 32}, "terms.lots"),
        ({"seed": "5f" * 32, "lots": "5f" * 32}, "terms.lots"),
        ({"seed": 5, "foreseeable": False}, "terms.foreseeable"),
        ({"foreseeable": "no"}, "terms.foreseeable"),
        ({"seed": "5F" * 32}, "terms.seed"),
        ({"seed": True}, "terms.seed"),
    ],
)
def test_nobody_passes_a_chosen_seed_off_as_drawn(organiser, new_player, terms, field):
    players = {name: new_player().id for name in ("ann", "bob")}
    body = {"terms": {"name": "Cup", "entrants": ["ann", "bob"], **terms}, "agents": players}
    response = organiser.post("/v1/tournaments", body)
    assert (response.status_code, response.json().get("field")) == (422, field), response.text
    assert "5f5f" not in response.text


def test_lots_are_told_to_organisers_alone_and_tell_nothing_of_the_dice(cup):
    """Whoever keeps the same books needs the order and the levels; the seed stays the server's until the end."""
    names = ("ann", "bob", "cat", "dan")
    event = cup(names, seed=None, seeding="drawn", format="knockout", drawn="lot", noise={"range": [0.0, 5.0]})
    event.act("start")
    page = event.read("/entries")
    assert page["lots"] not in event.organiser.get(f"/v1/tournaments/{event.id}").text
    known = Spec.from_dict(event.terms | {"lots": page["lots"]})
    pairs = {pair.id: pair for pair in Tournament(known).plan.pairs}
    with pytest.raises(InvalidSpec, match="reveals when the event is over"):
        match_seed(known, next(iter(pairs.values())), 0)
    for game in event.read()["played"]:
        assert tuple(game["players"]) == pairs[game["pair"]].players
        assert game["noise"] == pairs[game["pair"]].noise
    event.play_out()
    entries = [Act(each["kind"], each["fields"]) for each in event.read("/entries")["entries"]]
    assert Ledger(Tournament(known)).after(entries).event.finished
    assert event.read()["terms"]["lots"] == page["lots"]


def test_the_seed_stays_a_secret_while_a_match_of_an_event_that_ended_is_played(tmp_path, monkeypatch):
    """Disqualified, the event is over at once, and its match is called off a moment later, or after a crash."""
    stage = Stage(tmp_path / "stray.db")
    agents = stage.game("ann", "bob").ids
    terms = {"name": "Cup", "entrants": ["ann", "bob"], "noise": {"levels": [2.0], "told": False}}
    body = json.dumps({"terms": terms, "agents": dict(zip(terms["entrants"], agents, strict=True))}).encode()
    made = json.loads(tournaments.create(stage.context, stage.command(ORGANISER, body, key="make")).body)
    tournaments.start(stage.context, made["id"], stage.command(ORGANISER, key="start"))
    (game,) = tournaments.one(stage.context, made["id"]).played
    monkeypatch.setattr("server.services.tournaments.tournaments.call_off", lambda context, match: None)
    out = stage.command(ORGANISER, json.dumps({"name": "ann"}).encode(), key="out")
    tournaments.disqualify(stage.context, made["id"], out)
    view = tournaments.one(stage.context, made["id"])
    assert view.status == "finished"
    assert "seed" not in view.terms
    assert view.terms["noise"] == {"told": False}
    assert matches.one(stage.context, str(game.match)).noise.level is None
    matches.call_off(stage.context, str(game.match))
    view = tournaments.one(stage.context, made["id"])
    assert len(view.terms["seed"]) == 64
    assert view.terms["noise"] == {"levels": [2.0], "told": False}
    assert matches.one(stage.context, str(game.match)).noise.level == 2.0
    stage.close()


def test_a_match_that_is_called_off_while_it_waits_for_seeds_is_played_again(cup, organiser):
    """It has no game, and so no record that a result could be read from."""
    event = cup(("ann", "bob"), seed=None)
    event.act("start")
    (first,) = event.running()
    assert organiser.post(f"/v1/matches/{first['match']}/abort").status_code == 200
    (again,) = event.running()
    assert (again["attempt"], again["match"] != first["match"]) == (1, True)
    event.play_out()
    assert [(game["leg"], game["attempt"], game["status"]) for game in event.read()["played"]] == [
        (0, 0, "aborted"),
        (0, 1, "finished"),
        (1, 0, "finished"),
    ]


def test_who_is_disqualified_while_a_match_waits_for_seeds_leaves_it(cup, organiser):
    event = cup(("ann", "bob", "cat"), seed=None)
    event.act("start")
    (game,) = event.running()
    assert event.act("disqualify", {"name": game["players"][0]}).status_code == 200
    assert organiser.get(f"/v1/matches/{game['match']}").json()["status"] == "aborted"
    event.play_out()
    assert event.read()["status"] == "finished"


# noise that is not told


def everything(player, server, match, game):
    """Whatever is told about a finished game, by every way there is."""
    with watching(server, f"/v1/games/{game}/stream") as events:
        streamed = [event.data for event in until(events, "result")]
    view = player.get(f"/v1/matches/{match}").json()
    listed = player.get("/v1/matches", search=match).json()["matches"]
    return [player.get(f"/v1/games/{game}").json(), view, listed, streamed]


def noise_seeds(told):
    """Every noise seed in an answer, however deep."""
    if isinstance(told, list):
        return list(itertools.chain.from_iterable(map(noise_seeds, told)))
    if not isinstance(told, dict):
        return []
    return [value for name, value in told.items() if name == "noise_seed"] + noise_seeds(list(told.values()))


def test_untold_noise_is_kept_back_until_the_match_is_over(new_table, server):
    """It leaked through the first game's record while the second was played."""
    table = new_table(games=2, noise=UNTOLD, seed=None)
    first = table.game
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{first}/concede", version=view["version"]).status_code == 200
    for player in table.players:
        (over,) = [message for message in (player.turn(),) if message["type"] == "game_over"]
        assert over["noise_seed"] is None
        assert "3.0625" not in json.dumps(over)
        record = player.get(f"/v1/games/{first}/record")
        assert (record.status_code, record.json()["code"]) == (409, "match_unfinished")
        assert "when the match is over" in record.json()["detail"]
        told = everything(player, server, table.match["id"], first)
        assert set(noise_seeds(told)) == {None}
        assert "3.0625" not in json.dumps(told)
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    (over,) = [message for message in (mover.turn(),) if message["type"] == "game_over"]
    assert over["noise_seed"] is not None
    assert over["view"]["noise"] == UNTOLD
    for game in (first, view["game"]):
        text = mover.get(f"/v1/games/{game}/record").text.splitlines()
        assert verify_record(text).ok
        assert read_record(text).header["noise"] == UNTOLD
        told = everything(mover, server, table.match["id"], game)
        assert None not in noise_seeds(told)
        assert "3.0625" in json.dumps(told)


def test_untold_noise_of_an_event_is_kept_back_until_the_event_is_over(cup, server, organiser):
    """Each game is a match of its own there, over before the next one with the same level begins."""
    event = cup(("ann", "bob"), seed=None, noise={"levels": [3.0625], "told": False})
    event.act("start")
    (running,) = event.running()
    game = event.concede(running)
    for player in (*event.players.values(), organiser):
        record = player.get(f"/v1/games/{game}/record")
        assert (record.status_code, record.json()["code"]) == (409, "tournament_unfinished")
        assert "when the tournament is over" in record.json()["detail"]
        told = everything(player, server, running["match"], game)
        assert set(noise_seeds(told)) == {None}
        assert "3.0625" not in json.dumps(told)
    assert "3.0625" not in json.dumps([event.read(), event.read("/standings")])
    event.play_out()
    assert verify_record(organiser.get(f"/v1/games/{game}/record").text.splitlines()).ok
    told = everything(organiser, server, running["match"], game)
    assert None not in noise_seeds(told)
    assert "3.0625" in json.dumps(told)


def test_told_noise_is_revealed_game_by_game(new_table, server):
    table = new_table(games=2, noise={"level": 1.0, "told": True}, seed=None)
    first = table.game
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{first}/concede", version=view["version"]).status_code == 200
    assert mover.get(f"/v1/games/{first}/record").status_code == 200
    (over,) = [message for message in (mover.turn(),) if message["type"] == "game_over"]
    assert over["noise_seed"] is not None
