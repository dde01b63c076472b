"""``result.at``, ``resume``, traces and batches: other ways to the same shot."""

import math
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from support.audit import instants, moved, resting
from support.play import OPEN, apart, joint, play, sensitivity, state_of
from support.scenes import RADIUS, scenes

import physics

RESUMED = 1e-9
"""m, s; a resumed shot's end against the undivided one's."""

SHARE = 1000.0
"""A shot that rounding alone moves farther may differ by this many times what one ulp of v does to its end."""

CONTINUITY = 1e-12
"""m; ``at`` against the closed form, and across events."""


@settings(max_examples=150)
@given(scenes(), st.floats(0.0, 1.0))
def test_at_follows_the_closed_form(scene, fraction):
    """[I]: between events every ball moves by the formulas of its state."""
    result = play(scene)
    t = fraction * result.duration
    last = {ball: (0.0, resting(ball, place)) for ball, place in scene.positions.items()}
    for time, events in instants(result):
        if time <= t:
            last |= {state.ball: (time, state) for event in events for state in event.states}
    snapshot = result.at(t)
    for ball, (since, state) in last.items():
        if state.motion is physics.Motion.POCKETED:
            assert np.isnan(snapshot.positions[ball]).all()
            continue
        now = moved(OPEN, state, t - since)
        assert math.dist(snapshot.positions[ball], now.position) <= CONTINUITY
        assert math.dist(snapshot.velocities[ball], now.velocity) <= 1e-11
        assert math.dist(snapshot.spins[ball], now.spin) * RADIUS <= 1e-11
        assert snapshot.motion[ball] == state.motion


@settings(max_examples=100)
@given(scenes())
def test_at_is_continuous_across_events(scene):
    """Positions just before and at an event differ by no more than the ball can move in between."""
    result = play(scene)
    for time, events in instants(result):
        before = max(0.0, math.nextafter(time, 0.0))
        one, two = result.at(before), result.at(min(time, result.duration))
        gone = {state.ball for event in events for state in event.states if state.motion.name == "POCKETED"}
        for ball in set(scene.positions) - gone:
            p, q = one.positions[ball], two.positions[ball]
            assert np.isnan(p).all() == np.isnan(q).all()
            if not np.isnan(p).any():
                assert math.dist(p, q) <= CONTINUITY + 20.0 * (time - before)


@settings(max_examples=100)
@given(scenes())
def test_at_an_event_shows_the_state_after_it(scene):
    result = play(scene)
    for time, events in instants(result):
        after = {state.ball: state for event in events for state in event.states}
        snapshot = result.at(time)
        for ball, state in after.items():
            assert snapshot.motion[ball] == state.motion
            if state.motion.name != "POCKETED":
                assert tuple(snapshot.velocities[ball]) == state.velocity
                assert tuple(snapshot.positions[ball]) == state.position


def told(events: Any) -> list[tuple[str, int, int]]:
    return sorted((event.kind.value, event.ball, event.other) for event in events)


@settings(max_examples=150)
@given(scenes(), st.floats(0.0, 1.0))
def test_split_and_resume(scene, fraction):
    """Stopping the clock at any time and going on gives the same events and ends, as far as rounding allows."""
    result = play(scene)
    t = fraction * result.duration
    rest = physics.resume(OPEN, result.at(t))
    off = apart(result.final, rest.final)
    if off > RESUMED:
        assert off <= SHARE * sensitivity(scene)
    elif not joint(result):
        assert abs(rest.duration + t - result.duration) <= RESUMED
        assert told(rest.events) == told(event for event in result.events if event.time > t)


@settings(max_examples=150)
@given(scenes())
def test_with_or_without_trace(scene):
    traced, plain = play(scene), play(scene, trace=False)
    assert traced.final == plain.final
    assert (traced.duration, traced.n_events, traced.status) == (plain.duration, plain.n_events, plain.status)
    assert repr(traced.facts) == repr(plain.facts)


@settings(max_examples=40)
@given(st.lists(scenes(), min_size=1, max_size=8), st.sampled_from([1, 2]))
def test_batches_have_the_bits_of_single_shots(drawn, threads):
    positions = np.stack([state_of(scene).positions for scene in drawn])
    shots = np.array([scene.stroke for scene in drawn])
    batch = physics.simulate_batch(OPEN, positions, shots, threads=threads)
    for i, scene in enumerate(drawn):
        single = play(scene, trace=False)
        assert batch.positions[i].tobytes() == single.final.positions.tobytes()
        assert batch.duration[i] == single.duration
        assert batch.n_events[i] == single.n_events
        assert repr(physics.Facts.from_record(batch.facts[i])) == repr(single.facts)
