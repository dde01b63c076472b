"""A shot ends at a limit of events (issue 13, item 4): the balls are stopped where they are, however it is run.

The oracle for a shot that is cut off is the whole shot: its events, and where its balls are at the last of them.
"""

import dataclasses
import hashlib
import json
import os
import subprocess
import sys

import numpy as np
import pytest
from support.bits import plays

import physics
from physics.constants import EVENT_LIMIT
from physics.kernels import layout as at
from physics.parameters import parameters

PLAYS = {name: (table, state, shot) for name, table, state, shot in plays()}
BREAK = PLAYS["break, gap None"]


def limits(n_events):
    """The first ones, and some of the others."""
    return sorted({*range(1, min(12, n_events)), *range(1, n_events, max(1, n_events // 12))})


def cut_off(play, limit, **options):
    table, state, shot = play
    return physics.simulate(table, state, shot, event_limit=limit, **options)


def fingerprint():
    """A hash of ends, facts and events of all scenes, each cut off at some limits."""
    total = hashlib.sha256()
    for table, state, shot in list(PLAYS.values())[:5]:
        for limit in (1, 2, 7, 20):
            result = physics.simulate(table, state, shot, event_limit=limit)
            events = [event.to_dict() for event in result.events]
            facts = dataclasses.asdict(result.facts)
            total.update(result.final.positions.tobytes() + repr((facts, events)).encode())
    return total.hexdigest()


def was_in_the_air(whole, event):
    """Whether an event tells of a ball that is off the table because its shot was cut while it flew."""
    return event.kind == "off_table" and whole.at(event.time).motion[event.ball] == physics.Motion.FLYING


@pytest.mark.parametrize("name", PLAYS)
def test_every_prefix_of_a_shot_is_its_beginning_and_ends_where_the_balls_are(name):
    """Events and times are those of the whole shot, and the balls lie where they were at the last of them."""
    table, state, shot = PLAYS[name]
    whole = physics.simulate(table, state, shot)
    events = list(whole.events)
    for limit in limits(whole.n_events):
        result = physics.simulate(table, state, shot, event_limit=limit)
        assert result.n_events >= limit
        told = [event for event in result.events if not was_in_the_air(whole, event)]
        assert told == events[: len(told)]
        if result.status is physics.Status.AT_REST:  # the last events are of one instant
            assert result.n_events == whole.n_events
            continue
        assert result.status is physics.Status.EVENT_LIMIT
        assert result.duration == told[-1].time
        same_instant = whole.at(result.duration).positions
        on_table = ~np.isnan(result.final.positions[:, 0])
        moved = np.abs(result.final.positions - same_instant)[on_table]
        assert moved.max(initial=0.0) < 1e-14


@pytest.mark.parametrize("name", PLAYS)
def test_the_end_is_a_legal_start_also_after_json(name):
    table, state, shot = PLAYS[name]
    n_events = physics.simulate(table, state, shot, trace=False).n_events
    for limit in limits(n_events):
        final = physics.simulate(table, state, shot, trace=False, event_limit=limit).final
        read = physics.TableState.from_positions(
            {int(ball): at for ball, at in json.loads(json.dumps(final.to_dict())).items()}
        )
        read.valid_on(table)
        assert physics.simulate(table, read, physics.Shot(0.5, 30.0, 20.0), trace=False).n_events >= 0


@pytest.mark.parametrize("limit", [1, 2, 30, 60, 10_000])
def test_single_and_batch_with_and_without_trace_and_threads_agree(limit):
    table, state, shot = BREAK
    single = cut_off(BREAK, limit)
    plain = cut_off(BREAK, limit, trace=False)
    shots = np.tile([shot.v, shot.phi, shot.theta, shot.a, shot.b], (9, 1))
    batches = [physics.simulate_batch(table, state, shots, threads=n, event_limit=limit) for n in (1, 3)]
    for positions in (plain.final.positions, *(batch.positions[row] for batch in batches for row in range(9))):
        assert positions.tobytes() == single.final.positions.tobytes()
    assert repr(plain.facts) == repr(single.facts)
    for batch in batches:
        assert repr(physics.Facts.from_record(batch.facts[4])) == repr(single.facts)


def test_a_shot_that_goes_on_is_cut_off_too():
    table, state, shot = BREAK
    middle = physics.simulate(table, state, shot).at(0.4)
    result = physics.resume(table, middle, event_limit=5)
    assert result.status is physics.Status.EVENT_LIMIT
    assert result.n_events >= 5


def test_interpreted_and_compiled_agree():
    """The kernels as plain Python give the same ends, facts and events."""
    script = f"import runpy; print(runpy.run_path({__file__!r})['fingerprint']())"
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(sys.path)}
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, env=environment, check=True)
    assert done.stdout.strip() == fingerprint()


def test_without_a_limit_it_is_the_physics_own():
    """CONTRACT: `EVENT_LIMIT` (10^6 events)."""
    assert EVENT_LIMIT == 10**6
    table, state, shot = BREAK
    assert parameters(table)[0, at.P_EVENT_LIMIT] == EVENT_LIMIT
    assert physics.simulate(table, state, shot).status is physics.Status.AT_REST


def test_limits_do_not_mix_on_one_table():
    """The table keeps its rows of parameters by limit: one asked for after another is not the other."""
    table, state, shot = BREAK
    for limit in (1, 10**6, 3, 1, *range(2, 30), 10**6):
        assert parameters(table, limit)[0, -1] == limit
        assert physics.simulate(table, state, shot, event_limit=limit).n_events >= min(limit, 60)


@pytest.mark.parametrize("bad", [0, -1, 10**6 + 1, 1.0, 2.5, True, None, "7", float("nan")])
def test_a_limit_that_cannot_be_is_named(bad):
    table, state, shot = BREAK
    for run in (
        lambda: physics.simulate(table, state, shot, event_limit=bad),
        lambda: physics.resume(table, physics.simulate(table, state, shot).at(0.1), event_limit=bad),
        lambda: physics.simulate_batch(table, state, [[2.0, 270.0, 5.0, 0.0, 0.0]], event_limit=bad),
    ):
        with pytest.raises(ValueError, match=r"event_limit = .*: must be an integer from 1 to 1000000"):
            run()
