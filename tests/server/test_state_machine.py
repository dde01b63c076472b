"""Issue, "Tests": a hypothesis state machine of a match over real HTTP against a tiny reference referee.

Both players send right and wrong things in any order. After every request the server's view is the reference's:
positions to the bit, turn, version; clocks only fall, and only the mover's. At the end every acknowledged stroke is in
the record.
"""

import json
import math

import pytest
from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)
from support.tiny_referee import TinyReferee

from physics import Shot, Table, TableState, check
from referee.record import PublicKey, verify_record

TABLE = Table.olympiad()
BALLS = {0: (0.56, 1.20), 2: (0.09, 0.09), 5: (0.80, 0.90), 8: (1.02, 0.10), 11: (0.30, 1.45), 14: (1.02, 2.14)}
"""Three of them hang in corners, so that short games see balls fall, the 8 too early, and its winner."""
POCKETS = [(0.0, 0.0), (0.0, 1.118), (0.0, 2.236), (1.116, 2.236), (1.116, 1.118), (1.116, 0.0)]
START = {"balls": {str(ball): list(place) for ball, place in BALLS.items()}, "groups": ["solids", "stripes"]}
CLOCK = 3600.0
PLACES = [(0.1 + 0.153 * column, 0.2 + 0.171 * row) for column in range(7) for row in range(11)]
SEATS = st.integers(0, 1)


