"""Racks: the balls of a game as its rules ask, the free choices and a hair's breadth of disorder from a seed."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from physics.constants import N_BALLS, PLACEMENT_TOLERANCE
from physics.errors import InvalidState
from physics.generator import SeededStream
from physics.state import TableState
from physics.table import Table

JITTER: Final = 4.8e-7
"""m, standard deviation of a racked ball's coordinates, as at the Olympiad: a sixth of its 2.8575e-6 m gap.
Without it the same break would do the same to every rack; with more, neighbours would overlap."""

_JITTER_PER_GAP: Final = 0.168
"""The most jitter for the gap: tighter racks than the Olympiad's get less, or they could not be drawn."""

_APEX: Final = 0
_MIDDLE: Final = 4
"""Middle of the third row; places are counted from the apex, row by row, from west to east."""
_CORNERS: Final = (10, 14)
_CORNERS_OF_TEN: Final = (6, 9)
_REDRAWS: Final = 64
"""Draws of the disorder before the exact lattice is taken. One in some 3,000 leaves two balls overlapping;
this last resort is never seen, it only makes the end of the loop certain."""


@dataclass(frozen=True, slots=True)
class _Rack:
    """Balls in each row from the apex on, and which ball lies at each place."""

    rows: tuple[int, ...]
    arrange: Callable[[SeededStream], list[int]]


def rack(table: Table, game: str = "eight_ball", *, seed: int | bytes, gap: float | None = None) -> TableState:
    """The balls racked for a break, the cue ball just behind the head string at (W/2, 3L/4 + R).

    The apex lies on the foot spot; what the rules of the game leave open is drawn, every arrangement equally likely.
    Neighbours are ``gap`` apart on average, each ball jittered by a Gaussian of ``JITTER`` in x and y (less in a
    tighter rack), drawn again until no two balls touch.

    Args:
        table: its foot spot and, by default, its gap.
        game: ``"eight_ball"``: the 8 in the middle of the third row, a solid and a stripe in the two back corners;
            ``"nine_ball"``: balls 1 to 9 in a diamond, the 1 at the apex, the 9 in the middle; ``"ten_ball"``: balls 1
            to 10, the 1 at the apex, the 10 in the middle of the third row, the 2 and the 3 in the back corners;
            ``"straight_pool"``: all fifteen in any order (rules of the World Pool-Billiard Association).
        seed: an integer in [0, 2^256) or bytes; the same seed gives the same rack, bit for bit.
        gap: m, in [0, 1e-3]. At most ``PLACEMENT_TOLERANCE`` (0, say) gives the exactly touching rack.

    Returns:
        The balls of the game and the cue ball.

    Raises:
        InvalidState: an unknown game, a seed or a gap that is not allowed.
    """
    if game not in _RACKS:
        raise InvalidState("game", game, f"must be one of {', '.join(_RACKS)}")
    layout = _RACKS[game]
    gap = _checked_gap(table.rack_gap if gap is None else gap)
    stream = SeededStream(_key(seed), f"pooliad/1 rack {game}")
    order = layout.arrange(stream)
    places = _lattice(table, layout.rows, gap)
    if gap > PLACEMENT_TOLERANCE:
        places = _jittered(places, jitter_of(gap), 2.0 * table.ball_radius, stream)
    positions = np.full((N_BALLS, 2), np.nan)
    positions[order] = places
    positions[0] = (0.5 * table.width, table.head_string + table.ball_radius)
    return TableState.from_positions(positions)


def jitter_of(gap: float) -> float:
    """Standard deviation of a racked ball's coordinates for the gap between neighbours, both m."""
    return min(JITTER, _JITTER_PER_GAP * gap) if gap > PLACEMENT_TOLERANCE else 0.0


