"""Issue, "Tests": scripted bad agents against a real server, each opposite a player that only wants to play.

However an agent behaves: nobody is answered with a fault, the opponent's game goes on, the bad agent alone pays for its
time, and the record verifies.
"""

import json
import random
import socket
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from referee.record import PublicKey, verify_record

SECOND = 10**9
IMPATIENT = {
    "POOLIAD_FETCH_GRACE": "0.2",
    "POOLIAD_NO_SHOW_SECONDS": "5",
    "POOLIAD_BODY_SECONDS": "0.5",
    "POOLIAD_TIMER_PERIOD": "0.05",
}
"""A server on which nobody has to be waited for long."""


@pytest.fixture(scope="module")
def arena(new_running, tmp_path_factory):
    """The server of the bad agents."""
    return new_running(f"sqlite:///{tmp_path_factory.mktemp('bad') / 'pooliad.db'}", **IMPATIENT)


class Duel:
    """A match between an agent that behaves badly, in seat 0, and one that does not."""

    def __init__(self, table, script):
        self.table, self.script, self.chance = table, script, random.Random(7)
        self.bad, self.good = table.players
        self.answers = []

    @property
    def view(self):
        """The running game as spectators see it."""
        return self.table.organiser.get(f"/v1/games/{self.table.game}").json()["view"]

    def to_the_bad_one(self):
        """Let the good player play until it is the other's turn; the view delivered for it."""
        while True:
            mover, view = self.table.mover()
            if mover is self.bad:
                return view
            self.good_stroke(view)

    def good_stroke(self, view):
        answer = self.good.act(view, self.script(view, self.chance))
        assert answer.status_code in (200, 422), answer.text

    def bad_stroke(self, view, **options):
        """What the script would play, from the bad agent; noted."""
        while (answer := self.bad.act(view, self.script(view, self.chance), **options)).status_code == 422:
            pass
        self.answers.append(answer)
        return answer

    def end(self, patience=30.0):
        """Wait for the end of the game without doing anything for it; how it ended."""
        deadline = time.monotonic() + patience
        while self.table.is_running:
            assert time.monotonic() < deadline, "the game does not end"
            time.sleep(0.02)
        return self.outcome()

    def conceded(self):
        """End the game by concession; how it ended."""
        mover, view = self.table.mover()
        assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
        return self.outcome()

    def outcome(self):
        self.record()
        outcome = self.table.organiser.get(f"/v1/games/{self.table.game}").json()["outcome"]
        return outcome["winner"], outcome["reason"]

    def record(self):
        """The record, verified: signature, chain, every stroke; every accepted stroke of the bad agent is in it."""
        keys = self.table.organiser.get("/v1/keys").json()["keys"]
        trusted = [PublicKey(bytes.fromhex(key["public_key"])) for key in keys]
        lines = self.table.organiser.get(f"/v1/games/{self.table.game}/record").text.splitlines()
        found = verify_record(lines, trusted)
        assert found.ok, str(found)
        entries = [json.loads(line) for line in lines[1:-2]]
        for answer in self.answers:
            if answer.status_code == 200:
                stroke = answer.json()["stroke"]
                kept = entries[stroke["index"]]
                assert (kept["seat"], kept["stroke"]) == (0, stroke["stroke"])
                assert kept.get("shot") == stroke["shot"]
        return entries


@pytest.fixture
def duel(arena, table_at, script):
    def make(seconds=60.0, **terms):
        terms = {"first_breaker": 0, "noise": {"level": 1.0}, "clock": {"seconds": seconds}} | terms
        return Duel(table_at(arena, **terms), script)

    return make


@pytest.fixture(autouse=True)
def no_fault(arena):
    """No request of anybody may be answered with a fault."""
    before = arena.log.count("fault while answering")
    yield
    assert arena.log.count("fault while answering") == before, arena.log[-3000:]


def test_one_that_crashes_loses_on_time(duel):
    """It fetches its turn and is never heard of again."""
    match = duel(seconds=0.5)
    match.to_the_bad_one()
    assert match.end() == (1, "time_out")


