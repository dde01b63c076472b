"""The first difference: named by stroke, event, ball and field, with both values."""

import copy
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from referee.record.difference import first_difference

ENTRY: dict[str, Any] = {
    "stroke": 3,
    "shot": {"v": 2.5, "phi": 10.0},
    "events": [
        {
            "index": 0,
            "kind": "cue_strike",
            "ball": 0,
            "other": -1,
            "states": [{"ball": 0, "spin": [1.0, 2.0, 3.0]}],
        },
        {
            "index": 1,
            "kind": "ball_collision",
            "ball": 0,
            "other": 5,
            "states": [{"ball": 0, "spin": [0.0, 0.0, 0.0]}, {"ball": 5, "spin": [4.0, 5.0, 6.0]}],
        },
    ],
    "final": {"0": [0.5, 1.0], "12": [0.25, 0.75]},
    "ruling": {"rules": ["R28"], "made": True},
}


def changed(path, value):
    entry = copy.deepcopy(ENTRY)
    node: Any = entry
    for step in path[:-1]:
        node = node[step]
    node[path[-1]] = value
    return entry


@pytest.mark.parametrize(
    ("path", "value", "event", "ball", "field", "derived"),
    [
        (("shot", "v"), 2.6, None, None, "shot.v", 2.5),
        (("events", 0, "kind"), "break", 0, 0, "events[0].kind", "cue_strike"),
        (("events", 1, "states", 1, "spin", 2), 6.5, 1, 5, "events[1].states[1].spin[2]", 6.0),
        (("events", 1, "other"), 6, 1, 0, "events[1].other", 5),
        (("final", "12", 0), 0.25000000000000006, None, 12, "final.12[0]", 0.25),
        (("ruling", "rules", 0), "R46", None, None, "ruling.rules[0]", "R28"),
        (("ruling", "made"), 1, None, None, "ruling.made", True),
        (("surplus",), 1, None, None, "surplus", "(missing)"),
        (("final", "3"), [0.1, 0.1], None, 3, "final.3", "(missing)"),
        (("stroke",), "3", None, None, "stroke", 3),
    ],
)
def test_a_difference_is_named(path, value, event, ball, field, derived):
    found = first_difference(changed(path, value), ENTRY, line=5, stroke=3)
    assert (found.event, found.ball, found.field) == (event, ball, field)
    assert (found.recorded, found.derived) == (value, derived)
    assert (found.line, found.stroke) == (5, 3)
    assert repr(value) in str(found)
    assert field in str(found)


def test_an_event_too_few_and_one_too_many():
    short, long = copy.deepcopy(ENTRY), copy.deepcopy(ENTRY)
    del short["events"][1]
    long["events"].append(long["events"][1])
    assert first_difference(short, ENTRY, 5).field == "events[1]"
    assert first_difference(short, ENTRY, 5).recorded == "(missing)"
    assert first_difference(long, ENTRY, 5).field == "events[2]"


def test_the_first_of_several_differences_is_that_of_the_earlier_cause():
    both = changed(("final", "0", 0), 0.6)
    both["events"][0]["states"][0]["spin"][1] = 0.0
    assert first_difference(both, ENTRY, 5).field == "events[0].states[0].spin[1]"


def test_equal_objects_do_not_differ():
    assert first_difference(copy.deepcopy(ENTRY), ENTRY, 5) is None
    assert first_difference({"v": 3}, {"v": 3.0}, 5) is None


@given(st.floats(allow_nan=False), st.floats(allow_nan=False))
def test_numbers_have_no_tolerance(left, right):
    assert (first_difference({"x": left}, {"x": right}, 1) is None) == (left == right)
