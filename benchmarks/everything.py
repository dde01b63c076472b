"""An oracle for one shot: between its events everything is looked at against everything, without filter or broad phase.

From the states after each event every ball goes on along its parabola, worked out here from the motion states. On each
stretch up to the next event the least distance of each pair, and the greatest depth of each ball in each nose, facing,
horn and hole, are extrema of polynomials, all found. A contact that was missed is a depth; one that was invented, a
collision of things that are apart.
"""

import dataclasses

import numpy as np
from numpy.typing import NDArray

import physics
from benchmarks.pieces import FIRST_JAW, Pieces
from benchmarks.scenes import Floats
from physics import Motion

Ways = tuple[Floats, Floats, Floats]
"""c + b t + a t^2, each (..., 2)."""


@dataclasses.dataclass(frozen=True)
class Finding:
    """What the oracle found in one shot, m: each 0 where nothing is wrong, to rounding.

    Attributes:
        overlap: deepest overlap of two balls between any two events. beyond: deepest place in a nose, facing, horn or
            over a hole. apart: greatest gap at a collision.
        contacts: collisions and drops looked at.
    """

    overlap: float
    beyond: float
    apart: float
    contacts: int


def look_over(result: physics.Result, pieces: Pieces, most: int) -> Finding:
    """Look at the first ``most`` stretches of a shot and at their collisions."""
    events = list(result.events[:most])
    times = np.unique([event.time for event in events])
    ends = np.append(times[1:], times[-1] if result.n_events > most else result.duration)
    overlap = out = 0.0
    for start, end in zip(times.tolist(), ends.tolist(), strict=True):
        if end > start:
            ways, moving = paths(result.table, result.at(start))
            overlap = max(overlap, deepest_pair(ways, moving, end - start, 2.0 * result.table.ball_radius))
            out = max(out, deepest_in_pieces(tuple(x[moving] for x in ways), end - start, pieces))
    gaps = [gap for event in events if (gap := gap_at(event, result, pieces)) is not None]
    return Finding(overlap, out, max(gaps, default=0.0), len(gaps))


def paths(table: physics.Table, snapshot: physics.Snapshot) -> tuple[Ways, NDArray[np.bool_]]:
    """Parabolas of the balls on the table, (n, 2) each, and which of them move: cloth friction on slip or velocity."""
    here = ~np.isnan(snapshot.positions[:, 0])
    motion, velocity = snapshot.motion[here], snapshot.velocities[here]
    spin = snapshot.spins[here]
    slip = velocity + table.ball_radius * np.stack([-spin[:, 1], spin[:, 0]], axis=1)
    sliding, rolling = motion == Motion.SLIDING, motion == Motion.ROLLING
    against = np.where(sliding[:, None], slip, velocity)
    size = np.maximum(np.linalg.norm(against, axis=1, keepdims=True), 1e-300)
    friction = np.select([sliding, rolling], [table.mu_slide, table.mu_roll], 0.0)[:, None]
    half = -0.5 * table.gravity * friction * against / size
    return (snapshot.positions[here], velocity, half), sliding | rolling


def deepest_pair(ways: Ways, moving: NDArray[np.bool_], lasts: float, distance: float) -> float:
    """Deepest overlap of any two balls, one of which moves, within ``lasts``."""
    rows, columns = np.triu_indices(len(moving), 1)
    some = moving[rows] | moving[columns]
    rows, columns = rows[some], columns[some]
    return deepest_in_discs((x[rows] - x[columns] for x in ways), lasts, np.full(len(rows), distance))


def deepest_in_discs(between: object, lasts: float, reach: Floats) -> float:
    """How much nearer than ``reach`` (n,) paths (n, 2) come to the origin: at the ends or where d/dt |d|^2 = 0."""
    c, b, a = between  # type: ignore[misc]  # three arrays
    if len(c) == 0:
        return 0.0
    b, a = b * lasts, a * (lasts * lasts)  # times in units of ``lasts``
    dot = lambda p, q: (p * q).sum(axis=1)  # noqa: E731
    slope = np.stack([dot(b, c), dot(b, b) + 2.0 * dot(a, c), 3.0 * dot(a, b), 2.0 * dot(a, a)], axis=1)
    at = np.concatenate([np.broadcast_to([0.0, 1.0], (len(c), 2)), extrema(slope)], axis=1)
    places = c[:, None] + at[..., None] * (b[:, None] + at[..., None] * a[:, None])
    depth = reach[:, None] - np.linalg.norm(places, axis=2)
    return max(0.0, float(depth.max()))


def extrema(slope: Floats) -> Floats:
    """(n, 3): where cubics (n, 4), ascending, vanish on [0, 1]; 0 where they do not."""
    size = np.abs(slope).max(axis=1, keepdims=True)
    scaled = slope / np.where(size > 0.0, size, 1.0)
    # Reversed, so that no leading coefficient is divided by: roots 1/t of c0 s^3 + c1 s^2 + c2 s + c3. Where c0 = 0
    # one root is t = 0, an end; it is made tiny instead.
    first = np.where(np.abs(scaled[:, :1]) < 1e-14, 1e-14, scaled[:, :1])
    companion = np.zeros((len(slope), 3, 3))
    companion[:, 0] = -scaled[:, 1:] / first
    companion[:, 1, 0] = companion[:, 2, 1] = 1.0
    inverse = np.linalg.eigvals(companion)
    with np.errstate(divide="ignore", invalid="ignore"):
        t = np.where(np.abs(inverse) > 0.0, 1.0 / inverse, 0.0)
    # A double root may come out as a pair off the real line: its real part is the extremum then.
    real = np.where(np.isfinite(t.real) & (t.real >= 0.0) & (t.real <= 1.0), t.real, 0.0)
    return np.asarray(polished(slope, real))


