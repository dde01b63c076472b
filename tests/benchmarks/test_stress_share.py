"""A bounded share of the stress run (issue "exact, fast, never wrong": Stability): hundreds of hostile shots a class.

The whole run is ``pooliad bench stress --full``.
"""

import numpy as np
import pytest

import physics
from benchmarks import (
    everything,
    hostile,
    hostile_jaws,
    hostile_scenes,
    pieces,
    smallest,
    soundness,
    stress,
    unfiltered,
    variants,
)
from referee import Limits

SEED = 5
NINE = physics.RealTable.of_size("nine_foot").replace(cue_test=False)


@pytest.mark.parametrize("kind", hostile_jaws.CLASSES)
def test_hostile_shots_on_tables_with_jaws(kind):
    """The same, and nothing missed or invented between the events of some: everything against everything."""
    tally = stress.attempt(kind, SEED, 100 if kind == "jaws: limits of the table" else 400, 6)
    assert not tally.failures, tally.failures[0]
    assert tally.flights >= 6
    if "limits" not in kind:
        assert tally.status["AT_REST"] == tally.shots


AT_ROUNDING = {
    "along a nose line past a horn": (
        {0: (1.2424862662941305, 0.9524979801047053), 5: (0.02751373370586951, 1.3461808004819837)},
        physics.Shot(4.310511952165664, 90.0, 1.9625957112955055, 0.0, -9.188493240768656),
    ),
    "past a ball at just a diameter": (
        {0: (0.5716050582885556, 0.945845865268884), 5: (0.5716050582885556, 0.888695865268884)},
        physics.Shot(12.0, 0.0),
    ),
    "along a nose with a denormal spin": (
        {0: (0.02751373370686951, 2.1372085471355584), 4: (0.02751373470586951, 2.284381938831633)},
        physics.Shot(12.0, -90.0, 85.0, -1.8369702e-316, -1e-300),
    ),
}


def test_filter_and_broad_phase_leave_out_nothing_at_these_grazes():
    """Seen, in 769 of 259,600 shots: contacts without an impulse that only kernels without a filter took note of."""
    scenes = [(NINE.replace(flight=False), balls, shot) for balls, shot in AT_ROUNDING.values()]
    task = "benchmarks.unfiltered:look_at_everything", "benchmarks.unfiltered:left_by", scenes
    unfiltered_too = variants.run(*task, interpreted=True)
    assert [one.tolist() for one in unfiltered.left_by(scenes)] == [one.tolist() for one in unfiltered_too]


def test_the_oracle_agrees_with_looking_often():
    """Deepest overlap on random parabolas, against 20,001 instants of each."""
    rng, instants = np.random.default_rng(4), np.linspace(0.0, 0.7, 20_001)
    for _ in range(40):
        c, b, a = rng.normal(0.0, 0.1, (1, 2)), rng.normal(0.0, 0.5, (1, 2)), rng.normal(0.0, 0.7, (1, 2))
        way = c + instants[:, None] * (b + instants[:, None] * a)
        depth = max(0.0, float((0.3 - np.linalg.norm(way, axis=1)).max()))
        assert depth - 1e-12 <= everything.deepest_in_discs((c, b, a), 0.7, np.array([0.3])) <= depth + 1e-6


def test_the_oracle_sees_a_contact_that_was_missed_or_invented():
    """A rattle is judged by a table with other mouths: its jaws were passed through, its collisions are apart."""
    state = physics.TableState.from_positions({0: (0.9, 0.06)})
    result = physics.simulate(NINE, state, physics.Shot(6.0, 182.5))
    right = everything.look_over(result, pieces.pieces_of(NINE), 80)
    assert right.contacts > 2
    assert max(right.beyond, right.apart) < 1e-12
    assert everything.look_over(result, pieces.pieces_of(NINE.replace(corner_mouth=0.11)), 80).beyond > 1e-4
    assert everything.look_over(result, pieces.pieces_of(NINE.replace(corner_mouth=0.12)), 80).apart > 1e-4


def test_balls_in_a_nose_a_facing_and_a_horn_and_over_a_hole_are_seen():
    """Each a millimetre too deep."""
    jaw, near = NINE.pockets[0].jaws[0], NINE.contact_distance - 1e-3
    middle = 0.5 * (np.array(jaw.facing_start) + jaw.facing_end)
    round_horn = np.array(jaw.horn_centre) + (near + jaw.horn_radius) * np.array([-0.28, 0.96])
    states = np.full((5, 16, 2), np.nan)
    states[:, 0] = (0.5, 1.0), (near, 0.3), middle + near * np.array(jaw.facing_normal), round_horn, (-0.0057625, 1.27)
    assert soundness.beyond(NINE, states) == pytest.approx([0.0, *[1e-3] * 4], abs=1e-12)
    assert soundness.misplaced(NINE, states).tolist() == [False, True, True, True, True]


@pytest.mark.parametrize("kind", hostile.CLASSES)
def test_hostile_shots_end_at_rest_inside_the_table_without_overlap(kind):
    shots, flights = (200, 20) if kind == "limits of the table" else (600, 20)
    tally = stress.attempt(kind, SEED, shots, flights)
    assert not tally.failures, tally.failures[0]
    assert tally.shots == shots
    assert tally.flights == min(flights, tally.status["AT_REST"])
    if kind not in ("limits of a shot", "limits of the table"):
        assert tally.most_events < Limits().events, "a stroke of a game would be ended"


@pytest.mark.parametrize("kind", hostile_scenes.CLASSES)
def test_the_same_seed_draws_the_same_scenes(kind):
    for one, two in zip(
        hostile_scenes.scene_of(kind, 3, 50)[1:], hostile_scenes.scene_of(kind, 3, 50)[1:], strict=True
    ):
        assert one.tobytes() == two.tobytes()


@pytest.mark.parametrize(
    "kind", ["touching break", "frozen cluster", "touching lattice", "cushions and corners", "straight lines"]
)
def test_touching_classes_touch(kind):
    """At least a fifth of the shots start with balls that touch another or a cushion: the classes are what they say."""
    table, states, _ = hostile_scenes.scene_of(kind, SEED, 300)
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
