"""`run_agent` on a real server: matches to their end, misbehaving agents, lost replies."""

import logging
import threading
from typing import Any, ClassVar

import httpx2
import pytest

import client
import physics
from client.run import run_agent
from protocol import TURN_MESSAGE, MatchOver

BREAK = client.Action(shot=physics.Shot(9.0, 270.0, 5.0), cue_ball=(0.558, 1.75))
CONCEDE = client.Action(decision=client.Decision.CONCEDE)


class Conceding(client.Agent):
    """Gives up at once."""

    def choose(self, view):
        return CONCEDE


class Diary(client.Agent):
    """Breaks where it can, gives up where it cannot, and keeps what it was told."""

    seen: ClassVar[list[Any]] = []

    def __init__(self):
        self.mine: list[Any] = []
        self.seen.append(self.mine)

    def game_started(self, view):
        self.mine.append(("started", view.number))

    def choose(self, view):
        self.mine.append("choose")
        return BREAK if view.phase == "break" else CONCEDE

    def game_over(self, over):
        self.mine.append(("over", over.number, over.won))


def play_out(hall, first, second, games=1, **first_options):
    """Both agents on the server until the match is over; what the first was told."""
    entries = hall.register("one"), hall.register("two")
    hall.match(*entries, games=games)
    opponent = threading.Thread(target=run_agent, args=(second, hall.url, entries[1].token))
    opponent.start()
    over = run_agent(first, hall.url, entries[0].token, **first_options)
    opponent.join(30)
    assert not opponent.is_alive()
    return over


def test_one_instance_a_game_and_every_hook_once(hall):
    Diary.seen = []
    over = play_out(hall, Diary, Conceding, games=3)
    assert isinstance(over, MatchOver)
    assert over.status == "finished"
    assert sum(over.score) == 3.0
    for number, mine in zip((0, 2), (diary for diary in Diary.seen if len(diary) > 2), strict=False):
        assert mine[0] == ("started", number)
        assert mine[-1][:2] == ("over", number)
    told = [entry for mine in Diary.seen for entry in mine if entry[0] == "over"]
    assert len(told) == len(Diary.seen) == len({entry[1] for entry in told})


def test_two_random_agents_reach_an_end_by_the_rules(hall):
    entries = hall.register("one"), hall.register("two")
    match = hall.match(*entries, seed=5)
    threads = [
        threading.Thread(target=run_agent, args=(client.load("random", seed=5), hall.url, entry.token))
        for entry in entries
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(120)
    (game,) = hall.organiser.match(match.id).played
    assert game.status == "finished"
    assert game.outcome.rule in {"R42", "R43", "R44", "R45", "R46", "R49"}


def test_faults_are_logged_and_the_agent_is_asked_again(hall, caplog):
    """Issue 2, point 6: raises, returns nonsense, is refused: the reason in the log, another try."""
    answers = iter(
        [
            ZeroDivisionError("in my own code"),
            "270 degrees, please",
            client.Action(shot=physics.Shot(9.0, 270.0, 5.0), cue_ball=(0.558, 0.3)),
            CONCEDE,
        ]
    )

    class Clumsy(client.Agent):
        def choose(self, view):
            answer = next(answers)
            if isinstance(answer, Exception):
                raise answer
            return answer

    with caplog.at_level(logging.ERROR, "pooliad.agent"):
        over = play_out(hall, Clumsy, Conceding)
    assert over.winner == 1
    raised, nonsense, refused = (record for record in caplog.records if record.name == "pooliad.agent")
    assert "in my own code" in raised.exc_text
    assert "270 degrees, please" in nonsense.getMessage()
    assert "cue_ball" in refused.getMessage()


def test_a_turn_played_by_somebody_else_is_read_again(hall):
    """412: the same agent in two places, one of them too late."""
    entries = hall.register("one"), hall.register("two")
    hall.match(*entries)
    calls = []

    class Late(client.Agent):
        def choose(self, view):
            calls.append(view.version)
            if len(calls) == 1:
                with client.Pooliad(hall.url, entries[0].token) as twin:
                    twin.play(view.game, view.version, BREAK)
                return BREAK
            return CONCEDE

    opponent = threading.Thread(target=run_agent, args=(Conceding, hall.url, entries[1].token))
    opponent.start()
    over = run_agent(Late, hall.url, entries[0].token)
    opponent.join(30)
    assert over.status == "finished"
    assert len(set(calls)) == len(calls), "no view was answered twice"


class Losing(httpx2.BaseTransport):
    """A network that delivers every request and loses chosen replies."""

    def __init__(self, loses):
        self._inner = httpx2.HTTPTransport()
        self._loses = loses
        self.lost = []

    def handle_request(self, request):
        response = self._inner.handle_request(request)
        response.read()
        if self._loses(request, response):
            self.lost.append(request.url.path)
            raise httpx2.ReadError("the reply was lost", request=request)
        return response

    def close(self):
        self._inner.close()


def test_a_stroke_whose_reply_is_lost_is_played_once(hall):
    first_tries = set()

    def loses(request, _response):
        key = request.headers.get("Idempotency-Key")
        if key is None or key in first_tries:
            return False
        first_tries.add(key)
        return True

    Diary.seen = []
    network = Losing(loses)
    over = play_out(hall, Diary, Conceding, transport=network)
    assert over.status == "finished"
    assert network.lost
    choices = [entry for mine in Diary.seen for entry in mine].count("choose")
    assert choices == len(network.lost), "every stroke was chosen once, sent twice, played once"


def test_the_end_is_found_although_its_message_was_lost(hall, monkeypatch):
    """The server tells the end of a match once; whoever misses it asks how the match stands."""
    monkeypatch.setattr("client.run.POLL", 0.2)

    def loses(_request, response):
        if response.status_code != 200 or b'"match_over"' not in response.content[:30]:
            return False
        return isinstance(TURN_MESSAGE.validate_json(response.content), MatchOver)

    network = Losing(loses)
    over = play_out(hall, Conceding, Conceding, transport=network)
    assert network.lost == ["/v1/turns"]
    assert over.status == "finished"
    assert over.winner == 1


def test_old_news_does_not_end_the_next_match(hall):
    """An agent that was away when its first match ended hears of it after its second has begun."""
    entries = hall.register("one"), hall.register("two")
    old = hall.match(*entries)
    hall.organiser.abort(old.id)
    new = hall.match(*entries, seed=80)
    overs: list[Any] = [None, None]

    def play(seat):
        overs[seat] = run_agent(Conceding, hall.url, entries[seat].token)

    threads = [threading.Thread(target=play, args=(seat,)) for seat in (0, 1)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(30)
    assert overs[0].match == new.id, "seat 0 breaks: it has played in the new match"
    assert overs[1].match in (old.id, new.id)
    assert hall.organiser.match(new.id).status == "finished"


def test_news_of_a_match_ends_the_run_when_nothing_is_left_to_play(hall):
    entries = hall.register("one"), hall.register("two")
    match = hall.match(*entries)
    hall.organiser.abort(match.id)
    over = run_agent(Conceding, hall.url, entries[0].token)
    assert (over.match, over.status) == (match.id, "aborted")


def test_a_wrong_token_is_an_error_at_once(hall):
    with pytest.raises(client.PooliadError, match="unauthorized"):
        run_agent(Conceding, hall.url, "pool_agt_wrong")
