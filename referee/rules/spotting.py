"""R30 and R31: which balls are spotted, and exactly where."""

from fractions import Fraction
from math import inf, nextafter, sqrt
from typing import Final

from physics.state import TableState
from physics.table import Table
from referee.game import EIGHT, Phase
from referee.rules.stroke_facts import CUE_BALL, StrokeFacts

SPOT_GAP: Final = 1e-6
"""m, least gap between a spotted ball and the cue ball: far above the 1e-9 m that counts as touching, and a
fifty-thousandth of a ball's width."""


def spotted_balls(stroke: StrokeFacts) -> tuple[int, ...]:
    """R30: only the 8 is ever spotted, and only when it left play on the break."""
    if stroke.game.phase is Phase.BREAK and (stroke.eight_pocketed or stroke.eight_off_table):
        return (EIGHT,)
    return ()


def spot(table: Table, state: TableState, ball: int = EIGHT) -> TableState:
    """R31: put ``ball`` on the foot spot or as near to it as possible on the long string.

    Behind the spot (towards the foot cushion) is tried first, then in front of it. Another object ball may be
    touched but not overlapped: the place is the nearest double at which the exact distance is at least 2R.
    The cue ball keeps ``SPOT_GAP`` of room. Sixteen balls cannot cover the string, so a place always exists.
    """
    others = state.removed(ball)
    x, _ = table.foot_spot
    return others.moved(ball, (x, _nearest_free(table, _blockers(table, others))))


_Blocker = tuple[Fraction, float, float]
"""A ball in the way: its exact offset across the string, its y, and the distance to keep, m."""


def _blockers(table: Table, state: TableState) -> list[_Blocker]:
    x = Fraction(table.foot_spot[0])
    diameter = 2.0 * table.ball_radius
    blockers = []
    for other in state.balls:
        ball_x, ball_y = state.positions[other].tolist()
        keep = diameter + SPOT_GAP if other == CUE_BALL else diameter
        if abs(across := Fraction(ball_x) - x) < keep:
            blockers.append((across, ball_y, keep))
    return blockers


def _nearest_free(table: Table, blockers: list[_Blocker]) -> float:
    _, foot = table.foot_spot
    behind = _walk(foot, blockers, -1)
    return behind if behind >= table.ball_radius else _walk(foot, blockers, +1)


def _walk(y: float, blockers: list[_Blocker], direction: int) -> float:
    """The first free y from ``y`` on in ``direction``: step over one blocker after the other."""
    while (blocker := next((one for one in blockers if _overlaps(y, one)), None)) is not None:
        y = _edge(blocker, direction)
    return y


def _edge(blocker: _Blocker, direction: int) -> float:
    """The nearest double beyond ``blocker``, on its side in ``direction``, that does not overlap it."""
    across, ball_y, keep = blocker
    y = ball_y + direction * sqrt(keep * keep - float(across) ** 2)
    outwards, inwards = direction * inf, -direction * inf
    while _overlaps(y, blocker):
        y = nextafter(y, outwards)
    while not _overlaps(closer := nextafter(y, inwards), blocker):
        y = closer
    return y


def _overlaps(y: float, blocker: _Blocker) -> bool:
    """Whether a ball at ``y`` on the string is nearer than allowed, in exact arithmetic."""
    across, ball_y, keep = blocker
    along = Fraction(y) - Fraction(ball_y)
    return across * across + along * along < Fraction(keep) ** 2
