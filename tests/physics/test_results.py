"""Events, facts and batches of real shots (CONTRACT "Python: physics")."""

import json
import math
from typing import Any

import numpy as np
import pytest
from support.moving import after
from support.play import OPEN

import physics
from physics import simulation
from physics.kernels import layout

TABLE = physics.Table.olympiad()
R, W, L = 0.028575, 1.116, 2.236
BREAK = physics.Shot(9.0, 270.0, 12.0)
POISON = -77
"""What the memory of a fresh array holds in a test; no column of a trace can."""
LAID = physics.TableState.from_positions({0: (0.5, 1.7), 3: (0.4, 0.6)})


def shoot(positions, shot, table=OPEN):
    return physics.simulate(table, physics.TableState.from_positions(positions), shot)


@pytest.fixture(scope="module")
def broken():
    return physics.simulate(OPEN, physics.rack(OPEN, "eight_ball", seed=7), BREAK)


def test_events_are_a_sequence(broken):
    events = broken.events
    assert len(events) == broken.n_events == broken.facts.n_events
    assert [event.index for event in events] == list(range(len(events)))
    assert events[-1].index == len(events) - 1
    assert [event.index for event in events[3:6]] == [3, 4, 5]
    with pytest.raises(IndexError):
        events[len(events)]
    times = [event.time for event in events]
    assert times == sorted(times)
    assert times[-1] == broken.duration


def test_events_name_what_is_involved(broken):
    assert events_of(broken, "cue_strike")[0].index == 0
    for event in events_of(broken, "ball_collision"):
        assert event.ball < event.other
        assert [state.ball for state in event.states] == [event.ball, event.other]
    for event in events_of(broken, "rail_collision"):
        assert event.other in range(4)
    assert json.loads(json.dumps(broken.events[5].to_dict()))["kind"] == broken.events[5].kind.value
    assert str(broken.events[0]).startswith("0.000000 s  ball 0")


def events_of(result, kind):
    return [event for event in result.events if event.kind.value == kind]


@pytest.mark.parametrize("shot", [BREAK, physics.Shot(1.0, 90.0)], ids=["grown trace", "first trace"])
def test_a_result_holds_no_memory_that_was_never_written(monkeypatch, shot):
    """The second ball's columns of an event with one ball read 0; the room a short shot did not need is given back."""
    monkeypatch.setattr(simulation, "TRACE_ROWS", 40)
    monkeypatch.setattr(np, "empty", lambda shape, dtype=float: np.full(shape, POISON, dtype))
    result = physics.simulate(OPEN, physics.rack(OPEN, "eight_ball", seed=7), shot)
    monkeypatch.undo()
    assert (result.n_events > 40) == (shot is BREAK)
    rows = result._trace
    assert not np.any(rows == POISON)
    assert rows.base is None
    alone = rows[rows[:, layout.T_KIND] != layout.BALL_COLLISION]
    assert not np.any(alone[:, layout.T_SECOND :])


def test_without_trace_there_are_no_events():
    state = physics.rack(OPEN, "eight_ball", seed=7)
    result = physics.simulate(OPEN, state, BREAK, trace=False)
    with pytest.raises(ValueError, match="trace"):
        len(result.events)
    with pytest.raises(ValueError, match="trace"):
        result.at(0.0)


@pytest.mark.parametrize("t", [-1e-9, math.nan, 1e9])
def test_times_outside_the_shot_are_refused(broken, t):
    with pytest.raises(ValueError, match="duration"):
        broken.at(t)


def test_samples_end_with_the_shot(broken):
    times = [snapshot.time for snapshot in broken.sample(0.1)]
    assert times[0] == 0.0
    assert times[-1] == broken.duration
    assert all(math.isclose(t, k * 0.1) for k, t in enumerate(times[:-1]))
    with pytest.raises(ValueError, match="dt"):
        list(broken.sample(0.0))


