"""What a pocket accepts: the width of the fan of directions in which a rolling ball drops, by speed and approach.

A ball in natural roll starts at a distance from the middle of the mouth's line and is sent there and to both sides. The
fan is what drops without a gap round the middle; ``all`` counts what drops beyond it too, off the jaws.
``expected`` are the figures of an independent prototype with the same law, where there is one.
"""

from collections.abc import Iterator

import numpy as np

import physics
from benchmarks.command import main
from benchmarks.recording import ROOT, Row, Tables
from benchmarks.scenes import Floats

TABLE = physics.RealTable.of_size("nine_foot").replace(flight=False)
PICTURE = ROOT / "docs" / "acceptance.svg"

SW, W = 0, 1

APPROACHES = {
    "corner, diagonal": (SW, 225.0, 0.8),
    "corner, 30 deg off": (SW, 255.0, 0.8),
    "corner, down the rail": (SW, 270.0, 0.8),
    "side, straight": (W, 180.0, 0.5),
    "side, 60 deg": (W, 240.0, 0.5),
}
"""Pocket, direction of the ball's way (deg), and its length to the middle of the mouth's line (m)."""

EXPECTED = {
    "corner, diagonal": {0.8: 5.7, 2.0: 5.1, 5.0: 5.2},
    "corner, 30 deg off": {0.8: 9.1, 2.0: 3.9, 5.0: 3.7},
    "corner, down the rail": {0.8: 11.3, 2.0: 6.7, 5.0: 4.5},
    "side, straight": {0.8: 9.9, 2.0: 9.7, 5.0: 10.1},
    "side, 60 deg": {0.8: 2.1, 2.0: 2.3, 5.0: 2.9},
}
"""deg, by speed (m/s)."""

REACH, STEP = 15.0, 0.02
"""deg: how far to both sides, and how finely, directions are tried."""


def measure(full: bool) -> Tables:
    """The table, and the picture."""
    speeds = (0.8, 2.0, 5.0)
    rows = list(fans(speeds, STEP if full else 0.1))
    draw(list(fans(np.geomspace(0.6, 10.0, 25 if full else 7).tolist(), 0.05 if full else 0.2)))
    return {"acceptance": rows}


def fans(speeds: tuple[float, ...] | list[float], step: float) -> Iterator[Row]:
    """A row for each approach and speed."""
    for name, (pocket, degrees, distance) in APPROACHES.items():
        for speed in speeds:
            off, dropped = tried(pocket, degrees, distance, speed, step)
            yield {
                "approach": name,
                "speed": speed,
                "fan_deg": round(fan(off, dropped), 2),
                "all_deg": round(float(dropped.sum()) * step, 2),
                "expected_deg": EXPECTED[name].get(speed),
            }


def tried(pocket: int, degrees: float, distance: float, speed: float, step: float) -> tuple[Floats, Floats]:
    """(directions off the middle's, deg; which drop into the pocket)."""
    off = np.arange(-REACH, REACH + 0.5 * step, step)
    middle, way = TABLE.mouths[pocket], np.radians(degrees)
    place = middle - distance * np.array([np.cos(way), np.sin(way)])
    return off, np.array([drops(pocket, place, degrees + by, speed) for by in off.tolist()])


def drops(pocket: int, place: Floats, degrees: float, speed: float) -> bool:
    """Whether a ball sent rolling from ``place`` ends in the pocket."""
    positions, velocities, spins = np.full((16, 2), np.nan), np.zeros((16, 2)), np.zeros((16, 3))
    motion = np.full(16, physics.Motion.ABSENT, dtype=np.int8)
    vx, vy = speed * np.cos(np.radians(degrees)), speed * np.sin(np.radians(degrees))
    positions[1], velocities[1], motion[1] = place, (vx, vy), physics.Motion.ROLLING
    spins[1, :2] = -vy / TABLE.ball_radius, vx / TABLE.ball_radius
    result = physics.resume(TABLE, physics.Snapshot(0.0, positions, velocities, spins, motion), trace=False)
    return result.facts.pocket[1] == pocket


def fan(off: Floats, dropped: Floats) -> float:
    """Width of what drops without a gap round the middle, deg."""
    middle = len(off) // 2
    if not dropped[middle]:
        return 0.0
    misses = np.flatnonzero(~dropped)
    low, high = misses[misses < middle], misses[misses > middle]
    first = low[-1] + 1 if len(low) else 0
    last = high[0] - 1 if len(high) else len(off) - 1
    return float((last - first + 1) * (off[1] - off[0]))


def draw(rows: list[Row]) -> None:
    """Width of the fan over speed, a curve for each approach, written to ``docs``; needs matplotlib."""
    try:
        import matplotlib as mpl
    except ImportError:
        print("matplotlib is not installed: no picture")
        return
    mpl.use("svg")
    mpl.rcParams["svg.hashsalt"] = "pooliad"
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(7.0, 4.5))
    for name in APPROACHES:
        points = [(row["speed"], row["fan_deg"]) for row in rows if row["approach"] == name]
        axes.semilogx(*zip(*points, strict=True), "-", label=name)
        axes.plot(*zip(*EXPECTED[name].items(), strict=True), "o", color=axes.lines[-1].get_color())
    axes.set_xticks([0.6, 1, 2, 5, 10], ["0.6", "1", "2", "5", "10"])
    axes.set_xlabel("speed of the rolling ball at the start, m/s")
    axes.set_ylabel("accepted fan of directions, deg")
    axes.set_ylim(bottom=0.0)
    axes.grid(visible=True, which="major", alpha=0.3)
    axes.legend()
    figure.tight_layout()
    PICTURE.parent.mkdir(exist_ok=True)
    figure.savefig(PICTURE, metadata={"Date": None})
    plt.close(figure)


if __name__ == "__main__":
    main("acceptance", measure)
