"""Problem details: RFC 9457 with a stable code, and any value at all in a form JSON can carry."""

import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol import Fault, Problem, ProblemCode, shown

anything = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.text() | st.binary(),
    lambda inner: st.lists(inner) | st.dictionaries(st.text() | st.integers(), inner),
)


def test_a_problem_has_the_members_of_rfc_9457():
    problem = Problem.of(ProblemCode.STALE_VERSION, "version 3 is not the current 4", field="If-Match")
    assert problem.model_dump(mode="json", exclude_defaults=True) == {
        "type": "urn:pooliad:problem:stale_version",
        "title": "Stale version",
        "status": 412,
        "detail": "version 3 is not the current 4",
        "code": "stale_version",
        "field": "If-Match",
    }


def test_faults_carry_whatever_came():
    fault = Fault(code="refused", field="shot.v", value=shown(math.nan), detail="not a number")
    assert json.loads(fault.model_dump_json())["value"] == "nan"


@given(anything)
def test_everything_can_be_shown(value):
    json.dumps(shown(value), allow_nan=False)


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (math.inf, "inf"),
        (-math.inf, "-inf"),
        (math.nan, "nan"),
        (3, 3),
        (True, True),
        (10**400, "1" + "0" * 199),
        ("x" * 300, "x" * 200 + "…"),
        ([math.nan, 1.5], ["nan", 1.5]),
        ({"a": {"b": [math.inf]}}, {"a": {"b": ["inf"]}}),
        (list(range(17)), "list of 17"),
        (b"ab", "bytes of 2"),
        ([[[[[1]]]]], [[[["list of 1"]]]]),
    ],
)
def test_what_json_lacks_is_text_and_what_is_long_is_cut(value, expected):
    assert shown(value) == expected


def test_a_megabyte_is_not_echoed():
    assert len(json.dumps(shown({"k" * 10**6: ["v" * 10**6] * 10}))) < 10_000