def test_facts_agree_with_the_events(broken):
    """The ordinal each fact names is the first event of that kind."""
    facts = broken.facts
    hits = [e for e in events_of(broken, "ball_collision") if e.ball == 0]
    assert facts.struck_first == tuple(e.other for e in hits if e.time == hits[0].time)
    assert facts.first_contact[hits[0].other] == hits[0].index
    assert facts.first_contact_cue_ball == after(hits[0], 0).position
    for ball in range(16):
        rails = [e.index for e in events_of(broken, "rail_collision") if e.ball == ball]
        assert facts.cushion[ball] == (rails[0] if rails else -1)
        falls = [e for e in events_of(broken, "pocket_collision") if e.ball == ball]
        assert facts.pocketed[ball] == (falls[0].index if falls else -1)
        assert facts.pocket[ball] == (falls[0].other if falls else -1)
    assert facts.off_table == (-1,) * 16
    assert facts.duration == broken.duration


def test_crossing_the_head_string():
    """The stretch of path on which the cue ball first is at y <= head string; at the start counts."""
    behind, beyond = (0.5, 1.9), (0.5, 1.6)
    stays = shoot({0: behind}, physics.Shot(0.5, 0.0, 20.0))
    assert (stays.facts.crossed_head_string, stays.facts.crossed_before_contact) == (-1, -1)
    leaves = shoot({0: behind, 1: (0.5, 0.9)}, physics.Shot(3.0, 270.0, 20.0))
    assert leaves.facts.crossed_before_contact >= 0
    begins = shoot({0: beyond}, physics.Shot(0.5, 0.0, 20.0))
    assert begins.facts.crossed_head_string == 0


def test_contact_before_the_head_string():
    """A ball in the kitchen hit first, the cue ball crosses after that."""
    result = shoot({0: (0.5, 2.1), 1: (0.52, 1.9)}, physics.Shot(4.0, 270.0, 5.0))
    assert result.facts.crossed_before_contact == -1
    assert result.facts.crossed_head_string > result.facts.first_contact[1]


def test_cushions_before_and_after_contact():
    result = shoot({0: (0.3, 0.7), 1: (0.6, 0.7)}, physics.Shot(4.0, 180.0, 30.0))
    facts = result.facts
    assert 0 <= facts.cushion[0] < facts.first_contact[1]
    assert facts.cushion_after_contact[0] == -1 or facts.cushion_after_contact[0] > facts.first_contact[1]
    assert facts.cushion_after_contact[1] > facts.first_contact[1]


def test_a_frozen_ball_must_leave_and_come_back():
    """Struck into the cushion it is frozen to, it has not been driven to a cushion; after the far one it has."""
    result = shoot({0: (0.2, 0.8), 1: (R, 0.8)}, physics.Shot(0.8, 180.0, 10.0))
    assert result.facts.frozen_to_cushion[1] == 1
    rails = [e for e in events_of(result, "rail_collision") if e.ball == 1]
    assert rails[0].other == 0
    assert result.facts.cushion[1] != rails[0].index
    hard = shoot({0: (0.3, 0.95), 1: (R, 0.8)}, physics.Shot(8.0, 209.0, 10.0))
    touch, driven = [e for e in events_of(hard, "rail_collision") if e.ball == 1][:2]
    assert touch.other == 0
    assert hard.facts.cushion[1] == driven.index


def test_frozen_to_the_cue_ball():
    result = shoot({0: (0.5, 1.0), 1: (0.5 + 2 * R, 1.0), 2: (0.5, 1.2)}, physics.Shot(0.2, 180.0, 20.0))
    assert result.facts.frozen_to_cue_ball == (0, 1, *(0,) * 14)


def test_facts_built_by_hand():
    nothing = physics.Facts.none()
    assert nothing.struck_first == ()
    assert nothing.pocketed_in_order == ()
    assert nothing.first_contact == (-1,) * 16


