"""``Table.fastfiz()`` against the 332 recorded shots of the historical engine (../shared/data/README.md).

Compared over each shot's stable events: those that keep type, balls, place and time when phi moves by 1e-10 deg and v
by 1e-12. Times to 1e-9 s; where the corpus itself measured a larger sensitivity (``stable_dt``), to that: such a shot
enlarges the 1e-11 m by which the historical engine pushes overlapping balls apart. The corpus holds no collision with
a ball that spins in place: ``test_ball_ball.py`` has those.
"""

from functools import cache

import pytest
from support.require import reference_shots

import physics

KINDS = {"CUE": "cue_strike", "BALL": "ball_collision", "RAIL": "rail_collision", "POCKET": "pocket_collision"}
POCKETS = {"SW": 0, "W": 1, "NW": 2, "NE": 3, "E": 4, "SE": 5}
SHOT_KINDS = (
    *("break", "random", "english", "draw", "follow", "elevated", "rail_first", "bank_pot", "pot"),
    *("frozen_pair", "lone", "straight_exact"),
)


@cache
def corpus():
    return reference_shots()


def simulated(entry):
    """The recorded shot played by this engine."""
    s = entry["shot"]
    state = physics.TableState.from_positions({b: (x, y) for b, x, y in entry["balls"]})
    shot = physics.Shot(s["v_mps"], s["phi_deg"], s["theta_deg"], s["a_mm"], s["b_mm"])
    return physics.simulate(physics.Table.fastfiz(), state, shot)


def tells(record, event):
    """Is this the recorded event?"""
    kind = KINDS.get(record["e"])
    if kind is None:
        return event.ball == record["b"] and event.kind.value.split("_")[0] in {"sliding", "rolling", "spinning"}
    balls = {record["b"], record.get("b2", record["b"])}
    return event.kind.value == kind and balls == {state.ball for state in event.states}


def paired(entry, events):
    """Each stable recorded event with its counterpart or None, ending at the first None; order may differ in ties."""
    waiting = list(events)
    for index, record in enumerate(entry["events"][: entry["stable_events"]]):
        event = next((e for e in waiting[:8] if tells(record, e)), None)
        yield index, record, event
        if event is None:
            return
        waiting.remove(event)


def complaints(entry, judge):
    """What ``judge(record, event)`` finds wrong over the stable events, told with shot and event."""
    for index, record, event in paired(entry, simulated(entry).events):
        wrong = "is missing" if event is None else judge(record, event)
        if wrong:
            yield f"shot {entry['id']} ({entry['kind']}) event {index}: {record['e']} of ball {record['b']} {wrong}"


def tolerance(entry):
    return max(1e-9, entry["stable_dt"])


def shots_of(kind):
    return [entry for entry in corpus() if entry["kind"] == kind]


@pytest.mark.parametrize("kind", SHOT_KINDS)
def test_same_events_at_the_same_times(kind):
    wrong = []
    for entry in shots_of(kind):
        within = tolerance(entry)

        def judge(record, event, within=within):
            late = abs(event.time - record["t"])
            return f"is {late:.2e} s off, allowed {within:.1e}" if late > within else None

        wrong += complaints(entry, judge)
    assert not wrong, "\n".join(wrong[:20])


@pytest.mark.parametrize("kind", SHOT_KINDS)
def test_same_places_velocities_and_spins(kind):
    wrong = []
    for entry in shots_of(kind):
        within = 20.0 * tolerance(entry)

        def judge(record, event, within=within):
            states = {state.ball: state for state in event.states}
            pocketed = record["e"] == "POCKET"
            off = max(
                difference(states[record[ball]], record[after], pocketed=pocketed)
                for ball, after in (("b", "post"), ("b2", "post2"))
                if ball in record
            )
            return f"is {off:.2e} off, allowed {within:.1e}" if off > within else None

        wrong += complaints(entry, judge)
    assert not wrong, "\n".join(wrong[:20])


def difference(state, after, *, pocketed):
    """Largest difference of position (m), velocity (m/s) and surface speed of the spin (m/s)."""
    radius = physics.Table.fastfiz().ball_radius
    place = [abs(p - q) for p, q in zip(state.position, after[:2], strict=True)]
    if pocketed:
        return max(place)
    speed = [abs(p - q) for p, q in zip(state.velocity, after[2:4], strict=True)]
    spin = [abs(p - q) * radius for p, q in zip(state.spin, after[4:7], strict=True)]
    return max(place + speed + spin)


def test_three_shots_in_four_are_held_to_a_nanosecond():
    """Only the others, which one part in 10^12 of the speed already moves by more, have a tolerance of their own."""
    assert len(corpus()) == 332
    assert sum(entry["stable_dt"] <= 1e-9 for entry in corpus()) == 247


def test_pockets_are_the_recorded_ones():
    wrong = []
    for entry in corpus():
        wrong += complaints(entry, other_pocket)
    assert not wrong, wrong


def other_pocket(record, event):
    if record["e"] == "POCKET" and event.other != POCKETS[record["post"][7].removeprefix("POCKETED_")]:
        return f"is in pocket {event.other}"
    return None


def test_final_positions_of_steady_shots():
    """Shots whose every event is stable to a nanosecond end where the historical engine's ended."""
    steady = [e for e in corpus() if e["stable_events"] == len(e["events"]) and e["stable_dt"] <= 1e-9]
    assert len(steady) > 200
    for entry in steady:
        result = simulated(entry)
        assert abs(result.duration - entry["duration"]) <= 1e-9, entry["id"]
        for ball, x, y, state in entry["final"]:
            place = result.final.position(ball)
            assert (place is None) == state.startswith("POCKETED"), (entry["id"], ball)
            off = max(abs(place[0] - x), abs(place[1] - y)) if place else 0.0
            assert off <= 2e-8, (entry["id"], ball, off)