def test_one_that_never_comes_is_no_show(duel):
    match = duel()
    assert match.end() == (1, "no_show")
    assert match.good.turn()["won"] is True


def test_one_that_stalls_loses_on_time_however_often_it_asks(duel):
    """Redelivery does not start the clock anew."""
    match = duel(seconds=0.6)
    match.to_the_bad_one()
    asked = 0
    while match.table.is_running:
        asked += match.bad.get("/v1/turns", wait=0).status_code == 200
    assert asked > 3
    assert match.outcome() == (1, "time_out")


def test_one_whose_body_never_comes_is_not_waited_for(arena, duel):
    """Byte by byte, beyond the body's time: 408, on its own clock, while others are served."""
    match, other = duel(seconds=3.0), duel()
    other.to_the_bad_one()
    view = match.to_the_bad_one()
    with socket.create_connection(("127.0.0.1", arena.port), timeout=30) as connection:
        head = (
            f"POST /v1/games/{view['game']}/shots HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"
            f'Authorization: Bearer {match.bad.token}\r\nIdempotency-Key: slow\r\nIf-Match: "{view["version"]}"\r\n'
            "Content-Length: 500\r\n\r\n"
        )
        connection.sendall(head.encode())
        started = time.monotonic()
        served = 0
        while time.monotonic() - started < 0.4:
            connection.sendall(b" ")
            served += arena.request("GET", f"/v1/games/{other.table.game}").status_code == 200
            time.sleep(0.02)
        answer = connection.recv(1000).decode()
    assert served > 0
    assert answer.startswith("HTTP/1.1 408 ")
    assert match.end() == (1, "time_out")
    other.conceded()


def test_one_that_does_not_read_its_answers_loses_on_time_like_everybody(arena, duel):
    """A stroke sent again behind an answer that nobody reads is answered, and holds no flag back."""
    match = duel(seconds=3.0)
    view = match.to_the_bad_one()
    stroke = json.dumps({"shot": {"v": 3.0, "phi": 270.0, "theta": 5.0, "a": 0.0, "b": 0.0}}).encode()
    assert send_raw(match.bad, view, stroke).status_code == 200
    match.to_the_bad_one()
    shots = [{"v": 1.0, "phi": 270.0, "theta": 10.0, "a": 0.0, "b": 0.0}] * 10_000
    batch = json.dumps({"balls": {str(n): [0.1 + 0.06 * n, 1.7] for n in range(16)}, "shots": shots}).encode()
    with socket.socket() as connection:
        connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        connection.connect(("127.0.0.1", arena.port))
        connection.sendall(request(match.bad, "/v1/simulate/batch", batch))
        connection.sendall(request(match.bad, f"/v1/games/{view['game']}/shots", stroke))
        assert match.end() == (1, "time_out")


def request(player, path, body):
    """As `send_raw` sends it, as bytes."""
    head = (
        f'POST {path} HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nIf-Match: "1"\r\n'
        f"Authorization: Bearer {player.token}\r\nIdempotency-Key: raw\r\nContent-Length: {len(body)}\r\n\r\n"
    )
    return head.encode() + body


def test_one_that_sends_everything_many_times_plays_everything_once(duel):
    match = duel()
    for turn in range(3):
        view = match.to_the_bad_one()
        action, key = match.script(view, match.chance), f"turn {turn}"
        with ThreadPoolExecutor(6) as pool:
            sent = [pool.submit(match.bad.act, view, action, key=key) for _ in range(6)]
            answers = [one.result() for one in sent]
        assert len({(answer.status_code, answer.content) for answer in answers if answer.status_code == 200}) <= 1
        if answers[0].status_code == 422:
            match.bad_stroke(view)
    match.conceded()
    numbers = [entry["entry"] for entry in match.record()]
    assert numbers == list(range(len(numbers)))


