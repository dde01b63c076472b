"""What a crash leaves behind (docs/operations.md, "Crash safety"): `kill -9` at every step of a shot, and at random
under load. No acknowledged shot is lost, none is applied twice, every game goes on, every record verifies.
"""

import itertools
import json
import random
import signal
import threading
import time
import uuid
from typing import Any

import httpx2
import pytest

from referee.record import verify_record
from server.errors import SettingsError
from server.failpoints import POINTS, parse

ANSWERS_WITHIN = 90.0
"""Seconds for a server to come up again on a busy machine."""
TERMS = {"games": 100, "noise": {"level": 1.0}, "clock": {"seconds": 3600}}


def insist(send):
    """Send until there is an answer: what the SDK does, with shorter pauses."""
    end = time.monotonic() + ANSWERS_WITHIN
    while True:
        try:
            response = send()
        except httpx2.TransportError:
            response = None
        if response is not None and response.status_code != 503:
            return response
        assert time.monotonic() < end, "no server answers any more"
        time.sleep(0.02)


def revive(server):
    """Start the server anew after its death, its clients left as they are."""
    server.process.wait()
    server.process.stdout.close()
    clients = server.http
    server.start()
    server.http.close()
    server.http = clients


class Hands:
    """Both players of a match, who insist on an answer to everything, and keep what was acknowledged."""

    def __init__(self, table, script, seed):
        self.table, self.script = table, script
        self.chance = random.Random(seed)
        self.acknowledged = []
        """For every stroke the request, to be sent again, and the answer."""

    def stroke(self):
        """Play one stroke."""
        while True:
            for player in self.table.players:
                message = insist(lambda player=player: player.get("/v1/turns"))
                if message.status_code == 200 and (body := message.json())["type"] == "turn":
                    return self.act(player, body["view"])

    def act(self, player, view):
        action, key = self.script(view, self.chance), str(uuid.uuid4())

        def send():
            return player.act(view, action, key=key)

        answer = insist(send)
        assert answer.status_code in (200, 422), answer.text
        if answer.status_code == 200:
            self.acknowledged.append((send, answer))

    def strokes(self):
        """What was acknowledged, by game."""
        answers = [answer.json() for _, answer in self.acknowledged]
        by_game = itertools.groupby(answers, key=lambda answer: answer["game"])
        return {game: [answer["stroke"] for answer in group] for game, group in by_game}

    def check(self, latest=3):
        """Every acknowledged stroke is stored once, in its place; an answer is given again byte for byte.

        Looks at the latest strokes alone: `end` looks at all of them.
        """
        if not self.acknowledged:
            return
        game, acknowledged = list(self.strokes().items())[-1]
        first = max(0, len(acknowledged) - latest)
        assert history(self.table, game, first) == acknowledged[first:]
        send, answer = self.acknowledged[-1]
        assert insist(send).content == answer.content

    def end(self):
        """Call the match off: every record verifies, and holds what was acknowledged and nothing else."""
        match = insist(lambda: self.table.organiser.post(f"/v1/matches/{self.table.match['id']}/abort", key="end"))
        acknowledged = self.strokes()
        for game in match.json()["played"]:
            lines = insist(lambda game=game: self.table.organiser.get(f"/v1/games/{game['id']}/record"))
            assert verify_record(lines.text.splitlines()).ok
            moves = [line for line in map(json.loads, lines.text.splitlines()) if line["type"] == "stroke"]
            assert [move["entry"] for move in moves] == list(range(len(moves)))
            assert history(self.table, game["id"]) == acknowledged.get(game["id"], [])


def history(table, game, cursor=0):
    """The strokes of a game, all pages."""
    strokes: list[Any] = []
    while cursor is not None:
        path = f"/v1/games/{game}/shots"
        page = insist(lambda path=path, cursor=cursor: table.organiser.get(path, cursor=cursor, limit=200)).json()
        strokes, cursor = strokes + page["shots"], page["next_cursor"]
    return strokes


@pytest.mark.slow
@pytest.mark.parametrize("group_commit", ["false", "true"])
def test_killed_at_every_step_of_a_shot(own_server, table_at, script, group_commit):
    """One match with a crash at each step in turn is, in the end, the match that is played without any."""
    server = own_server(POOLIAD_FAILPOINT=f"{POINTS[0]}:3", POOLIAD_GROUP_COMMIT=group_commit)
    hands = Hands(table_at(server, seed="a" * 64, **TERMS), script, seed=5)
    left, deaths = [*POINTS[1:], ""], []

    def keep():
        for following in left:
            server.process.wait()
            deaths.append(server.process.returncode)
            server.environment["POOLIAD_FAILPOINT"] = following and f"{following}:2"
            revive(server)

    keeper = threading.Thread(target=keep)
    keeper.start()
    while keeper.is_alive():
        hands.stroke()
    keeper.join()
    hands.stroke()
    assert deaths == [-signal.SIGKILL] * len(POINTS)
    hands.check()
    calm = Hands(table_at(server, seed="a" * 64, **TERMS), script, seed=5)
    while len(calm.acknowledged) < len(hands.acknowledged):
        calm.stroke()
    assert list(calm.strokes().values()) == list(hands.strokes().values())
    hands.end()


@pytest.mark.slow
@pytest.mark.parametrize("group_commit", ["false", "true"])
@pytest.mark.parametrize("kills", [10, pytest.param(200, marks=pytest.mark.long)])
def test_killed_at_random_under_load(own_server, table_at, script, kills, group_commit):
    server = own_server(POOLIAD_GROUP_COMMIT=group_commit)
    load = [Hands(table_at(server, **TERMS), script, seed) for seed in range(4)]
    stop, chance = threading.Event(), random.Random(kills)
    faults = []

    def work(hands):
        try:
            while not stop.is_set():
                hands.stroke()
        except BaseException as fault:  # shown by the main thread
            faults.append(fault)

    for _ in range(kills):
        workers = [threading.Thread(target=work, args=(hands,)) for hands in load]
        for worker in workers:
            worker.start()
        time.sleep(chance.uniform(0.05, 0.8))
        server.process.send_signal(signal.SIGKILL)
        revive(server)
        stop.set()
        for worker in workers:
            worker.join()
        stop.clear()
        assert not faults, faults[0]
        for hands in load:
            hands.check()
    strokes = sum(len(hands.acknowledged) for hands in load)
    assert strokes > kills, "there was a load"
    for hands in load:
        hands.stroke()  # every game goes on
        hands.end()


@pytest.mark.parametrize("text", ["shot", "shot-kept:0", "shot-kept:x", "shot-kept:-1", ":1"])
def test_a_step_that_there_is_not_is_named_at_the_start(text):
    with pytest.raises(SettingsError, match="shot-admitted"):
        parse(text)


def test_nothing_dies_unless_the_environment_says_so():
    """No header, no field and no path names a step: only the text given at the start does."""
    reach = parse("")
    for point in POINTS:
        reach(point)
