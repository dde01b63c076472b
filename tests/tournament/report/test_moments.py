"""Turning points and games to watch (docs/tournaments.md, "Reports"), from records of games that were played."""

import json
import re
from itertools import pairwise
from typing import Any

import pytest
from support.events import by_lot, play, spec_of
from support.short_games import short_game

import pictures
from physics import Shot, Table, TableState
from referee.game import Game
from tournament import Tournament
from tournament.luck import VALUE
from tournament.report import event_report, page, replay, turning_points

NASTY = ("<script>ann</script>", 'bob & "co"')


@pytest.fixture(scope="module")
def records():
    """Of three games, by the names that results give them; two of them on a table with jaws."""
    tables = [Table.olympiad(), Table.nine_foot(), Table.nine_foot()]
    games = [short_game(seed, 9, table, NASTY) for seed, table in enumerate(tables, 1)]
    return {f"games/{number}.jsonl": tuple(game.record()) for number, game in enumerate(games)}


def entries_of(lines):
    return [json.loads(line) for line in lines[1:-2]]


def changes(lines):
    """By a stroke's number: its player's chances before and after, of those that ended nothing and were no break."""
    found = {}
    for before, after in pairwise(entries_of(lines)):
        one, other = (Game.from_dict(each["game"]) for each in (before, after))
        if after["stroke"] is not None and other.outcome is None:
            found[after["stroke"] + 1] = VALUE(one, after["seat"], 1.0), VALUE(other, after["seat"], 1.0)
    return found


def test_the_stroke_of_each_game_that_changed_most_is_told_the_greatest_first(records):
    moments = turning_points(records)
    assert {one.record for one in moments} == set(records)
    sizes = [abs(one.after - one.before) for one in moments]
    assert sizes == sorted(sizes, reverse=True)
    for one in moments:
        expected = changes(records[one.record])
        assert (one.before, one.after) == expected[one.number]
        assert abs(one.after - one.before) == max(abs(after - before) for before, after in expected.values())
        entry = next(each for each in entries_of(records[one.record]) if each["stroke"] == one.number - 1)
        assert one.player == NASTY[entry["seat"]]
        assert one.words.startswith(NASTY[entry["seat"]])
        assert "layer 0" not in one.words
    assert turning_points(records, most=1) == moments[:1]


def test_the_picture_is_that_of_the_stroke_and_of_its_beginning_where_another_engine_played_it(records):
    name, lines = next(iter(records.items()))
    (moment,) = turning_points({name: lines})
    header, entries = json.loads(lines[0]), entries_of(lines)
    place = next(at for at, each in enumerate(entries) if each["stroke"] == moment.number - 1)
    entry, table = entries[place], Table.from_dict(header["table"])
    call = entry["action"]["call"]
    look: dict[str, Any] = {
        "shot": Shot.from_dict(entry["shot"]),
        "call": (call["ball"], call["pocket"]) if isinstance(call, dict) else None,
    }
    before = pictures.svg(TableState.from_dict(entry["before"]), table=table, **look)
    assert moment.picture != before
    assert moment.picture.count("<path") > before.count("<path")
    entry["final"] = entries[0]["before"]
    other = [lines[0], *(json.dumps(each) for each in entries), *lines[-2:]]
    (again,) = turning_points({name: other})
    assert again.picture == before
    assert replay(other) is None, "no page that plays something else"


def test_a_game_is_played_by_a_page_of_its_own(records):
    for lines in records.values():
        text = replay(lines)
        data = re.search(r'id="scenes">(.*?)</script>', text, re.DOTALL)
        strokes = [each for each in entries_of(lines) if each["stroke"] is not None]
        assert len(json.loads(data.group(1))) == len(strokes)
        assert "<script>ann" not in text


def test_a_report_shows_them_and_links_what_can_be_watched(records):
    event = play(Tournament(spec_of(2, pairs=2)), by_lot(3))
    names = [*records, ""]
    results = [event.results[place].to_dict() | {"record": name} for place, name in enumerate(names)]
    event = Tournament(event.spec).with_results(*(type(event.results[0]).from_dict(each) for each in results))
    moments = turning_points(records)
    data = event_report(event, moments=moments, replays={moments[0].record: "replays/0.html"})
    assert data["moments"] == [one.to_dict() for one in moments]
    text = page(data)
    assert text.count("<figure>") == len(moments)
    assert "<script>ann" not in text
    assert text.count('href="replays/0.html"') == 2, "beside its picture and in the list of games"
    assert all(f'href="{name}"' in text for name in records)
    assert "Round 1, pair 1, first game" in text
    assert "Round 1, pair 2, second game" in text