def test_two_workers_with_one_token_are_one_player(duel):
    """Both fetch each turn and play their own idea of it: one is accepted, the other is told that the game moved on."""
    match = duel()
    for _ in range(4):
        view = match.to_the_bad_one()
        ideas = [match.script(view, random.Random(worker)) for worker in range(2)]
        with ThreadPoolExecutor(2) as pool:
            answers = list(pool.map(lambda idea, view=view: match.bad.act(view, idea), ideas))
        match.answers += answers
        assert {answer.status_code for answer in answers} <= {200, 409, 412, 422}
        assert sum(answer.status_code == 200 for answer in answers) <= 1
        if all(answer.status_code == 422 for answer in answers):
            match.bad_stroke(view)
    match.conceded()


def test_one_that_plays_the_others_turns_moves_nothing(duel):
    match = duel()
    view = match.to_the_bad_one()
    while match.bad_stroke(view).json()["view"]["turn"] == 0:
        view = match.to_the_bad_one()
    before = match.view
    for version in (before["version"], before["version"] - 1, before["version"] + 1):
        stolen = before | {"version": version}
        answer = match.bad.act(stolen, match.script(before, match.chance))
        assert answer.status_code in (409, 412)
        assert answer.json()["code"] in ("not_your_turn", "stale_version")
    after = match.view
    for volatile in ("clocks",):
        before.pop(volatile), after.pop(volatile)
    assert after == before
    match.conceded()


def test_one_that_asks_again_gets_no_fresh_noise(duel):
    """The historical server drew noise again for a shot sent again: here the stroke stands, its noise with it."""
    match = duel(noise={"level": 5.0})
    view = match.to_the_bad_one()
    first = match.bad_stroke(view)
    action = first.json()["stroke"]["action"]
    again = {"shot": action["shot"], "call": action["call"], "cue_ball": action["cue_ball"]}
    for key in ("another", "and another"):
        answer = match.bad.act(view, again, key=key)
        assert (answer.status_code, answer.json()["code"]) == (412, "stale_version")
    assert match.view["stroke"] == view["stroke"] + 1
    match.conceded()
    assert [entry["stroke"] for entry in match.record()].count(view["stroke"]) == 1


NO_NUMBERS = ["NaN", "Infinity", "-Infinity", "1e999", "-1e999", "null", '"3"', "[3]", "{}", "true", "1" * 400]


def test_one_that_sends_no_numbers_is_told_which(duel):
    """Every one of them costs its sender time and nothing else."""
    match = duel()
    view = match.to_the_bad_one()
    for text in NO_NUMBERS:
        for name in ("v", "theta"):
            shot = {"v": 3.0, "phi": 270.0, "theta": 20.0, "a": 0.0, "b": 0.0}
            body = json.dumps({"shot": shot, "call": None, "cue_ball": [0.558, 1.8]})
            answer = send_raw(match.bad, view, body.replace(f'"{name}": {shot[name]}', f'"{name}": {text}'))
            assert answer.status_code in (400, 422), (text, answer.text)
            assert answer.json()["field"] in (f"shot.{name}", "body"), (text, answer.text)
    assert match.view["version"] == view["version"]
    match.bad_stroke(view)
    match.conceded()


def send_raw(player, view, body):
    headers = {"Content-Type": "application/json", "Idempotency-Key": "raw", "If-Match": f'"{view["version"]}"'}
    return player.request("POST", f"/v1/games/{view['game']}/shots", content=body, headers=headers)


@pytest.mark.parametrize(
    "body",
    [
        "[" * 900_000,
        '{"shot":' * 100_000,
        '{"shot": ' + "[" * 100_000 + "]" * 100_000 + "}",
        json.dumps({"shot": {str(key): key for key in range(100_000)}}),
        json.dumps({"shot": list(range(250_000))}),
        '{"shot": "' + "x" * 1_900_000 + '"}',
        '{"shot": {"v": ' + "9" * 1_900_000 + "}}",
        "\ufeff{}",
    ],
    ids=["open", "nested", "deep", "keys", "array", "text", "digits", "mark"],
)
def test_one_that_sends_huge_json_is_refused_in_words(duel, body):
    """The answer is short, and whoever else asks is answered."""
    match = duel()
    view = match.to_the_bad_one()
    answer = send_raw(match.bad, view, body.encode())
    assert answer.status_code in (400, 413, 422), answer.text[:300]
    assert len(answer.content) < 20_000
    assert match.view["version"] == view["version"]
    match.conceded()