class Match(RuleBasedStateMachine):
    """One match; the players are those of `table`."""

    def __init__(self, new_table, server):
        super().__init__()
        self.new_table, self.server = new_table, server
        self.last = None
        self.clocks, self.standing = [CLOCK, CLOCK], None

    @initialize()
    def begin(self):
        self.table = self.new_table(start=START, noise={"level": 0.0}, clock={"seconds": CLOCK})
        self.game = self.table.game
        self.model = TinyReferee(TABLE, dict(BALLS))

    @property
    def goes_on(self):
        return self.model.winner is None

    def stroke(self, data):
        """A stroke that the reference can rule on: aimed at a ball that may be called, the cue free."""
        model = self.model
        balls = dict(model.balls)
        cue_ball = None
        if model.in_hand:
            free = [place for place in PLACES if all(math.dist(place, balls[b]) > 0.1 for b in balls if b)]
            cue_ball = list(data.draw(st.sampled_from(free)))
            balls[0] = tuple(cue_ball)
        target = data.draw(st.sampled_from(model.callable))
        (x, y), (to_x, to_y) = balls[0], balls[target]
        phi = math.degrees(math.atan2(to_y - y, to_x - x)) + data.draw(
            st.sampled_from([0.0, 0.0, -0.6, 0.6, 2.0, 25.0])
        )
        shot = {
            "v": data.draw(st.sampled_from([0.8, 1.2, 2.5, 5.0])),
            "phi": phi % 360.0,
            "theta": data.draw(st.sampled_from([12.0, 30.0])),
            "a": 0.0,
            "b": data.draw(st.sampled_from([0.0, 6.0, -6.0])),
        }
        nearest = min(range(6), key=lambda pocket: math.dist(POCKETS[pocket], balls[target]))
        pocket = data.draw(st.sampled_from([nearest, nearest, 1]))
        call = data.draw(st.sampled_from([{"ball": target, "pocket": pocket}, "safety"]))
        possible = check(TABLE, TableState.from_positions(balls), Shot(**shot)) is None
        return {"shot": shot, "call": call, "cue_ball": cue_ball}, possible

    def send(self, seat, body, version, key=None):
        view = {"game": self.game, "version": version}
        return self.table.players[seat].act(view, body, **({} if key is None else {"key": key}))

    @precondition(lambda self: self.goes_on)
    @rule(data=st.data())
    def play(self, data):
        """The mover plays: accepted, ruled as the reference rules, with the next version."""
        seat, version = self.model.turn, self.model.version
        body, possible = self.stroke(data)
        key = f"stroke {version}"
        answer = self.send(seat, body, version, key)
        if not possible:
            assert (answer.status_code, answer.json()["code"]) == (422, "refused"), answer.text
            return
        assert answer.status_code == 200, answer.text
        self.model.play(body["shot"], body["call"], body["cue_ball"])
        assert answer.json()["view"]["version"] == version + 1
        assert answer.headers["etag"] == f'"{version + 1}"'
        self.last = (seat, body, version, key, answer)

    @precondition(lambda self: self.goes_on)
    @rule(data=st.data())
    def play_out_of_turn(self, data):
        body, _ = self.stroke(data)
        answer = self.send(1 - self.model.turn, body, self.model.version)
        assert (answer.status_code, answer.json()["code"]) == (409, "not_your_turn")

    @precondition(lambda self: self.goes_on)
    @rule(data=st.data(), seat=SEATS, off=st.sampled_from([-1, 1, 100]))
    def play_on_another_version(self, data, seat, off):
        body, _ = self.stroke(data)
        answer = self.send(seat, body, max(0, self.model.version + off))
        assert (answer.status_code, answer.json()["code"]) == (412, "stale_version")
        assert answer.json()["view"]["version"] == self.model.version

    @precondition(lambda self: self.last is not None)
    @rule()
    def send_again(self):
        """Whatever happened since: the stored answer, byte for byte."""
        seat, body, version, key, first = self.last
        again = self.send(seat, body, version, key)
        assert (again.status_code, again.content) == (first.status_code, first.content)

    @precondition(lambda self: self.last is not None)
    @rule()
    def send_something_else_under_the_same_key(self):
        seat, body, version, key, _ = self.last
        answer = self.send(seat, body | {"call": "safety" if body["call"] != "safety" else None}, version, key)
        assert (answer.status_code, answer.json()["code"]) == (422, "key_reused")

    @precondition(lambda self: self.goes_on)
    @rule(data=st.data(), wrong=st.sampled_from(["outside", "foreign ball", "no call", "break"]))
    def break_a_rule(self, data, wrong):
        """Refused with the reason; nothing moves."""
        body, _ = self.stroke(data)
        change = {
            "outside": {"cue_ball": [9.0, 9.0]},
            "foreign ball": {"call": {"ball": ({2, 5, 11, 14} - set(self.model.callable)).pop(), "pocket": 0}},
            "no call": {"call": None},
            "break": {"shot": body["shot"] | {"v": 11.0}},
        }[wrong]
        answer = self.send(self.model.turn, body | change, self.model.version)
        assert answer.status_code == 422, answer.text

    @rule(seat=SEATS)
    def poll(self, seat):
        """Who is in turn is told so, again and again; nobody else is."""
        answer = self.table.players[seat].get("/v1/turns", wait=0)
        if self.goes_on and seat == self.model.turn:
            assert answer.json()["view"]["version"] == self.model.version
        elif self.goes_on:
            assert answer.status_code == 204
        else:
            assert answer.status_code == 204 or answer.json()["type"] in ("game_over", "match_over")

    @precondition(lambda self: self.goes_on and len(self.model.history) >= 5)
    @rule()
    def give_up(self):
        seat, version = self.model.turn, self.model.version
        answer = self.table.players[seat].post(f"/v1/games/{self.game}/concede", version=version)
        assert answer.status_code == 200
        self.model.concede()

    @precondition(lambda self: not self.goes_on)
    @rule(seat=SEATS)
    def play_on_after_the_end(self, seat):
        body = {"shot": {"v": 3.0, "phi": 0.0, "theta": 10.0, "a": 0.0, "b": 0.0}, "call": "safety", "cue_ball": None}
        answer = self.send(seat, body, self.model.version)
        assert (answer.status_code, answer.json()["code"]) == (409, "game_finished")

    @invariant()
    def server_and_reference_agree(self):
        if not hasattr(self, "model"):
            return
        view = self.table.organiser.get(f"/v1/games/{self.game}").json()["view"]
        model = self.model
        assert view["version"] == model.version
        assert view["turn"] == (model.turn if self.goes_on else None)
        places = {int(ball): tuple(place) for ball, place in view["balls"].items()}
        assert places == model.balls
        assert (view["cue_ball_area"] is not None) == (model.in_hand and self.goes_on)
        left = [clock["seconds_left"] for clock in view["clocks"]]
        assert all(now <= before for now, before in zip(left, self.clocks, strict=True)), (left, self.clocks)
        if self.standing == (model.version, model.turn):
            assert left[1 - model.turn] == self.clocks[1 - model.turn]
        self.clocks, self.standing = left, (model.version, model.turn)

    def teardown(self):
        """The whole history: versions were consecutive, every acknowledged stroke is in the record, which verifies."""
        if not hasattr(self, "model"):
            return
        if self.goes_on:
            answer = self.table.organiser.post(f"/v1/matches/{self.table.match['id']}/abort")
            assert answer.status_code == 200
        assert self.model.version == 1 + len(self.model.history)
        record = self.table.organiser.get(f"/v1/games/{self.game}/record").text.splitlines()
        keys = self.server.request("GET", "/v1/keys").json()["keys"]
        found = verify_record(record, [PublicKey(bytes.fromhex(key["public_key"])) for key in keys])
        assert found.ok, str(found)
        assert found.outcome.winner == self.model.winner
        entries = [json.loads(line) for line in record[1:-2]]
        assert [entry["entry"] for entry in entries] == list(range(len(self.model.history)))
        for entry, kept in zip(entries, self.model.history, strict=True):
            assert entry["seat"] == kept["seat"]
            if "shot" in kept:
                assert entry["shot"] == entry["action"]["shot"] == kept["shot"]
                assert entry["final"] == json.loads(json.dumps(kept["final"]))


def explore(new_table, server, examples, steps):
    bounds = settings(
        max_examples=examples,
        stateful_step_count=steps,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )

    class MatchHere(Match):
        def __init__(self):
            super().__init__(new_table, server)

    run_state_machine_as_test(MatchHere, settings=bounds)


def test_a_match_is_what_a_tiny_referee_says(new_table, server):
    explore(new_table, server, examples=6, steps=25)


@pytest.mark.long
def test_many_matches_are_what_a_tiny_referee_says(new_table, server):
    explore(new_table, server, examples=300, steps=60)
