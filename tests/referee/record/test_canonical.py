"""Canonical JSON: RFC 8785, floats that survive exactly, and a strict reader."""

import json
import math
import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from referee.record.canonical import canonical, parse, plain

finite = st.floats(allow_nan=False, allow_infinity=False)


def test_the_rfcs_own_example():
    """RFC 8785, section 3.2.3."""
    value = {
        "numbers": [333333333.33333329, 1e30, 4.50, 2e-3, 0.000000000000000000000000001],
        "string": '€$\u000f\nA\'B"\\\\"/',
        "literals": [None, True, False],
    }
    assert canonical(value) == (
        '{"literals":[null,true,false],"numbers":[333333333.3333333,1e+30,4.5,0.002,1e-27],'
        '"string":"€$\\u000f\\nA\'B\\"\\\\\\\\\\"/"}'
    )


@pytest.mark.parametrize(
    ("bits", "text"),
    [
        ("0000000000000000", "0"),
        ("8000000000000000", "0"),
        ("0000000000000001", "5e-324"),
        ("7fefffffffffffff", "1.7976931348623157e+308"),
        ("4340000000000000", "9007199254740992"),
        ("44b52d02c7e14af5", "9.999999999999997e+22"),
        ("444b1ae4d6e2ef4e", "999999999999999700000"),
        ("444b1ae4d6e2ef50", "1e+21"),
        ("3eb0c6f7a0b5ed8d", "0.000001"),
        ("3eb0c6f7a0b5ed8c", "9.999999999999997e-7"),
        ("41b3de4355555553", "333333333.3333332"),
    ],
)
def test_the_rfcs_numbers(bits, text):
    """RFC 8785, appendix B."""
    assert canonical(struct.unpack(">d", bytes.fromhex(bits))[0]) == text


@given(finite)
def test_every_finite_double_reads_back_exactly(value):
    read = float(parse(canonical(value)))
    assert read == value
    assert struct.pack(">d", read) == struct.pack(">d", value + 0.0)


@given(st.dictionaries(st.text(), finite | st.text() | st.integers(-(10**15) + 1, 10**15 - 1)))
def test_order_of_keys_does_not_matter(value):
    backwards = dict(reversed(value.items()))
    assert canonical(value) == canonical(backwards)
    assert parse(canonical(value)) == value


@pytest.mark.parametrize("value", [math.nan, math.inf, 2**53, object(), {1: 2}])
def test_what_json_cannot_carry_is_refused(value):
    with pytest.raises(ValueError):
        canonical(value)


@pytest.mark.parametrize("text", ["NaN", "[Infinity]", '{"a":1,"a":2}', "{", "", "1 2", "1e400", "1" * 400])
def test_the_reader_is_strict(text):
    with pytest.raises(ValueError):
        parse(text)


def test_plain_keeps_the_order_of_keys():
    value = {"b": (1, 2.0), "a": {"d": None, "c": True}}
    assert list(plain(value)) == ["b", "a"]
    assert plain(value) == {"b": [1, 2.0], "a": {"d": None, "c": True}}
    assert json.dumps(plain(value)) == json.dumps(value)
