"""The best strokes of the games that ended last: chances are those of the luck report, `tournament.luck.VALUE`."""

import json
from itertools import pairwise

import pytest
from support.players import Potter

from protocol import ShotRequest, View
from referee.game import Game
from tournament.luck import VALUE


def conceded(table, strokes):
    """The id of a game between players who aim at ghost balls; it has at most ``strokes`` strokes."""
    game, potter = table.game, Potter("ann")
    while strokes and table.is_running:
        mover, view = table.mover()
        action, strokes = potter(View.model_validate(view)), strokes - 1
        made = {"decision": action.decision} if action.decision else ShotRequest.of(action).model_dump(mode="json")
        assert mover.act(view, made).status_code == 200
    if table.is_running:
        mover, view = table.mover()
        assert mover.post(f"/v1/games/{game}/concede", version=view["version"]).status_code == 200
    return game


def gains(server, game, noise):
    """What every stroke that made its ball but not the game changed for its player, by number."""
    lines = [json.loads(line) for line in server.request("GET", f"/v1/games/{game}/record").text.splitlines()]
    entries = [line for line in lines if "entry" in line]
    found = {}
    for before, after in pairwise(entries):
        games = [Game.from_dict(each["game"]) for each in (before, after)]
        if after["ruling"]["made"] and games[1].outcome is None:
            one, other = (VALUE(each, after["seat"], noise) for each in games)
            found[after["entry"]] = (other - one, one, other)
    return found


@pytest.mark.parametrize("told", [True, False], ids=["told", "untold"])
def test_the_best_stroke_of_a_game_is_where_its_players_chance_rose_most(server, new_table, told):
    """A level that is not told would tell itself by the chances: they are those without noise."""
    table = new_table(noise={"level": 1.0, "told": told})
    game = conceded(table, 20)
    expected = gains(server, game, 1.0 if told else 0.0)
    number = max(expected, key=lambda each: expected[each][0])
    listed = server.request("GET", "/v1/best-strokes").json()["strokes"]
    (shown,) = [one for one in listed if one["game"] == game]
    assert expected[number][0] > 0
    assert (shown["number"], shown["match"]) == (number, table.match["id"])
    assert (shown["before"], shown["after"]) == pytest.approx(expected[number][1:], abs=1e-12)
    assert shown["players"] == table.match["players"]
    assert server.request("GET", f"/v1/games/{game}/shots/{number}.svg").status_code == 200
    assert [one["after"] - one["before"] for one in listed] == sorted(
        (one["after"] - one["before"] for one in listed), reverse=True
    )


def test_games_that_go_on_or_were_called_off_or_have_no_good_stroke_have_none(server, new_table):
    going_on, called_off, empty = new_table(), new_table(), new_table()
    ids = [going_on.game, called_off.game, conceded(empty, 0)]
    going_on.play(2)
    called_off.play(2)
    assert called_off.organiser.post(f"/v1/matches/{called_off.match['id']}/abort").status_code == 200
    listed = server.request("GET", "/v1/best-strokes").json()["strokes"]
    assert not {one["game"] for one in listed} & set(ids)