def _eight_ball(stream: SeededStream) -> list[int]:
    """The ball of each of the fifteen places (R2, R3, R4)."""
    solid, stripe = 1 + stream.below(7), 9 + stream.below(7)
    corners = [solid, stripe]
    stream.shuffle(corners)
    west, east = _CORNERS
    return _filled(15, {_MIDDLE: 8, west: corners[0], east: corners[1]}, stream)


def _nine_ball(stream: SeededStream) -> list[int]:
    """Rules of the WPA: the 1 at the apex, the 9 in the middle."""
    return _filled(9, {_APEX: 1, _MIDDLE: 9}, stream)


def _ten_ball(stream: SeededStream) -> list[int]:
    """Rules of the WPA: the 1 at the apex, the 10 in the middle, the 2 and the 3 in the back corners."""
    corners = [2, 3]
    stream.shuffle(corners)
    west, east = _CORNERS_OF_TEN
    return _filled(10, {_APEX: 1, _MIDDLE: 10, west: corners[0], east: corners[1]}, stream)


def _straight_pool(stream: SeededStream) -> list[int]:
    """Rules of the WPA: in any order."""
    return _filled(15, {}, stream)


def _filled(count: int, fixed: Mapping[int, int], stream: SeededStream) -> list[int]:
    """The ball of each place: ``fixed`` by place, the others of 1 to ``count`` at random."""
    others = [ball for ball in range(1, count + 1) if ball not in fixed.values()]
    stream.shuffle(others)
    rest = iter(others)
    return [fixed[place] if place in fixed else next(rest) for place in range(count)]


_RACKS: Final[Mapping[str, _Rack]] = {
    "eight_ball": _Rack((1, 2, 3, 4, 5), _eight_ball),
    "nine_ball": _Rack((1, 2, 3, 2, 1), _nine_ball),
    "ten_ball": _Rack((1, 2, 3, 4), _ten_ball),
    "straight_pool": _Rack((1, 2, 3, 4, 5), _straight_pool),
}


def _lattice(table: Table, rows: tuple[int, ...], gap: float) -> NDArray[np.float64]:
    """(n, 2) m: the places with ``gap`` between neighbours, from the foot spot towards y = 0 (R1, R5)."""
    spacing = 2.0 * table.ball_radius + gap
    depth = spacing * (0.5 * math.sqrt(3.0))
    x, y = table.foot_spot
    return np.array(
        [
            (x + (column - 0.5 * (balls - 1)) * spacing, y - row * depth)
            for row, balls in enumerate(rows)
            for column in range(balls)
        ]
    )


def _jittered(places: NDArray[np.float64], sigma: float, diameter: float, stream: SeededStream) -> NDArray[np.float64]:
    """The places moved at random: x then y of each in order, all drawn again while any two balls touch."""
    for _ in range(_REDRAWS):
        draws = [sigma * stream.gaussian() for _ in range(places.size)]
        moved: NDArray[np.float64] = places + np.array(draws).reshape(places.shape)
        if _are_clear(moved, diameter):
            return moved
    return places


def _are_clear(places: NDArray[np.float64], diameter: float) -> bool:
    dx, dy = (places[:, None, :] - places[None, :, :]).transpose(2, 0, 1)
    squared = dx * dx + dy * dy
    np.fill_diagonal(squared, math.inf)
    return bool((squared > diameter * diameter).all())


def _checked_gap(gap: float) -> float:
    if isinstance(gap, bool) or not isinstance(gap, int | float) or not 0.0 <= gap <= 1e-3:
        raise InvalidState("gap", gap, "must be in [0, 0.001] m")
    return gap


def _key(seed: int | bytes) -> bytes:
    """The generator's key: bytes as they are, an integer as 32 bytes big-endian."""
    if isinstance(seed, bytes):
        return seed
    if isinstance(seed, bool) or not isinstance(seed, int) or not 0 <= seed < 1 << 256:
        raise InvalidState("seed", seed, "must be bytes or an integer in [0, 2**256)")
    return seed.to_bytes(32, "big")
