"""What flight costs where nothing flies and where something does, what skipping saves, and what hangs on parameters
that nobody measured.
"""

import statistics
from collections.abc import Iterator

import numpy as np

import physics
from benchmarks import real_tables, scenes, timing, unfiltered, variants
from benchmarks.recording import Row
from benchmarks.scenes import Floats

Workload = real_tables.Workload

FLYING = physics.RealTable.of_size("nine_foot").replace(cue_test=False)
FLAT = FLYING.replace(flight=False)

CHOICES = {
    "e_cloth": (0.4, 0.6),
    "e_strike": (0.3, 0.7),
    "e_pressed": (0.2, 0.4),
    "e_rail": (0.3, 0.7),
    "mu_rail": (0.1, 0.4),
}
"""Parameters of flight that are choices, or of one source, and values on either side."""


def levelled(table: physics.RealTable, n: int, balls: int) -> tuple[Floats, Floats]:
    """Mid-game shots with a level cue at the middle's height: nothing leaves the cloth."""
    states, shots = scenes.playable_mid_game(table, np.random.default_rng(20), n, balls)
    shots[:, [2, 4]] = 0.0
    return states, shots


def raised(states: Floats, shots: Floats) -> Floats:
    """The same strokes with the cue raised by 30 to 50 degrees and 3 to 6 m/s: each one jumps."""
    rng, jumps = np.random.default_rng(21), shots.copy()
    jumps[:, 2], jumps[:, 3], jumps[:, 4] = rng.uniform(30.0, 50.0, len(jumps)), 0.0, 10.0
    jumps[:, 0] = rng.uniform(3.0, 6.0, len(jumps))
    return jumps


def costs(n: int, pairs: int) -> Iterator[Row]:
    """Flat shots on a table that flies beside the same without flight; events of jumps beside events of flat shots."""
    for balls in (2, 8):
        states, shots = levelled(FLYING, n, balls)
        flat, flying = (FLAT, states, shots), (FLYING, states, shots)
        grounded = physics.simulate_batch(*flying)
        same = bool((physics.simulate_batch(*flat).positions.tobytes()) == grounded.positions.tobytes())
        yield beside(f"{balls} balls, level cue: flight against none", flat, flying, pairs) | {"same_bits": same}
        yield beside(f"{balls} balls: jumps against level cue", flat, (FLYING, states, raised(states, shots)), pairs)


def beside(name: str, base: Workload, now: Workload, pairs: int) -> Row:
    """CPU time an event of two workloads, run in turn."""
    events = [float(physics.simulate_batch(*work).n_events.sum()) for work in (base, now)]
    seconds = [[real_tables.seconds_of(work) for work in (base, now)] for _ in range(pairs)]
    one, other = (statistics.median(row[place] for row in seconds) for place in (0, 1))
    ratio = statistics.median(row[1] / row[0] for row in seconds)
    return {
        "scene": name,
        "shots": len(base[2]),
        "base_events": round(events[0] / len(base[2]), 2),
        "events": round(events[1] / len(now[2]), 2),
        "base_ns_per_event": round(1e9 * one / events[0], 1),
        "ns_per_event": round(1e9 * other / events[1], 1),
        "ratio_per_event": round(ratio * events[0] / events[1], 3),
        "same_bits": None,
    }


def scenes_saved(n: int) -> Iterator[tuple[str, Workload]]:
    """Level shots and jumps among 8 and 16 balls."""
    for balls in (8, 16):
        states, shots = levelled(FLYING, n, balls)
        yield f"{balls} balls, level cue", (FLYING, states, shots)
        yield f"{balls} balls, jumps", (FLYING, states, raised(states, shots))


def savings(n: int) -> Iterator[Row]:
    """Work an event, counted; and how many times its cost it costs without filter and broad phase."""
    usual = costs_of_events(n)
    without = variants.run(f"{unfiltered.__name__}:look_at_everything", f"{__name__}:costs_of_events", n)
    for name, (table, states, shots) in scenes_saved(n):
        counts = np.zeros((len(shots), 4), np.int64)
        events = int(physics.simulate_batch(table, states, shots, counters=counts).n_events.sum())
        looks, left, solved, boundary = (counts.sum(axis=0) / events).tolist()
        others = (~np.isnan(states[:, :, 0])).sum(axis=1) - 1
        yield {
            "scene": name,
            "events_per_shot": round(events / len(shots), 2),
            "predictions": round(looks, 3),
            "pairs_seen": round(float((counts[:, 0] * others).sum() / events), 2),
            "left_by_filter": round(left, 3),
            "solved": round(solved, 3),
            "boundary_looks": round(boundary, 3),
            "without_filter_and_broad_phase": round(without[name] / usual[name], 2),
        }


def costs_of_events(n: int) -> dict[str, float]:
    """Pairs an event by scene, in the process it runs in."""
    found = {}
    for name, work in scenes_saved(n):
        events = int(physics.simulate_batch(*work).n_events.sum())
        found[name] = timing.in_pairs(lambda work=work: physics.simulate_batch(*work), 5)[1] / events  # type: ignore[misc]
    return found


def choices(n: int) -> Iterator[Row]:
    """Jumps and level shots with each parameter changed: balls driven off, highest point, shots that end otherwise."""
    states, shots = levelled(FLYING, n, 8)
    jumps = raised(states, shots)
    usual = [physics.simulate_batch(FLYING, states, strokes) for strokes in (shots, jumps)]
    yield choice("as shipped", FLYING, states, (shots, jumps), usual)
    for name, values in CHOICES.items():
        for value in values:
            table = FLYING.replace(**{name: value})
            yield choice(f"{name} = {value}", table, states, (shots, jumps), usual)


def choice(
    name: str, table: physics.RealTable, states: Floats, strokes: tuple[Floats, Floats], usual: list[physics.Batch]
) -> Row:
    """One table beside the shipped one."""
    level, jumped = (physics.simulate_batch(table, states, shots) for shots in strokes)
    tops = [highest(table, state, shot) for state, shot in zip(states[:50], strokes[1][:50], strict=True)]
    return {
        "choice": name,
        "level_shots_that_end_otherwise": share_changed(level, usual[0]),
        "jumps_that_end_otherwise": share_changed(jumped, usual[1]),
        "off_table_per_jump": round(float((jumped.facts["off_table"] >= 0).sum() / len(states)), 4),
        "pocketed_per_jump": round(float((jumped.pocket >= 0).sum() / len(states)), 4),
        "median_highest_mm": round(1e3 * statistics.median(tops), 1),
    }


def share_changed(batch: physics.Batch, usual: physics.Batch) -> float:
    """Share of shots after which a ball lies more than a millimetre elsewhere, or on the table in one alone."""
    apart = np.abs(batch.positions - usual.positions)
    moved = (apart > 1e-3).any(axis=(1, 2)) | (np.isnan(batch.positions) != np.isnan(usual.positions)).any(axis=(1, 2))
    return round(float(moved.mean()), 4)


def highest(table: physics.RealTable, state: Floats, shot: Floats) -> float:
    """Highest point of the cue ball over where it rests, m, in the half second after the strike."""
    result = physics.simulate(table, physics.TableState.trusted(state.copy()), physics.Shot(*shot.tolist()))
    heights = result.paths(np.linspace(0.0, min(0.5, result.duration), 100))[1][:, 0]
    return float(np.nanmax(heights))
