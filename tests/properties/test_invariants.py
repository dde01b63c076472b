"""What no shot may do, over drawn scenes of every kind: gain energy, jump, overlap, leave the table, not end."""

import math

import numpy as np
from hypothesis import example, given, settings
from hypothesis import strategies as st
from support.audit import audit, outside, overlap, resting
from support.play import OPEN, play, state_of
from support.scenes import RADIUS, TALLY, Scene, scenes

import physics

ENERGY_RISE = 1e-12
"""Relative, at one instant."""

JUMP = 1e-12
"""m; how far a recorded position may be from where the closed form carries the ball."""

OVERLAP = 1e-12
"""m, unless the start overlaps by more."""

BEYOND = 1e-12
"""m past a cushion line or mouth line."""

tables = st.one_of(
    st.just(OPEN),
    st.builds(
        lambda **changes: OPEN.replace(**changes),
        mu_slide=st.sampled_from([0.01, 0.2, 1.0]),
        mu_roll=st.sampled_from([0.001, 0.01]),
        mu_spin=st.sampled_from([0.001, 0.044, 1.0]),
        mu_ball=st.sampled_from([0.0, 0.06, 1.0]),
        e_ball=st.sampled_from([0.8, 0.95, 1.0]),
        cushion_parallel=st.sampled_from([0.0, 0.9, 1.0]),
        cushion_perpendicular=st.sampled_from([0.0, 0.6, 1.0]),
        cushion_spin=st.sampled_from([0.0, 0.1, 1.0]),
    ),
)


def start_overlap(scene: Scene) -> float:
    return overlap([resting(ball, position) for ball, position in scene.positions.items()])


TOUCHING_ROW = Scene(
    "row", {0: (0.5, 1.5), **{i: (0.5, 1.2 - 2 * i * RADIUS) for i in range(1, 6)}}, (2.0, 270.0, 0.0, 0.0, -10.0)
)
FROZEN_CORNER = Scene(
    "frozen", {0: (0.5, 0.5), 1: (RADIUS, 0.11), 2: (RADIUS, 0.11 + 2 * RADIUS)}, (10.0, 200.0, 0.0, 5.0, 5.0)
)
SPINNING_IN_PLACE = Scene("frozen", {0: (RADIUS, 0.5), 1: (3 * RADIUS, 0.5)}, (0.001, 45.0, 70.0, 14.0, 0.0))


@settings(max_examples=400)
@given(scenes(), tables)
@example(TOUCHING_ROW, OPEN)
@example(FROZEN_CORNER, OPEN)
@example(SPINNING_IN_PLACE, OPEN)
def test_no_shot_gains_energy_jumps_overlaps_or_escapes(scene, table):
    """Issue "physics", invariants; every event of every trace is checked by a second copy of the motions."""
    result = play(scene, table)
    assert result.status is physics.Status.AT_REST
    worst = audit(table, state_of(scene), result)
    assert worst.rise <= ENERGY_RISE
    assert worst.jump <= JUMP
    assert worst.overlap <= max(OVERLAP, start_overlap(scene) * (1 + 1e-9))
    assert worst.outside <= BEYOND


@settings(max_examples=200)
@given(scenes(), tables)
def test_every_shot_ends_in_a_legal_start(scene, table):
    """The final table is accepted as it is, also after JSON, and holds the balls that were not pocketed."""
    result = play(scene, table)
    again = physics.TableState.from_dict(result.final.to_dict())
    assert again == result.final
    gone = {ball for ball, _, _ in result.facts.pocketed_in_order}
    assert set(result.final.balls) == set(scene.positions) - gone
    assert all(table.contains(*result.final.position(ball)) for ball in result.final.balls)
    assert math.isfinite(result.duration)
    if 0 in again.balls:
        physics.simulate(table, again, physics.Shot(1.0, 33.0))


@settings(max_examples=150)
@given(scenes(), st.lists(st.floats(0.0, 1.0), min_size=3, max_size=3))
def test_balls_are_apart_and_inside_at_any_time(scene, fractions):
    result = play(scene)
    for fraction in fractions:
        snapshot = result.at(fraction * result.duration)
        present = ~np.isnan(snapshot.positions[:, 0])
        places = snapshot.positions[present]
        apart = np.linalg.norm(places[:, None] - places[None, :], axis=2)[np.triu_indices(len(places), 1)]
        assert (apart > 2 * RADIUS - max(1.1e-12, start_overlap(scene) * 1.001)).all()
        assert max((outside(x, y) for x, y in places), default=-1.0) <= BEYOND
        assert np.isfinite(snapshot.velocities).all()
        assert np.isfinite(snapshot.spins).all()


def test_most_drawn_scenes_are_special():
    """At least a fifth must be frozen, touching or collinear; the counts are printed at the end of the run."""
    special = sum(TALLY[kind] for kind in ("touching", "frozen", "collinear"))
    assert special >= 0.2 * TALLY.total()
