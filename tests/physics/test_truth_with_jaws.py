"""The arbitrary-precision engine on a table with jaws, by itself: its geometry, its energy, and what jaws must do."""

from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf
from support.truth.engine import play, start
from support.truth.model import Motion, energy
from support.truth.motion import advance
from support.truth.rails import Rails
from support.truth.strike import Stroke
from support.worlds import world_of

import physics

NINE = physics.RealTable.of_size("nine_foot").replace(flight=False)
WORLD = world_of(NINE)


def test_its_geometry_is_the_tables():
    """Derived from the parameters by other means; the table's pieces to 1e-15 m."""
    rails = Rails(WORLD)
    assert abs(float(WORLD.rho) - NINE.contact_distance) < 1e-17
    by_number = {jaw.number: jaw for pocket in NINE.pockets for jaw in pocket.jaws}
    for horn in rails.horns:
        assert abs(complex(horn.centre) - complex(*by_number[horn.number - 4].horn_centre)) < 1e-15
    for strip in rails.strips[6:]:
        jaw = by_number[strip.number - 4]
        for mine, its in (
            (strip.start, jaw.facing_start),
            (strip.end, jaw.facing_end),
            (strip.inward, jaw.facing_normal),
        ):
            assert abs(complex(mine) - complex(*its)) < 1e-15
    for hole in rails.holes:
        assert abs(complex(hole.centre) - complex(*NINE.pockets[hole.pocket].hole_centre)) < 1e-15


def total(shot):
    balls = [ball.copy() for ball in shot.on_table()]
    for ball in balls:
        advance(shot.world, ball, shot.time)
    return sum(energy(shot.world, ball) for ball in balls)


RATTLE = Stroke(3.0, 245.0)
"""Towards the south-west pocket, off its line: the ball rattles between the jaws."""


@pytest.mark.parametrize("law", ["han", "mathavan", "factors"])
def test_energy_falls_at_every_event(law):
    world = world_of(NINE.replace(cushion=law))
    with mp.workdps(30):
        shot = start(world, {0: (0.4, 0.5), 1: (0.2, 0.15), 2: (0.9, 1.9)}, Stroke(4.0, 238.0, 5.0, 5.0, 3.0))
        energies = [total(shot)]
        while len(shot.records) < 40 and shot.step():
            energies.append(total(shot))
    assert all(after <= before * (1 + mpf("1e-25")) for before, after in pairwise(energies))


def test_a_ball_down_the_middle_is_pocketed_where_the_drop_edge_is():
    shot = play({0: (0.4, 0.4)}, Stroke(1.0, 225.0), WORLD, digits=30)
    last = shot.records[-1]
    assert (last.kind, last.other) == ("pocket_collision", 0)
    with mp.workdps(30):
        hole = Rails(WORLD).holes[0]
        assert abs(abs(last.states[0].position - hole.centre) - hole.radius) < mpf("1e-25")


def test_jaws_turn_balls_back():
    """Down the south rail, fast: the far jaw of the corner throws the ball out again."""
    kinds = []
    for degrees in np.linspace(181.0, 186.0, 6):
        shot = play({0: (0.9, 0.06)}, Stroke(6.0, float(degrees)), WORLD, digits=30, max_events=12)
        kinds += [record.kind for record in shot.records]
    assert kinds.count("jaw_collision") >= 4
    assert "pocket_collision" in kinds or "rail_collision" in kinds


def test_nothing_ends_in_the_wood():
    rng = np.random.default_rng(3)
    for _ in range(6):
        place = float(rng.uniform(0.05, 0.3)), float(rng.uniform(0.05, 0.3))
        shot = play({0: place}, Stroke(float(rng.uniform(0.5, 8)), float(rng.uniform(195, 255))), WORLD, digits=30)
        for ball in shot.balls.values():
            if ball.motion is not Motion.POCKETED:
                assert NINE.contains(float(ball.position.real), float(ball.position.imag))