def test_a_batch_from_one_state():
    state = physics.rack(OPEN, "eight_ball", seed=1)
    shots = np.array([[5.0, 268.0 + k, 10.0, 0.0, 0.0] for k in range(5)])
    batch = physics.simulate_batch(OPEN, state, shots, threads=2)
    assert len(batch) == 5
    assert batch.positions.shape == (5, 16, 2)
    assert batch.pocket.dtype == batch.status.dtype == np.int8
    for k, row in enumerate(shots):
        single = physics.simulate(OPEN, state, physics.Shot(*row))
        assert batch.state(k) == single.final
        assert batch.duration[k] == single.duration
        for ball in range(16):
            pocketed = single.facts.pocket[ball]
            assert batch.pocket[k, ball] == (pocketed if pocketed >= 0 else -1)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_batch_can_be_ended_from_outside(threads):
    state = physics.rack(OPEN, "eight_ball", seed=1)
    shots = np.array([[5.0, 200.0 + 0.5 * k, 10.0, 0.0, 0.0] for k in range(300)])
    asked: list[Any] = []
    batch = physics.simulate_batch(OPEN, state, shots, threads, check=lambda: asked.append(None))
    assert len(asked) >= 300 / 64
    assert batch.positions.tobytes() == physics.simulate_batch(OPEN, state, shots).positions.tobytes()

    def end():
        raise InterruptedError

    with pytest.raises(InterruptedError):
        physics.simulate_batch(OPEN, state, shots, threads, check=end)


def test_absent_balls_in_a_batch():
    state = physics.TableState.from_positions({0: (0.5, 1.0), 9: (0.5, 0.5)})
    batch = physics.simulate_batch(OPEN, state, [[1.0, 90.0, 30.0, 0.0, 0.0]])
    assert [ball for ball in range(16) if batch.pocket[0, ball] == -2] == [b for b in range(16) if b not in (0, 9)]


def test_a_row_that_cannot_be_played_is_a_result_and_disturbs_no_other():
    state = physics.TableState.from_positions({0: (0.5, 1.0), 1: (0.3, 1.0)})
    good = [2.0, 90.0, 20.0, 0.0, 0.0]
    rows = [
        good,
        [2.0, 0.0, 0.0, 0.0, 0.0],
        [11.0, 90.0, 20.0, 0, 0],
        [2.0, 90.0, 80.0, 0, 0],
        [2.0, 90, 20, 29, 0],
        good,
    ]
    batch = physics.simulate_batch(TABLE, state, np.array(rows))
    names = [physics.Status(s).name for s in batch.status]
    assert names == ["AT_REST", "CUE_OBSTRUCTED", "OUT_OF_RANGE", "OUT_OF_RANGE", "TIP_OFF_BALL", "AT_REST"]
    assert batch.positions[0].tobytes() == batch.positions[5].tobytes()
    for k in range(1, 5):
        assert batch.positions[k].tobytes() == state.positions.tobytes()
        assert (batch.n_events[k], batch.duration[k]) == (0, 0.0)


SHOTS_1 = np.array([[1.0, 0.0, 30.0, 0.0, 0.0]])
STATE_1 = physics.TableState.from_positions({0: (0.5, 1.0)})


@pytest.mark.parametrize(
    ("shots", "words"),
    [
        (np.ones((2, 4)), "shape"),
        (np.ones(5), "shape"),
        ([[1.0, math.nan, 0.0, 0.0, 0.0]], r"shots\[0\].phi"),
        ([[1.0, 0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, math.inf, 0.0]], r"shots\[1\].a"),
        ("shots", "shots"),
    ],
)
def test_bad_shots_of_a_batch_name_the_row(shots, words):
    with pytest.raises(physics.InvalidShot, match=words):
        physics.simulate_batch(OPEN, STATE_1, shots)


