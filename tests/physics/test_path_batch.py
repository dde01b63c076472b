"""``simulate_paths``: the numbers of ``simulate`` and ``Result.paths``, for many shots at once."""

import numpy as np
import pytest

from physics import InvalidShot, InvalidState, Shot, Status, Table, TableState, rack, simulate, simulate_paths
from physics.events import EventKind

BREAK = (5.0, 270.0, 5.0, 0.0, 0.0)
TIMES = np.linspace(0.0, 12.0, 61)
TABLES = (Table.olympiad(), Table.nine_foot())


def shots_of(n, seed=7):
    drawn = np.random.default_rng(seed).uniform((0.5, 0.0, 5.0, -8.0, -8.0), (5.0, 360.0, 20.0, 8.0, 8.0), (n, 5))
    return np.vstack((BREAK, drawn))


@pytest.mark.parametrize("table", TABLES, ids=lambda table: table.name)
def test_they_are_the_numbers_of_single_shots_bit_for_bit(table):
    """A break has more events than a trace has room for at first; times go beyond the ends of most shots."""
    state, shots = rack(table, seed=1), shots_of(6)
    found = simulate_paths(table, state, shots, TIMES)
    n_left = 0
    for row, shot in enumerate(shots):
        alone = simulate(table, state, Shot(*shot.tolist()))
        assert found.status[row] == alone.status
        assert found.duration[row] == alone.duration
        positions, heights = alone.paths(np.minimum(TIMES, alone.duration))
        np.testing.assert_array_equal(found.positions[row], positions)
        np.testing.assert_array_equal(found.heights[row], heights)
        gone = [event for kind in (EventKind.POCKET_COLLISION, EventKind.OFF_TABLE) for event in alone.events.of(kind)]
        n_left += len(gone)
        assert {event.ball: event.states[0].position for event in gone} == {
            ball: tuple(place) for ball, place in enumerate(found.left[row].tolist()) if place[0] == place[0]
        }
    assert n_left > 0


def test_each_shot_may_have_its_own_table_start_and_times():
    tables = [Table.olympiad().replace(mu_roll=mu) for mu in (0.01, 0.012, 0.015)]
    places = np.full((3, 16, 2), np.nan)
    places[:, 0], places[:, 3] = [(0.5, 1.5), (0.4, 1.5), (0.6, 1.2)], (0.5, 0.5)
    shots, times = shots_of(2, 3), np.sort(np.random.default_rng(2).uniform(0.0, 2.0, (3, 9)))
    found = simulate_paths(tables, places, shots, times, [3, 0])
    assert found.positions.shape == (3, 9, 2, 2)
    for row, table in enumerate(tables):
        alone = simulate(table, TableState.from_positions(places[row]), Shot(*shots[row].tolist()))
        positions, _ = alone.paths(np.minimum(times[row], alone.duration))
        np.testing.assert_array_equal(found.positions[row], positions[:, [3, 0]])


def test_before_the_strike_balls_lie_where_they_were_and_after_the_end_where_they_stopped():
    table, state = Table.olympiad(), TableState.from_positions({0: (0.5, 1.5), 1: (0.5, 0.7)})
    found = simulate_paths(table, state, [Shot(2.0, 270.0, 5.0)], np.array([-1.0, 1e6]))
    alone = simulate(table, state, Shot(2.0, 270.0, 5.0))
    np.testing.assert_array_equal(found.positions[0, 0, :2], state.positions[:2])
    np.testing.assert_allclose(found.positions[0, 1, :2], alone.final.positions[:2], atol=1e-12)


def test_a_shot_that_cannot_be_played_is_a_result_and_moves_nothing():
    state = TableState.from_positions({0: (0.5, 1.5)})
    found = simulate_paths(Table.olympiad(), state, [Shot(2.0, 270.0, 5.0, 30.0), Shot(2.0, 270.0, 5.0)], TIMES)
    assert found.status.tolist() == [Status.TIP_OFF_BALL, Status.AT_REST]
    assert (found.positions[0, :, 0] == (0.5, 1.5)).all()


def test_no_shots_are_no_paths():
    assert simulate_paths(Table.olympiad(), np.empty((0, 16, 2)), np.empty((0, 5)), TIMES).positions.size == 0


@pytest.mark.parametrize(
    ("changes", "error", "words"),
    [
        ({"times": np.array([1.0, 0.5])}, ValueError, r"times\[0\]\[1\] = 0.5: must be finite"),
        ({"times": np.array([0.0, np.nan])}, ValueError, r"times\[0\]\[1\] = nan: must be finite"),
        ({"times": np.array([0, 1])}, ValueError, r"times = int64 \(2,\): must be float64"),
        ({"times": np.zeros((3, 2))}, ValueError, r"times = float64 \(3, 2\): must be float64 of shape"),
        ({"tables": TABLES}, ValueError, "tables = 2 tables: must be one, or 2, all with jaws or all without"),
        ({"tables": TABLES[:1]}, ValueError, "tables = 1 tables: must be one, or 2"),
        ({"balls": [0, 16]}, ValueError, "balls = 16: must be numbers from 0 to 15"),
        ({"balls": [-1]}, ValueError, "balls = -1: must be"),
        ({"balls": [True]}, ValueError, "balls = True: must be"),
        ({"shots": np.zeros((2, 4))}, InvalidShot, "must have shape"),
        ({"shots": np.full((2, 5), np.inf)}, InvalidShot, r"shots\[0\].v"),
        ({"states": np.zeros((1, 16, 2))}, InvalidState, "must be float64 of shape"),
        ({"states": np.full((2, 16, 2), 9.0)}, InvalidState, r"states\[0\]\[0\]"),
    ],
)
def test_bad_input_is_refused_by_name(changes, error, words):
    given = {
        "tables": TABLES[0],
        "states": TableState.from_positions({0: (0.5, 1.5)}),
        "shots": np.array([BREAK, BREAK]),
        "times": TIMES,
    }
    with pytest.raises(error, match=words):
        simulate_paths(*(given | changes).values())
