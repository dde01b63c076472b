"""The ladder of a standing server: Weng & Lin's ratings over its rated games, and who is there."""

import time

import pytest

from referee.game import EndReason
from tournament.results import GameResult
from tournament.statistics.ladder import ladder


def concede(table):
    """The mover gives up; who it was."""
    mover, view = table.mover()
    path = f"/v1/games/{view['game']}/concede"
    headers = {"If-Match": f'"{view["version"]}"', "Idempotency-Key": "give up"}
    assert mover.request("POST", path, headers=headers).status_code == 200
    return mover


def test_the_ladder_counts_rated_games_in_their_order_and_says_who_is_there(own_server, table_at, player_at):
    server = own_server()
    assert server.http.get("/v1/ladder").json() == {"rungs": [], "games": 0}
    for rated in (True, False):
        table = table_at(server, rated=rated, seed=None)
        loser = concede(table)
        seat = [player.id for player in table.players].index(loser.id)
        game = server.http.get(f"/v1/matches/{table.match['id']}").json()["played"][0]
        players = (table.players[0].id, table.players[1].id)
        result = GameResult(game["match"], 0, players, game["breaker"], 1 - seat, EndReason.CONCESSION)
        if rated:
            results, table_players = [result], table.players
    stranger = player_at(server)
    shown = wait_for_games(server, 1)
    expected = ladder(results)
    assert shown["games"] == 1
    assert [(one["agent"], one["games"]) for one in shown["rungs"]] == [(one.name, one.games) for one in expected]
    for one, rung in zip(shown["rungs"], expected, strict=True):
        assert (one["mu"], one["sigma"], one["ordinal"]) == pytest.approx(
            (rung.mu, rung.sigma, rung.ordinal), abs=1e-12
        )
    assert [one["rank"] for one in shown["rungs"]] == [1, 2]
    assert stranger.id not in {one["agent"] for one in shown["rungs"]}
    assert not any(one["house"] for one in shown["rungs"])
    here = table_players[0]
    here.turn(wait=0)
    present = {one["agent"]: one["present"] for one in server.http.get("/v1/ladder").json()["rungs"]}
    assert present[here.id]


def wait_for_games(server, games):
    """A ladder is given again for ten seconds."""
    end = time.monotonic() + 120
    while (shown := server.http.get("/v1/ladder").json())["games"] < games:
        assert time.monotonic() < end, shown
        time.sleep(0.2)
    return shown