def polished(slope: Floats, t: Floats) -> Floats:
    """Two steps of Newton, kept on [0, 1]."""
    for _ in range(2):
        c0, c1, c2, c3 = (slope[:, k, None] for k in range(4))
        value, rise = c0 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0 * c2 + t * 3.0 * c3)
        with np.errstate(divide="ignore", invalid="ignore"):
            moved = np.where(rise != 0.0, t - value / rise, t)
        t = np.where(np.isfinite(moved), np.clip(moved, 0.0, 1.0), t)
    return t


def deepest_in_pieces(ways: Ways, lasts: float, pieces: Pieces) -> float:
    """Deepest that any path gets into a piece."""
    if len(ways[0]) == 0:
        return 0.0
    return max(
        deepest_in_strips(ways, lasts, pieces),
        deepest_in_circles(ways, lasts, pieces.horns, np.full(len(pieces.horns), pieces.horn_radius + pieces.rho)),
        deepest_in_circles(ways, lasts, pieces.holes, pieces.hole_radii),
    )


def deepest_in_circles(ways: Ways, lasts: float, centres: Floats, reach: Floats) -> float:
    """Every path against every circle."""
    c, b, a = ways
    n, m = len(c), len(centres)
    from_centres = (c[:, None] - centres).reshape(n * m, 2)
    return deepest_in_discs((from_centres, *(np.repeat(x, m, axis=0) for x in (b, a))), lasts, np.tile(reach, n))


def deepest_in_strips(ways: Ways, lasts: float, pieces: Pieces) -> float:
    """Every path against every nose and facing: at both ends, the gap's vertex, and where the foot passes an end."""
    c, b, a = (x[:, None] for x in ways)
    from_start = c - pieces.starts
    gap = [(x * pieces.normals).sum(axis=2) for x in (from_start, b, a)]
    foot = [(x * pieces.ways).sum(axis=2) for x in (from_start, b, a)]
    with np.errstate(divide="ignore", invalid="ignore"):
        vertex = -gap[1] / (2.0 * gap[2])
    far = [foot[0] - pieces.lengths, foot[1], foot[2]]
    instants = [np.zeros_like(vertex), np.full_like(vertex, lasts), vertex, *zeros(foot), *zeros(far)]
    depth = -np.inf
    for t in instants:
        t = np.where((t >= 0.0) & (t <= lasts), t, 0.0)
        along = foot[0] + t * (foot[1] + t * foot[2])
        beside = (along >= 0.0) & (along <= pieces.lengths)
        here = pieces.rho - (gap[0] + t * (gap[1] + t * gap[2]))
        depth = max(depth, float(np.where(beside, here, -np.inf).max()))
    return max(0.0, depth)


def zeros(p: list[Floats]) -> tuple[Floats, Floats]:
    """Both roots of p0 + p1 t + p2 t^2, NaN where there are none."""
    p0, p1, p2 = p
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        root = np.sqrt(p1 * p1 - 4.0 * p0 * p2)
        q = -0.5 * (p1 + np.where(p1 >= 0.0, root, -root))
        return q / p2, p0 / q


def gap_at(event: physics.Event, result: physics.Result, pieces: Pieces) -> float | None:
    """Gap between the bodies of a collision, or of a ball that drops from its edge, 0 if they overlap; else None."""
    place = np.array(event.states[0].position)
    match event.kind:
        case physics.EventKind.BALL_COLLISION:
            other = np.array(event.states[1].position)
            gap = float(np.linalg.norm(place - other)) - 2.0 * result.table.ball_radius
        case physics.EventKind.RAIL_COLLISION | physics.EventKind.JAW_COLLISION:
            jaw = event.kind is physics.EventKind.JAW_COLLISION
            gap = gap_to_wall(pieces, place, event.other + FIRST_JAW * jaw)
        case physics.EventKind.POCKET_COLLISION:
            hole = float(np.linalg.norm(place - pieces.holes[event.other]))
            gap = abs(hole - float(pieces.hole_radii[event.other]))
        case _:
            return None
    return max(0.0, gap)


def gap_to_wall(pieces: Pieces, place: Floats, number: int) -> float:
    """From a centre at its contact distance to the pieces of a cushion or jaw."""
    from_start = place - pieces.starts
    along, gap = (from_start * pieces.ways).sum(axis=1), (from_start * pieces.normals).sum(axis=1) - pieces.rho
    beside = (along >= -1e-12) & (along <= pieces.lengths + 1e-12) & (pieces.strip_numbers == number)
    gaps = [float(gap[beside].min())] if beside.any() else []
    if number >= FIRST_JAW:
        horn = pieces.horns[number - FIRST_JAW]
        gaps.append(float(np.linalg.norm(place - horn)) - pieces.horn_radius - pieces.rho)
    return min(gaps, default=np.inf)
