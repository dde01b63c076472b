"""Seen: a ball that stopped within an ulp of a mouth line was left on it, and the next shot refused its table.

``crossing`` finds no root for a ball that stops short by rounding, and adding half the table's width rounded its place
onto the line. Expected: ``final`` is always a legal start (a ball is drawn 1e-16 m towards the centre if need be).
"""

import pytest

import physics

TABLE = physics.Table.olympiad().replace(cue_test=False)
CENTRE = physics.TableState.from_positions({0: (0.5 * TABLE.width, 0.5 * TABLE.length)})


def stop(v: float, phi: float) -> physics.TableState:
    return physics.simulate(TABLE, CENTRE, physics.Shot(v, phi), trace=False).final


@pytest.mark.parametrize("phi", [0.0, 1.25, 178.0, 180.0, 65.1, 114.9, 245.0, 294.8])
def test_a_ball_that_just_fails_to_drop_lies_legally(phi):
    """Bisect the speed to the last bit between stopping short and dropping; every end on the way is a legal start."""
    short, drops = 0.05, 3.0
    assert stop(short, phi).balls == (0,)
    assert stop(drops, phi).balls == ()
    while short < 0.5 * (short + drops) < drops:
        middle = 0.5 * (short + drops)
        end = stop(middle, phi)
        end.valid_on(TABLE)
        short, drops = (middle, drops) if end.balls else (short, middle)


def test_the_case_it_was_found_with():
    state = physics.TableState.from_positions({0: (0.5559108123501284, 1.2801854785303741)})
    shot = physics.Shot(0.36457885240713483, -16.968969308596428, 1.1848530052647317)
    physics.simulate(TABLE, state, shot).final.valid_on(TABLE)
