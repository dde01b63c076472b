"""Seen: a row of balls pressed against a cushion ended with EVENT_LIMIT on lossy tables.

Expected: every shot ends at rest. Why it did not: giving a slowly closing pair its mean speed moved the ball at the
cushion by 1e-20 m/s towards it, holding that ball there let the pair close by 1e-20 m/s again, and each asked for
another round.
"""

import pytest
from support.audit import audit
from support.play import OPEN

import physics

LOSSY = {"mu_roll": 0.001, "mu_spin": 0.001, "cushion_parallel": 0.0, "cushion_perpendicular": 0.0}
ROW_IN_THE_CORNER = {
    0: (0.2, 0.2),
    1: (0.25715, 0.2),
    2: (0.1595888474551888, 0.2404111525448112),
    3: (0.11917769491037762, 0.2808223050896224),
}
ROW_OF_FIVE = {
    0: (0.2, 0.2),
    1: (0.25715, 0.2),
    2: (0.31429999999999997, 0.2),
    3: (0.37144999999999995, 0.2),
    4: (0.4285999999999999, 0.2),
}


@pytest.mark.parametrize(
    ("table", "positions", "shot"),
    [
        (OPEN.replace(mu_ball=0.0, e_ball=0.95, **LOSSY), ROW_IN_THE_CORNER, physics.Shot(10.0, 135.0)),
        (
            OPEN.replace(mu_slide=0.01, mu_ball=0.06, e_ball=0.8, cushion_spin=0.0, **LOSSY),
            ROW_OF_FIVE,
            physics.Shot(10.0, 1.0, 70.0),
        ),
    ],
    ids=["three in line at the west cushion", "five in line"],
)
def test_it_ends_at_rest(table, positions, shot):
    state = physics.TableState.from_positions(positions)
    result = physics.simulate(table, state, shot)
    assert result.status is physics.Status.AT_REST
    worst = audit(table, state, result)
    assert worst.rise <= 1e-12
    assert worst.overlap <= 1e-12
