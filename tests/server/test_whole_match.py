"""Issue 2, points 4 and 5: whole matches over HTTP, the record, and restarts in the middle."""

import signal

import pytest

from referee.record import verify_record

LONG = 1000
"""More strokes than two games can have."""


def records_of(table):
    """The records of a match's games, each verified."""
    match = table.organiser.get(f"/v1/matches/{table.match['id']}").json()
    records = []
    for game in match["played"]:
        response = table.organiser.get(f"/v1/games/{game['id']}/record")
        assert response.headers["content-type"] == "application/x-ndjson"
        verification = verify_record(response.text.splitlines())
        assert verification.ok, verification
        assert verification.outcome.reason == game["outcome"]["reason"]
        records.append(response.text.splitlines())
    return records


def history_of(table, game_id, limit=7):
    """All strokes of a game, page by page."""
    strokes, cursor = [], 0
    while cursor is not None:
        page = table.organiser.get(f"/v1/games/{game_id}/shots", cursor=cursor, limit=limit).json()
        strokes += page["shots"]
        cursor = page["next_cursor"]
    return strokes


def news_of(table, seat):
    """Everything the player was told that is no turn."""
    news = list(table.news[seat])
    while (response := table.players[seat].get("/v1/turns")).status_code == 200:
        news.append(response.json())
    return news


def test_a_match_of_two_games(new_table):
    table = new_table(games=2, seed="0" * 64)
    answers = table.play(LONG, seed=0)
    match = table.organiser.get(f"/v1/matches/{table.match['id']}").json()
    assert match["status"] == "finished"
    assert sum(match["score"]) == 2.0
    records = records_of(table)
    for game, record in zip(match["played"], records, strict=True):
        strokes = history_of(table, game["id"])
        assert strokes == [answer["stroke"] for answer in answers if answer["game"] == game["id"]]
        assert [stroke["index"] for stroke in strokes] == list(range(len(strokes)))
        assert len(record) == len(strokes) + 3
        assert game["strokes"] == sum(stroke["shot"] is not None for stroke in strokes)
    for seat in (0, 1):
        news = news_of(table, seat)
        assert [message["type"] for message in news] == ["game_over", "game_over", "match_over"]
        assert [message["game"] for message in news[:2]] == [game["id"] for game in match["played"]]
        assert news[1]["score"] == news[2]["score"] == match["score"]
        for message, game in zip(news, match["played"], strict=False):
            assert message["outcome"] == game["outcome"]
            assert message["won"] is (game["outcome"]["winner"] == seat)


def test_noise_is_added_at_level_one_and_leaves_every_bit_at_zero(new_table, break_shot):
    noisy, exact = new_table(noise={"level": 1.0}), new_table(noise={"level": 0.0})
    shots = []
    for table in (noisy, exact):
        mover, view = table.mover()
        stroke = mover.act(view, break_shot).json()["stroke"]
        assert stroke["action"]["shot"] == break_shot["shot"]
        shots.append(stroke["shot"])
    assert shots[0] != break_shot["shot"]
    assert shots[1] == break_shot["shot"]


def test_the_view_tells_what_happened_since_the_readers_last_turn(new_table):
    table = new_table()
    answers = table.play(6)
    _, view = table.mover()
    since = view["strokes_since"]
    own = [answer["stroke"]["index"] for answer in answers if answer["stroke"]["seat"] == view["seat"]]
    assert [stroke["index"] for stroke in since] == list(range(own[-1] if own else 0, 6))
    spectator = table.organiser.get(f"/v1/games/{view['game']}").json()["view"]
    assert [stroke["index"] for stroke in spectator["strokes_since"]] == [5]
    assert spectator["seat"] is None


def test_a_running_game_has_no_record_yet(new_table):
    table = new_table()
    response = table.organiser.get(f"/v1/games/{table.game}/record")
    assert (response.status_code, response.json()["code"]) == (409, "game_unfinished")
    assert "noise_seed" not in response.text


def test_nothing_of_a_running_game_shows_its_seed(server, new_table):
    table = new_table(seed="7" * 64)
    answers = table.play(3)
    table.organiser.get("/v1/matches")
    shown = str(answers) + table.organiser.get(f"/v1/games/{table.game}").text
    shown += table.organiser.get(f"/v1/matches/{table.match['id']}").text
    table.organiser.post(f"/v1/matches/{table.match['id']}/abort")
    seed = table.organiser.get(f"/v1/games/{table.game}").json()["noise_seed"]
    assert len(seed) == 64
    assert seed not in shown
    assert "7" * 64 not in shown


@pytest.mark.parametrize("number", [pytest.param(signal.SIGTERM, marks=pytest.mark.slow), signal.SIGKILL])
def test_every_game_continues_after_a_restart(own_server, table_at, number):
    server = own_server()
    table, other = table_at(server), table_at(server)
    answers = table.play(3, seed=0)
    other.play(1)
    waiting = table.organiser.get(f"/v1/games/{table.game}").json()["view"]
    server.restart(number)
    found = table.organiser.get(f"/v1/games/{table.game}").json()["view"]
    for name in ("version", "balls", "turn", "phase", "groups", "commitment", "strokes_since"):
        assert found[name] == waiting[name]
    answers += table.play(2, seed=1)
    server.restart(number)
    answers += table.play(4, seed=2)
    if table.is_running:  # four strokes by chance seldom end a game
        mover, view = table.mover()
        answers.append(mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).json())
    assert not table.is_running
    records_of(table)
    assert history_of(table, table.game) == [answer["stroke"] for answer in answers]
    assert other.play(1)


def test_the_same_seed_and_actions_give_the_same_game(new_table):
    """Noise depends on the seed and the stroke alone: two servers' worth of chance, one course."""
    first, second = (new_table(seed="c" * 64) for _ in range(2))
    strokes = [[answer["stroke"] for answer in table.play(5, seed=9)] for table in (first, second)]
    assert strokes[0] == strokes[1]