def test_bad_states_of_a_batch_name_the_row():
    good = STATE_1.positions
    overlapping, outside, infinite = good.copy(), good.copy(), good.copy()
    overlapping[4] = (0.51, 1.0)
    outside[4] = (0.0, 0.5)
    infinite[4] = (math.inf, 0.5)
    shots = np.repeat(SHOTS_1, 2, axis=0)
    for bad in (overlapping, outside, infinite):
        with pytest.raises(physics.InvalidState, match=r"states\[1\]"):
            physics.simulate_batch(OPEN, np.stack([good, bad]), shots)
    with pytest.raises(physics.InvalidState, match=r"states\[0\]"):
        physics.simulate_batch(OPEN, np.stack([outside]), shots[:1])
    with pytest.raises(physics.InvalidState, match="shape"):
        physics.simulate_batch(OPEN, np.stack([good]), shots)
    with pytest.raises(physics.InvalidState, match="float64"):
        physics.simulate_batch(OPEN, np.stack([good, good]).astype(np.float32), shots)


def test_threads_name_the_first_of_several_bad_rows():
    states = np.repeat(STATE_1.positions[None], 200, axis=0)
    for row in (37, 120, 199):
        states[row, 4] = (0.0, 0.5)
    for threads in (1, 3):
        with pytest.raises(physics.InvalidState, match=r"states\[37\]"):
            physics.simulate_batch(OPEN, states, np.repeat(SHOTS_1, 200, axis=0)[:200], threads=threads)


@pytest.mark.parametrize("threads", [0, -1, 1.5, True])
def test_bad_thread_counts(threads):
    with pytest.raises(ValueError, match="threads"):
        physics.simulate_batch(OPEN, STATE_1, SHOTS_1, threads=threads)


def test_wrong_kinds_of_arguments():
    with pytest.raises(physics.InvalidShot, match="Shot"):
        physics.simulate(OPEN, STATE_1, (1.0, 2.0))  # type: ignore[arg-type]
    with pytest.raises(physics.InvalidState, match="TableState"):
        physics.simulate(OPEN, {0: (0.5, 1.0)}, physics.Shot(1.0, 2.0))  # type: ignore[arg-type]


def test_chained_shots_always_start_legally():
    """Each final table is accepted as the next start after a JSON round trip."""
    rng = np.random.default_rng(8)
    state = physics.rack(OPEN, "eight_ball", seed=5)
    for _ in range(300):
        shot = physics.Shot(float(rng.uniform(0.5, 10)), float(rng.uniform(0, 360)), float(rng.uniform(0, 70)))
        result = physics.simulate(OPEN, state, shot)
        assert result.status is physics.Status.AT_REST
        state = physics.TableState.from_dict(json.loads(json.dumps(result.final.to_dict())))
        assert state == result.final
        if 0 not in state.balls or len(state.balls) < 4:
            state = physics.rack(OPEN, "eight_ball", seed=int(rng.integers(1000)))


def test_a_batch_takes_shot_objects():
    """Seen: `simulate_batch(table, state, [Shot(...)])` answered that "object" must be float64."""
    shots = [physics.Shot(2.0, 100.0 + k, 8.0, 1.0, -2.0) for k in range(3)]
    rows = np.array([[shot.v, shot.phi, shot.theta, shot.a, shot.b] for shot in shots])
    batch, same = (physics.simulate_batch(TABLE, LAID, given) for given in (shots, rows))
    assert batch.positions.tobytes() == same.positions.tobytes()


@pytest.mark.parametrize(
    ("shots", "words"),
    [
        (physics.Shot(1.0, 2.0), r"shots = Shot\(.*write \[shot\]"),
        ([physics.Shot(1.0, 2.0), [1.0] * 5], r"shots\[1\] = .*must be a physics.Shot"),
    ],
)
def test_shots_that_are_no_batch_are_explained(shots, words):
    with pytest.raises(physics.InvalidShot, match=words):
        physics.simulate_batch(TABLE, LAID, shots)


def test_events_of_a_kind(broken):
    for kind in physics.EventKind:
        assert broken.events.of(kind) == broken.events.of(kind.value) == [e for e in broken.events if e.kind is kind]
    assert broken.events.of("rail_collision")


def test_a_wrong_event_kind_is_answered_with_those_there_are(broken):
    for ask in (physics.EventKind, broken.events.of):
        with pytest.raises(ValueError, match=r"kind = 'cushion': must be one of cue_strike, .*rail_collision"):
            ask("cushion")
