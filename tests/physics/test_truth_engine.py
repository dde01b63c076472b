"""The arbitrary-precision engine by itself: the historical corpus, conservation, symmetry, known scenes.

It judges the kernel (test_whole_shots.py), so nothing here uses the kernel.
"""

from itertools import pairwise

import numpy as np
import pytest
from mpmath import mp, mpf
from support.compare import from_truth, partners
from support.require import reference_shots
from support.truth.engine import play, start
from support.truth.model import Motion, World, energy
from support.truth.motion import advance
from support.truth.strike import Stroke

RADIUS = 0.028575
NAMES = {"CUE": "cue_strike", "BALL": "ball_collision", "RAIL": "rail_collision", "POCKET": "pocket_collision"}


def same_event(entry, event):
    name = NAMES.get(entry["e"])
    if name is None:
        return event.ball == entry["b"] and event.kind.split("_")[0] in {"sliding", "rolling", "spinning"}
    return event.kind == name and {entry["b"], entry.get("b2", entry["b"])} == set(event.states)


@pytest.mark.parametrize("start", range(4))
def test_it_retells_the_historical_corpus(start):
    """Every eighth recorded shot, over its stable events: the same events, times to 1e-9 s or the shot's own
    measured sensitivity (``stable_dt``), positions likewise."""
    for shot in reference_shots()[2 * start :: 8]:
        s = shot["shot"]
        stroke = Stroke(s["v_mps"], s["phi_deg"], s["theta_deg"], s["a_mm"], s["b_mm"])
        positions = {b: (x, y) for b, x, y in shot["balls"]}
        stable = shot["stable_events"]
        told = play(positions, stroke, World(historical=True), digits=30, max_events=stable + 6)
        waiting = from_truth(told.records)
        for entry in shot["events"][:stable]:
            event = next((e for e in waiting[:8] if same_event(entry, e)), None)
            assert event, (shot["id"], entry)
            waiting.remove(event)
            within = max(1e-9, shot["stable_dt"])
            assert abs(float(event.time) - entry["t"]) <= within, (shot["id"], entry)
            place = complex(*entry["post"][:2])
            assert abs(event.states[entry["b"]][0] - place) <= 20 * within, (shot["id"], entry)


def total(shot):
    """Energy of the balls on the table now, per mass."""
    balls = [ball.copy() for ball in shot.on_table()]
    for ball in balls:
        advance(shot.world, ball, shot.time)
    return sum(energy(shot.world, ball) for ball in balls)


@pytest.mark.parametrize("seed", range(3))
def test_energy_falls_at_every_event_of_a_touching_break(seed):
    rng = np.random.default_rng(seed)
    stroke = Stroke(float(rng.uniform(2, 8)), float(rng.uniform(265, 275)), 5.0, 3.0, -4.0)
    with mp.workdps(50):
        shot = start(World(), {0: (0.558, 1.7), **touching_rack()}, stroke)
        energies = [total(shot)]
        while shot.step():
            energies.append(total(shot))
    assert all(after <= before * (1 + mpf("1e-40")) for before, after in pairwise(energies))
    assert energies[-1] == 0


def touching_rack():
    step = 2 * RADIUS
    balls: dict[int, tuple[float, float]] = {}
    for row in range(5):
        for place in range(row + 1):
            balls[len(balls) + 1] = (0.558 + (place - row / 2) * step, 0.559 - row * step * 3**0.5 / 2)
    return balls


def test_a_straight_break_of_the_touching_rack_is_symmetric():
    shot = play({0: (0.558, 1.7), **touching_rack()}, Stroke(8.0, 270.0))
    images = {2: 3, 4: 6, 7: 10, 8: 9, 11: 15, 12: 14}
    for left, right in images.items():
        mirrored = 1.116 - shot.balls[right].position.real, shot.balls[right].position.imag
        assert abs(shot.balls[left].position - mp.mpc(*mirrored)) < 1e-9


def test_renumbering_tells_the_same_story():
    balls = touching_rack()
    swapped = {0: (0.558, 1.7), **{i: balls[16 - i] for i in balls}}
    one = play({0: (0.558, 1.7), **balls}, Stroke(7.0, 269.0, 0.0, 2.0, 1.0))
    two = play(swapped, Stroke(7.0, 269.0, 0.0, 2.0, 1.0))
    assert max(abs(one.balls[i].position - two.balls[16 - i].position) for i in balls) < mpf("1e-30")


def test_newtons_cradle_sends_one_ball_out():
    """Five touching balls in line, no friction between balls: the far one leaves. What is left behind slides on the
    cloth on both sides of every contact, so a pair may be pressed by up to 2 mu_slide g, which the contact rule
    settles as parting at up to 17/16 of mu_slide g tau, 2.09 mm/s (docs/physics.md, eq. 30)."""
    line = {i: (0.5, 1.4 - i * 2 * RADIUS) for i in range(1, 6)}
    shot = play({0: (0.5, 1.6), **line}, Stroke(2.0, 270.0), World(mu_ball=0.0), max_events=16)
    struck = [r for r in shot.records if r.kind == "ball_collision"]
    assert {(r.ball, r.other) for r in struck} >= {(0, 1), (1, 2), (2, 3), (3, 4), (4, 5)}
    last = {b.number: abs(b.velocity) for b in struck[-1].states}
    assert last[5] > 0.5
    along = {b.number: b.velocity.imag for b in struck[-1].states}
    assert all(abs(along[i + 1] - along[i]) < 2.09e-3 for i in range(4))


def test_balls_pressed_together_come_to_rest():
    """Two touching balls driven against each other's decelerations: finite, no overlap."""
    shot = play({0: (0.5, 1.0), 1: (0.5, 1.0 + 2 * RADIUS)}, Stroke(1.0, 90.0, 0.0, 0.0, 12.0))
    assert all(ball.motion in (Motion.STATIONARY, Motion.POCKETED) for ball in shot.balls.values())
    assert len(shot.records) < 500


def test_twenty_more_digits_change_nothing():
    rng = np.random.default_rng(5)
    positions = {0: (0.3, 1.7), **{i: (0.2 + 0.1 * i, 0.4 + 0.13 * i) for i in range(1, 8)}}
    stroke = Stroke(4.0, float(rng.uniform(250, 290)), 3.0, 2.0, 3.0)
    short, long = (from_truth(play(positions, stroke, digits=d).records) for d in (50, 70))
    both = partners(short, long)
    assert len(both) == len(short) == len(long)
    assert max(abs(p.time - q.time) for p, q in zip(short, both, strict=True)) < mpf("1e-30")
