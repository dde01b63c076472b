"""Every loop of the kernels that might not end has a cap, and every cap an exit with a name (docs/physics.md).

Caps are far beyond what shots need, so each is lowered in a process of its own, where the kernels run as plain Python,
until the shot at hand reaches it. What is asserted is the exit's name and what the caller is left with.
"""

import math
import os
from typing import Any

import numpy as np
import pytest
from support.moving import Launch, let_go

import physics
from benchmarks import variants
from physics.kernels import layout as at

TOLERANCES = "physics.kernels.tolerances"
HERE = "test_caps"
R = 0.028575


def lower(name: str, value: int, *_: Any) -> None:
    """In a new process, before the kernels load."""
    variants.replace(TOLERANCES, name, value)


def ended(result: physics.Result) -> dict[str, Any]:
    """How the event loop of the last shot ended, and what the caller sees."""
    from physics.engine import workspace

    integers = workspace()[0, at.W_SIZE :].view(np.int64)
    return {
        "ended": int(integers[at.ENDED]),
        "status": result.status.name,
        "n_events": result.n_events,
        "duration": result.duration,
        "last": result.events[-1].time,
        "lying": result.final.positions[:16].tolist(),
    }


def break_shot(*_: Any) -> dict[str, Any]:
    """A break of some hundred events, 20 of them allowed."""
    table, shot = physics.Table.olympiad(), physics.Shot(8.0, 270.0, 10.0)
    return ended(physics.simulate(table, physics.rack(table, "eight_ball", seed=1), shot, event_limit=20))


def cradle(*_: Any) -> dict[str, Any]:
    """Three touching balls, struck in line: several rounds of the contact rule at one instant."""
    line = {i: Launch((0.5, 0.6 - i * 2 * R)) for i in (1, 2, 3)}
    return ended(let_go(physics.Table.olympiad(), {0: Launch((0.5, 0.7), (0.0, -1.0)), **line}))


def struck_cluster(*_: Any) -> dict[str, Any]:
    """A cue ball frozen to a row and struck into it: rounds before the first event."""
    table = physics.Table.olympiad()
    row = {i: (0.5, 1.0 - i * 2 * R) for i in range(4)}
    return ended(physics.simulate(table, physics.TableState.from_positions(row), physics.Shot(2.0, 270.0, 10.0)))


def solve(_name: str, _value: int, *numbers: float) -> tuple[float, int]:
    """Time and exit of the contact solver: a relative path, t_max, limit."""
    from physics.kernels.detect.contact import contact
    from physics.kernels.path import Path

    found = contact(Path(*numbers[:6]), numbers[6], numbers[7], 2 * R)
    return float(found.time), int(found.ended)


def run(name: str, value: int, task: str, *arguments: Any) -> Any:
    """``task`` where the tolerance ``name`` is ``value``."""
    return variants.run(f"{HERE}:lower", f"{HERE}:{task}", name, value, *arguments, interpreted=True)


@pytest.fixture(autouse=True)
def found_by_children(monkeypatch: pytest.MonkeyPatch, request: pytest.FixtureRequest) -> None:
    """Child processes import this module, and what tests share, by name."""
    places = (request.path.parent, request.path.parents[1])
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(str(place) for place in places))


def named(exit_: int) -> str:
    """Name of an exit of the contact solver. Imported here, for a child must not load it before a cap is lowered."""
    from physics.kernels.detect import contact

    names = ("AT_ONCE", "MEETS", "STALLED", "OUT_OF_STEPS", "NEVER", "LATER", "DEEPER_ONLY")
    return next(name for name in names if getattr(contact, name) == exit_)


def stopped_in_play(found: dict[str, Any]) -> None:
    """All balls are left where they are at the last instant, whatever reached the cap."""
    assert found["status"] == "EVENT_LIMIT"
    assert found["last"] <= found["duration"]
    assert np.isfinite(found["lying"][0]).all()


def test_a_shot_with_too_many_events_stops_there():
    found = run("STEPS_PER_EVENT", 4, "break_shot")
    assert found["ended"] == at.OUT_OF_EVENTS
    assert 20 <= found["n_events"] < 20 + 16  # an instant is finished once it is begun
    stopped_in_play(found)


def test_a_shot_with_too_many_steps_stops_there():
    """A step is an event or a look again: with no step allowed none is taken."""
    found = run("STEPS_PER_EVENT", 0, "break_shot")
    assert found["ended"] == at.OUT_OF_STEPS
    stopped_in_play(found)


def test_an_instant_with_too_many_rounds_ends_the_shot():
    found = run("ROUND_LIMIT", 2, "cradle")
    assert found["ended"] == at.OUT_OF_ROUNDS
    stopped_in_play(found)


def test_a_strike_with_too_many_rounds_ends_the_shot():
    found = run("ROUND_LIMIT", 1, "struck_cluster")
    assert found["ended"] == at.OUT_OF_ROUNDS
    assert found["duration"] == 0.0
    stopped_in_play(found)


def test_without_a_lowered_cap_the_same_shots_come_to_rest():
    for task in ("cradle", "struck_cluster"):
        found = run("STEPS_PER_EVENT", 4, task)
        assert (found["ended"], found["status"]) == (at.NOTHING_TO_COME, "AT_REST")


GRAZE = (0.3, 2 * R - 1e-13, -1.0, 0.0, 1e-3, 0.0, 5.0, 5.0)
"""A curved path that passes at a depth of 1e-13 m."""


def test_the_solver_out_of_steps_takes_the_contact_where_it_stands():
    """At the cap of 200 the gap is far below TOUCH; a graze takes up to 40 steps, so the cap is lowered to 4."""
    time, exit_ = run("SOLVER_STEPS", 4, "solve", *GRAZE)
    assert named(exit_) == "OUT_OF_STEPS"
    assert 0.0 < time < 0.31
    assert named(run("SOLVER_STEPS", 200, "solve", *GRAZE)[1]) == "MEETS"


RESTING_ON_EACH_OTHER = (2 * R, 0.0, 0.0, 1e-3, -1e-3, 0.0, 5.0, 5.0)
"""Touching, moving aside and pressed together: they part by the curve of their paths and meet again."""


def test_newtons_steps_back_from_a_deeper_contact_have_an_end():
    deeper, exit_ = run("SETTLED_STEPS", 0, "solve", *RESTING_ON_EACH_OTHER)
    assert named(exit_) == "DEEPER_ONLY"
    met, exit_ = run("SETTLED_STEPS", 8, "solve", *RESTING_ON_EACH_OTHER)
    assert named(exit_) == "MEETS"
    assert 0.0 < met <= deeper


@pytest.mark.parametrize(
    ("numbers", "expected", "time"),
    [
        ((2 * R, 0.0, -1.0, 0.0, 0.0, 0.0, 5.0, 5.0), "AT_ONCE", 0.0),
        ((1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 5.0, 5.0), "MEETS", 1.0 - 2 * R),
        ((1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 5.0, 5.0), "NEVER", math.nan),
        ((1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 5.0, 0.5), "LATER", math.nan),
        ((1e4, 0.0, -1.0, 0.0, 0.0, 0.0, 2e6, 2e6), "STALLED", 1e4 - 2 * R),
    ],
    ids=["touching", "meets", "leaves", "later", "a step below the last place of t"],
)
def test_every_exit_of_the_solver(numbers, expected, time):
    found, exit_ = run("SOLVER_STEPS", 200, "solve", *numbers)
    assert named(exit_) == expected
    assert found == pytest.approx(time, rel=1e-12, nan_ok=True)
