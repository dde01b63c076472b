"""A stroke of a game ends at a limit of events, and the rules go on from where the balls are (issue 13, item 4)."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from support.bits import plays
from support.players import Potter

from client.local_game import play_game
from physics import Shot, Status, Table, simulate
from physics.constants import EVENT_LIMIT
from referee import SAFETY, Action, EightBall, InvalidGame, Limits, MatchSeed, NoiseModel, Phase
from referee.play import play_stroke
from referee.play.batch import Strokes, play_strokes
from referee.record import Engine, Header, MatchTerms, canonical, verify_record

TABLE = Table.olympiad()
SHORT = EightBall(TABLE, Limits(events=40, dry_visits=10, replays=0))
"""Many strokes have more events than that."""


@cache
def game():
    return play_game(SHORT, (Potter("a"), Potter("b")), MatchSeed.of(4).game(0), NoiseModel(1.0))


def test_a_game_whose_strokes_are_cut_off_is_played_to_its_end_and_verified():
    """The next stroke begins where the balls were stopped, `event_limit` is in the record, and it is replayed."""
    played = game()
    lines = [json.loads(line) for line in played.record()]
    strokes = [line for line in lines if line["type"] == "stroke" and line["stroke"] is not None]
    cut_off = [line for line in strokes if line["status"] == "event_limit"]
    assert 1 <= len(cut_off) < len(strokes)
    assert all(len(line["events"]) >= 40 and line["duration"] == line["events"][-1]["time"] for line in cut_off)
    assert all(line["ruling"]["rules"] for line in cut_off)
    assert lines[0]["rules"]["limits"]["events"] == 40
    assert played.outcome is not None
    verification = verify_record(played.record())
    assert verification.ok, str(verification)


def test_another_limit_in_the_record_is_found():
    """The limit is committed to; and with another one the strokes are not the same."""
    header, *rest = [json.loads(line) for line in game().record()]
    header["rules"]["limits"]["events"] = 41
    verification = verify_record([canonical(line) for line in (header, *rest)])
    assert not verification.ok
    assert verification.difference is not None
    assert verification.difference.field == "commitment"


def test_records_of_0_1_0_are_read_with_the_limit_they_were_made_with():
    """They name no limit of events: the physics' own. Their terms are digested as that version did (computed by it)."""
    terms = MatchTerms("m1", 2, EightBall(TABLE), NoiseModel(1.0), engine=Engine("0.1.0", "0" * 64))
    values = terms.to_dict()
    assert values["rules"]["limits"].pop("events") == 20_000
    old = MatchTerms.from_dict(values)
    assert old.rules.limits == Limits(events=EVENT_LIMIT)
    assert old.to_dict() == values
    assert old.commitment_to(MatchSeed.of(4)) == "1942ce3f074d3b3b6e3340bfd6de22d7290a8607fc2f2fd6c90075cef6c2703b"


def test_a_record_without_a_limit_of_events_is_replayed_without():
    """What 0.1.0 wrote, here by this engine: every stroke to its own end."""
    rules = EightBall(TABLE, Limits(events=EVENT_LIMIT, dry_visits=4, replays=0))
    played = play_game(rules, (Potter("a"), Potter("b")), MatchSeed.of(5).game(0), NoiseModel(1.0))
    lines = list(played.record())
    assert set(json.loads(lines[0])["rules"]["limits"]) == {"dry_visits", "replays", "strokes"}
    assert Header.from_dict(json.loads(lines[0])).terms.rules.limits.events == EVENT_LIMIT
    assert verify_record(lines).ok


def test_many_strokes_at_once_are_cut_off_as_one_is():
    """`play_strokes` and `play_stroke` leave the same games."""
    seeds, quiet = MatchSeed.of(3).game(0), NoiseModel(0.0)
    start = SHORT.new_game(seeds.rack(0))
    place = tuple(start.state.positions[0].tolist())
    opened = play_stroke(EightBall(TABLE), start, Action(Shot(9.0, 270.0, 10.0), None, place), seeds, quiet).game
    begun = replace(opened, phase=Phase.PLAY, decisions=(), choice=None, cue_ball_in_hand=None)
    assert 0 in begun.state.balls
    actions = []
    for phi in range(0, 360, 15):
        action = Action(Shot(6.0, float(phi), 45.0), SAFETY)
        if not SHORT.check(begun, action):
            actions.append(action)
    assert len(actions) > 5
    one_by_one = [play_stroke(SHORT, begun, action, seeds, quiet) for action in actions]
    before = np.array([stroke.before.positions for stroke in one_by_one])
    shots = np.array([[a.shot.v, a.shot.phi, a.shot.theta, a.shot.a, a.shot.b] for a in actions])
    together = Strokes([begun] * len(actions), before, shots, np.full(len(actions), -1), np.zeros(len(actions), int))
    games = play_strokes(SHORT, together, quiet, np.zeros(shots.shape))
    assert games == [stroke.game for stroke in one_by_one]
    assert any(stroke.result.status is Status.EVENT_LIMIT for stroke in one_by_one)


def test_the_games_limit_is_twenty_thousand_and_the_physics_keeps_its_own():
    assert Limits().events == 20_000
    table, state, shot = next((table, state, shot) for name, table, state, shot in plays() if name.startswith("break"))
    assert simulate(table, state, shot).n_events < Limits().events


@pytest.mark.parametrize("bad", [0, -1, 1.5, True, None, "5", EVENT_LIMIT + 1])
def test_a_limit_that_cannot_be_is_named(bad):
    with pytest.raises(InvalidGame, match=r"limits\.events"):
        Limits(events=bad)
