"""A bounded share of the stress run (issue "exact, fast, never wrong": Stability): hundreds of hostile shots a class.

The whole run is ``pooliad bench stress --full``.
"""

import numpy as np
import pytest

import physics
from benchmarks import hostile, smallest, soundness, stress
from referee import Limits

SEED = 5


@pytest.mark.parametrize("kind", hostile.CLASSES)
def test_hostile_shots_end_at_rest_inside_the_table_without_overlap(kind):
    shots, flights = (200, 20) if kind == "limits of the table" else (600, 20)
    tally = stress.attempt(kind, SEED, shots, flights)
    assert not tally.failures, tally.failures[0]
    assert tally.shots == shots
    assert tally.flights == min(flights, tally.status["AT_REST"])
    if kind not in ("limits of a shot", "limits of the table"):
        assert tally.most_events < Limits().events, "a stroke of a game would be ended"


@pytest.mark.parametrize("kind", hostile.CLASSES)
def test_the_same_seed_draws_the_same_scenes(kind):
    for one, two in zip(stress.scene_of(kind, 3, 50)[1:], stress.scene_of(kind, 3, 50)[1:], strict=True):
        assert one.tobytes() == two.tobytes()


@pytest.mark.parametrize(
    "kind", ["touching break", "frozen cluster", "touching lattice", "cushions and corners", "straight lines"]
)
def test_touching_classes_touch(kind):
    """At least a fifth of the shots start with balls that touch another or a cushion: the classes are what they say."""
    table, states, _ = stress.scene_of(kind, SEED, 300)
    rows, columns = np.triu_indices(16, 1)
    gap = np.linalg.norm(states[:, rows] - states[:, columns], axis=2) - 2 * table.ball_radius
    side = np.abs(states[..., 0] - table.width / 2) - (table.width / 2 - table.ball_radius)
    end = np.abs(states[..., 1] - table.length / 2) - (table.length / 2 - table.ball_radius)
    touching = (np.abs(gap) < 1e-12).any(axis=1) | (np.maximum(side, end) > -1e-12).any(axis=1)
    assert touching.mean() > 0.2


def test_an_overlap_a_lost_ball_and_a_place_in_a_mouth_are_seen():
    """The judge itself: each fault, made by hand, is reported under its name."""
    table = physics.Table.olympiad()
    states = np.full((4, 16, 2), np.nan)
    states[:, 0], states[:, 1] = (0.5, 1.0), (0.5, 1.5)
    batch = physics.simulate_batch(table.replace(cue_test=False), states, np.zeros((4, 5)))
    batch.positions[0, 1] = 0.5, 1.0 + 2 * table.ball_radius - 1e-9
    batch.positions[1, 1] = np.nan
    batch.positions[2, 1] = 0.04, 0.04
    faults = soundness.judge(table, states, batch).faults
    assert faults["overlap"].tolist() == [True, False, False, False]
    assert faults["nan"].tolist() == [False, True, False, False]
    assert faults["escape"].tolist() == [False, False, True, False]


def test_a_failing_scene_shrinks_to_what_fails():
    """Left over: the two balls and the speed the fault needs."""
    states = np.full((16, 2), np.nan)
    states[:5] = [(0.3, 0.3), (0.5, 0.5), (0.7, 0.7), (0.3, 1.0), (0.9, 1.5)]
    shot = np.array([7.25, 33.3, 20.0, 3.0, 4.0])

    def fails(scene):
        return {"made up"} if scene[1][2, 0] == 0.7 and scene[2][0] > 5 else set()

    table, small, plain = smallest.shrink((physics.Table.olympiad(), states, shot), "made up", fails)
    assert np.flatnonzero(~np.isnan(small[:, 0])).tolist() == [0, 2]
    assert plain[0] > 5
    assert plain[2:].tolist() == [0.0, 0.0, 0.0]
    assert table == physics.Table.olympiad()
