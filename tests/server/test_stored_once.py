"""A stroke is stored once, as the line of its record; views and histories say of it what they always said."""

import json
import random
from collections import Counter
from dataclasses import replace

import pytest
from sqlalchemy import select, update

from protocol import StrokeDetail
from server.services.play import live_game, stored_strokes
from server.store.database import Database
from server.store.tables import answers, moves


@pytest.fixture
def database(server):
    made = Database(server.database_url)
    yield made
    made.dispose()


def rows_of(database, game):
    with database.reading() as connection:
        return connection.execute(select(moves).where(moves.c.game_id == game).order_by(moves.c.number)).all()


def test_a_stroke_is_its_line(new_table, database):
    table = new_table(clock={"seconds": 3600.0})
    answered = table.play(12)
    rows = rows_of(database, table.game)
    assert [row.stroke for row in rows] == [None] * len(answered)
    assert [row.line for row in rows] == [""] * len(answered)
    told = [StrokeDetail.of_entry(json.loads(stored_strokes.line(row))).model_dump_json() for row in rows]
    assert [json.loads(each) for each in told] == [answer["stroke"] for answer in answered]


def test_a_turn_shows_the_strokes_that_the_database_has(new_table, database, script):
    """The server remembers a game's latest strokes, and shows what it would read."""
    table, chance = new_table(clock={"seconds": 3600.0}), random.Random(4)
    lengths: Counter[int] = Counter()
    for _ in range(24):
        mover, view = table.mover()
        with database.reading() as connection:
            stored = live_game.strokes_since(connection, view["game"], view["seat"])
        assert view["strokes_since"] == [json.loads(stroke.model_dump_json()) for stroke in stored]
        lengths[len(stored)] += 1
        mover.act(view, script(view, chance))
    assert len(lengths) > 2, "nobody stayed at the table"


def test_strokes_that_are_not_known_are_read(new_table, database, script):
    """As after a restart, or where another process had the game until now."""
    table, chance = new_table(clock={"seconds": 3600.0}), random.Random(4)
    table.play(6)
    with database.reading() as connection:
        cold = live_game.find(connection, table.game)
        for seat in (0, 1, None):
            assert cold.view(connection, seat, 0).strokes_since == live_game.strokes_since(connection, cold.id, seat)
    for _ in range(4):
        mover, view = table.mover()
        mover.act(view, script(view, chance))
        with database.reading() as connection:
            stored = live_game.find(connection, cold.id)
            last = live_game.strokes_since(connection, cold.id, None)
            cold = replace(cold.with_stroke(*last), row=stored.row)
            for seat in (0, 1, None):
                told = cold.view(connection, seat, 0).strokes_since
                assert told == tuple(live_game.strokes_since(connection, cold.id, seat))


def test_rows_of_version_0_1_0_are_read_beside_new_ones(new_table, database):
    """They hold what players are told, too; that is what is shown then."""
    table = new_table(clock={"seconds": 3600.0})
    table.play(3)
    game = f"/v1/games/{table.game}"
    paths = (f"{game}/shots", f"{game}/shots/0.svg")
    before = [table.organiser.get(path).text for path in paths]
    views = [player.get(game).json()["view"]["strokes_since"] for player in table.players]
    with database.writing() as connection:
        for row in rows_of(database, table.game)[:2]:
            line = stored_strokes.line(row)
            stroke = StrokeDetail.of_entry(json.loads(line)).model_dump(mode="json", exclude={"events"})
            old = {"stroke": stroke, "line": line, "packed": None}
            connection.execute(update(moves).where(moves.c.sequence == row.sequence).values(old))
    assert [table.organiser.get(path).text for path in paths] == before
    assert [player.get(game).json()["view"]["strokes_since"] for player in table.players] == views


def test_answers_are_kept_as_bytes(new_table, database, break_shot):
    """Never put together anew: a repetition has the bytes of the first, whatever this release would say."""
    mover, view = new_table().mover()
    first = mover.act(view, break_shot, key="kept")
    with database.writing() as connection:
        this = (answers.c.caller == mover.id) & (answers.c.key == "kept")
        assert connection.scalar(select(answers.c.body).where(this)) == first.content
        connection.execute(update(answers).where(this).values(body=b"{}"))
    assert mover.act(view, break_shot, key="kept").content == b"{}"


def test_a_stroke_of_very_many_events_has_its_summary_beside_it(new_table, database, break_shot, monkeypatch):
    """To read megabytes for a summary would make every view dear: the line of such a stroke is not looked at."""
    mover, view = new_table().mover()
    answered = mover.act(view, break_shot).json()["stroke"]
    (row,) = rows_of(database, view["game"])
    summary = {name: value for name, value in answered.items() if name != "events"}
    with database.writing() as connection:
        this = moves.c.sequence == row.sequence
        connection.execute(update(moves).where(this).values(stroke=summary, packed=b"no line"))
        found = connection.execute(select(*stored_strokes.SUMMED).where(this)).one()
    assert found.packed is None
    assert stored_strokes.view(found).model_dump(mode="json") == {
        name: answered[name] for name in summary if name not in ("before", "final")
    }
