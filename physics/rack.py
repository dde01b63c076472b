"""The rack: fifteen balls as the rules ask, the free choices and a hair's breadth of disorder from a seed."""

import math
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

_ROWS: Final = 5
_EIGHT_PLACE: Final = 4
"""Middle of the third row; places are counted from the apex, row by row, from west to east."""
_CORNERS: Final = (10, 14)
_REDRAWS: Final = 64
"""Draws of the disorder before the exact lattice is taken. One in some 3,000 leaves two balls overlapping;
this last resort is never seen, it only makes the end of the loop certain."""


def rack(table: Table, game: str = "eight_ball", *, seed: int | bytes, gap: float | None = None) -> TableState:
    """The balls racked for a break, the cue ball just behind the head string at (W/2, 3L/4 + R).

    The apex lies on the foot spot, the 8 in the middle of the third row, a solid and a stripe in the two back
    corners; every arrangement that fulfils this is equally likely. Neighbours are ``gap`` apart on average,
    each ball jittered by a Gaussian of ``JITTER`` in x and y (less in a tighter rack), drawn again until no
    two balls touch.

    Args:
        table: its foot spot and, by default, its gap.
        game: ``"eight_ball"``, the only rack so far.
        seed: an integer in [0, 2^256) or bytes; the same seed gives the same rack, bit for bit.
        gap: m, in [0, 1e-3]. At most ``PLACEMENT_TOLERANCE`` (0, say) gives the exactly touching rack.

    Returns:
        All sixteen balls.

    Raises:
        InvalidState: an unknown game, a seed or a gap that is not allowed.
    """
    if game != "eight_ball":
        raise InvalidState("game", game, "must be 'eight_ball'")
    gap = _checked_gap(table.rack_gap if gap is None else gap)
    stream = SeededStream(_key(seed), f"pooliad/1 rack {game}")
    order = _arrangement(stream)
    places = _lattice(table, gap)
    if gap > PLACEMENT_TOLERANCE:
        places = _jittered(places, jitter_of(gap), 2.0 * table.ball_radius, stream)
    positions = np.empty((N_BALLS, 2))
    positions[order] = places
    positions[0] = (0.5 * table.width, table.head_string + table.ball_radius)
    return TableState.from_positions(positions)


def jitter_of(gap: float) -> float:
    """Standard deviation of a racked ball's coordinates for the gap between neighbours, both m."""
    return min(JITTER, _JITTER_PER_GAP * gap) if gap > PLACEMENT_TOLERANCE else 0.0


def _arrangement(stream: SeededStream) -> list[int]:
    """The ball of each of the fifteen places (R2, R3, R4)."""
    solid, stripe = 1 + stream.below(7), 9 + stream.below(7)
    corners = [solid, stripe]
    stream.shuffle(corners)
    others = [ball for ball in range(1, N_BALLS) if ball not in (8, solid, stripe)]
    stream.shuffle(others)
    order = [0] * (N_BALLS - 1)
    order[_EIGHT_PLACE] = 8
    for place, ball in zip(_CORNERS, corners, strict=True):
        order[place] = ball
    free = (place for place, ball in enumerate(order) if ball == 0)
    for place, ball in zip(free, others, strict=True):
        order[place] = ball
    return order


def _lattice(table: Table, gap: float) -> NDArray[np.float64]:
    """(15, 2) m: the places with ``gap`` between neighbours, from the foot spot towards y = 0 (R1, R5)."""
    spacing = 2.0 * table.ball_radius + gap
    depth = spacing * (0.5 * math.sqrt(3.0))
    x, y = table.foot_spot
    return np.array(
        [(x + (column - 0.5 * row) * spacing, y - row * depth) for row in range(_ROWS) for column in range(row + 1)]
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
