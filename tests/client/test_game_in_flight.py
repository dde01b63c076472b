"""Issue 20, "Everything that plays or shows": a game with jumps, from the physics to its record and the wire."""

import json

import numpy as np
import pytest
from support.players import Potter

import client
import physics
from client.local_game import play_game
from protocol import SimulateAnswer, SimulateRequest
from protocol.outcomes import EventView
from protocol.simulations import simulate
from referee import Action, EightBall, MatchSeed, NoiseModel
from referee.game import Decision
from referee.record import verify_record

NINE = physics.Table.nine_foot()


class Jumper(Potter):
    """Raises the cue by 35 degrees and more after the break, and concedes after a few strokes."""

    strokes = 0

    def __call__(self, view):
        action = super().__call__(view)
        self.strokes += 1
        if self.strokes > 6:
            return Action(decision=Decision.CONCEDE)
        if action.shot is None or view.phase == "break":
            return action
        shot = action.shot
        high = physics.Shot(2.5 + 0.3 * shot.v, shot.phi, max(shot.theta, 38.0), 0.0, 12.0)
        state = view.state.moved(0, action.cue_ball) if action.cue_ball else view.state
        return (
            action
            if physics.check(view.table_model(), state, high) is not None
            else Action(high, action.call, action.cue_ball)
        )


@pytest.fixture(scope="module")
def game():
    seed = MatchSeed.of(8).game(0)
    return play_game(EightBall(NINE), (Jumper("ann"), Jumper("bob")), seed, NoiseModel(1.0), players=("ann", "bob"))


def balls_of(event):
    return [state["ball"] for state in event["states"]]


def in_flight(game):
    return [stroke for stroke in game.strokes if stroke.result is not None and stroke.result.events.of("landing")]


def test_its_record_holds_every_height_and_verifies(game):
    lines = [json.loads(line) for line in game.record()]
    assert verify_record(list(game.record())).ok
    assert lines[0]["table"]["flight"] is True
    flown = 0
    for stroke, line in zip(game.strokes, lines[1:], strict=False):
        if stroke.result is None:
            continue
        for event in line["events"]:
            snapshot = stroke.result.at(event["time"])
            for state in event["states"]:
                assert set(state) == {"ball", "position", "velocity", "spin", "motion", "height", "velocity_z"}
                flown += state["motion"] == "flying"
                latest = [e for e in line["events"] if e["time"] == event["time"] and state["ball"] in balls_of(e)][-1]
                if latest is event and state["motion"] not in ("pocketed", "driven_off"):
                    assert snapshot.heights[state["ball"]] == state["height"]
                    assert snapshot.vertical_velocities[state["ball"]] == state["velocity_z"]
    assert len(in_flight(game)) >= 3
    assert flown > 20


def test_a_record_with_another_height_is_refused(game):
    lines = list(game.record())
    number = next(n for n, line in enumerate(lines) if '"landing"' in line)
    line = json.loads(lines[number])
    state = next(s for event in line["events"] for s in event["states"] if s["motion"] == "flying")
    state["height"] += 1e-12
    assert not verify_record([*lines[:number], json.dumps(line), *lines[number + 1 :]]).ok


def test_paths_are_the_snapshots_heights_included(game):
    for stroke in in_flight(game):
        times = np.linspace(0.0, stroke.result.duration, 60)
        positions, heights = stroke.result.paths(times)
        snapshots = [stroke.result.at(time) for time in times.tolist()]
        assert np.array_equal(positions, [snapshot.positions for snapshot in snapshots], equal_nan=True)
        there = ~np.isnan(positions[:, :, 0])
        assert np.array_equal(heights[there], np.array([snapshot.heights for snapshot in snapshots])[there])
        assert np.isnan(heights[~there]).all()


def test_views_and_answers_carry_heights_of_tables_that_fly_alone(game):
    stroke = in_flight(game)[0]
    views = [EventView.of(event) for event in stroke.result.events]
    for view, event in zip(views, stroke.result.events, strict=True):
        written = json.loads(view.model_dump_json())
        assert written == event.to_dict(), "nothing is lost on the wire"
        assert EventView.model_validate(written) == view
    table = physics.Table.olympiad()
    flat = physics.simulate(table, physics.rack(table, seed=1), physics.Shot(5.0, 270.0, 5.0))
    for event in flat.events:
        assert all("height" not in state for state in json.loads(EventView.of(event).model_dump_json())["states"])


def test_any_language_may_ask_for_a_jump():
    body = {"table": "nine_foot", "balls": {"0": [0.635, 0.6], "1": [0.635, 0.75]}, "trace": True}
    request = SimulateRequest.model_validate(body | {"shot": {"v": 2.5, "phi": 90, "theta": 50, "a": 0, "b": 15}})
    answer = json.loads(simulate(request).model_dump_json())
    assert SimulateAnswer.model_validate(answer)
    struck, first = answer["events"][0], next(event for event in answer["events"] if event["kind"] == "landing")
    assert struck["states"][0]["motion"] == "flying"
    assert struck["states"][0]["velocity_z"] > 1.0
    assert first["states"][0]["height"] == 0.0
    assert answer["facts"]["first_contact"][1] == -1, "over ball 1"


def test_shipped_players_play_on_tables_that_fly():
    (match,) = client.play("random", "random", seed=5, table=NINE).games
    assert verify_record(list(match.record())).ok