@pytest.mark.parametrize(
    "lie",
    [
        {"elapsed": 0},
        {"elapsed_ns": 0},
        {"seconds_left": 9999.0},
        {"clocks": [{"seconds_left": 9999.0, "running": False}] * 2},
        {"arrived": 0},
    ],
    ids=lambda lie: next(iter(lie)),
)
def test_one_that_lies_about_its_time_in_the_body_is_refused(duel, lie):
    """Historical: clients reported their own thinking time. Here there is no such field."""
    match = duel()
    view = match.to_the_bad_one()
    answer = match.bad.act(view, match.script(view, match.chance) | lie)
    assert answer.status_code == 422
    assert answer.json()["field"].startswith(next(iter(lie)))
    match.conceded()


def test_one_that_lies_about_its_time_in_headers_pays_what_the_server_measured(duel):
    """Dates of its own move no clock but the server's, beyond the lag that the ledger shows."""
    match = duel()
    view = match.to_the_bad_one()
    fetched = time.monotonic()
    time.sleep(0.4)
    lies = {"Date": "Thu, 01 Jan 1970 00:00:00 GMT", "X-Elapsed": "0", "Age": "-100", "X-Request-Start": "t=0"}
    headers = {"Idempotency-Key": "liar", "If-Match": f'"{view["version"]}"'} | lies
    body = match.script(view, match.chance)
    verb = "decisions" if "decision" in body else "shots"
    answer = match.bad.request("POST", f"/v1/games/{view['game']}/{verb}", json=body, headers=headers)
    taken = time.monotonic() - fetched
    assert answer.status_code == 200, answer.text
    left = match.view["clocks"]
    assert left[1]["seconds_left"] == 60.0
    used = 60.0 - left[0]["seconds_left"]
    assert 0.4 - 0.05 - 1e-6 <= used <= taken + 0.5
    match.conceded()


def test_one_that_is_refused_again_and_again_is_ended_by_its_clock_and_by_nothing_else(duel):
    """Refusals are on the clock of who causes them; none is a 429."""
    match = duel(seconds=1.5)
    view = match.to_the_bad_one()
    outside = {
        "shot": {"v": 3.0, "phi": 270.0, "theta": 20.0, "a": 0.0, "b": 0.0},
        "call": None,
        "cue_ball": [9.0, 9.0],
    }
    codes = []
    while match.table.is_running:
        codes.append(match.bad.act(view, outside).status_code)
    assert codes.count(422) > 5
    assert set(codes) <= {422, 409}
    assert match.outcome() == (1, "time_out")


def test_bad_agents_together_do_not_disturb_a_good_match(arena, duel, table_at):
    """Six kinds of nonsense at once, and beside them a match is played."""
    matches = [duel(seconds=20.0) for _ in range(3)]
    views = [match.to_the_bad_one() for match in matches]
    stop = threading.Event()

    def rave(match, view, chance):
        while not stop.is_set():
            body = chance.choice(["[" * 50_000, "{}", '{"shot": NaN}', "", "null", '{"decision": "concede"}' * 100])
            answer = send_raw(match.bad, view, body)
            assert answer.status_code < 500, answer.text

    threads = [
        threading.Thread(target=rave, args=(match, view, random.Random(number)))
        for number, (match, view) in enumerate(zip(matches, views, strict=True))
    ]
    for thread in threads:
        thread.start()
    try:
        assert table_at(arena).play(4)
    finally:
        stop.set()
        for thread in threads:
            thread.join()
    for match in matches:
        match.conceded()
