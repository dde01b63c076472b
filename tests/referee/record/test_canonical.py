"""Canonical JSON: RFC 8785, floats that survive exactly, and a strict reader."""

import json
import math
import random
import struct
from unittest import mock

import numpy as np
import pytest
import rfc8785
from hypothesis import example, given, settings
from hypothesis import strategies as st

from client import play
from referee import EndReason
from referee.game import RuleId
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


JSON_SCALARS = (
    st.none()
    | st.booleans()
    | st.integers(-(2**70), 2**70)
    | st.floats()
    | st.floats(-1e25, 1e25).map(math.trunc).map(float)
    | st.sampled_from([0.0, -0.0, 1e21, 1e-7, 123456789012345680.0, 5e-324, 2.0**53, -1e16, 1e300])
    | st.text(st.characters(exclude_categories=()), max_size=20)
    | st.sampled_from(["[1.0]", ",-0,", "a,5e-7]", '"', "\\", "12.0,x", "\ud800", "\U0001f3b1", "\x7f", "\x00", "e5]"])
)
KEYS = st.text(st.characters(exclude_categories=()), max_size=5) | st.sampled_from(
    ["\U0001f3b1", "\ufb33", "a", "Z", ""]
)
JSON_VALUES = st.recursive(
    JSON_SCALARS | st.binary(max_size=2) | st.sampled_from([RuleId.R32, EndReason.CRASH, np.float64(0.5), object]),
    lambda inner: (
        st.lists(inner, max_size=5)
        | st.lists(inner, max_size=5).map(tuple)
        | st.dictionaries(KEYS | st.integers(), inner, max_size=5)
    ),
    max_leaves=20,
)


def outcome_of(writer, value):
    """The bytes, or the kind of error."""
    try:
        return writer(value)
    except ValueError as error:
        return type(error)


@given(JSON_VALUES)
@settings(max_examples=1000)
@example([0.0, -0.0, -0.5, 1.0, -1.0, 10.0, 100.0])
@example({"a": "[1.0]", "b": 1.0})
@example({"a": [math.nan]})
@example(1e21)
def test_the_reference_implementation_writes_the_same_bytes(value):
    """rfc8785 is the oracle, errors included."""
    assert outcome_of(lambda one: canonical(one).encode(), value) == outcome_of(rfc8785.dumps, value)


def test_numbers_by_the_hundred_thousand_are_those_of_the_reference():
    """Doubles of any bits, of any magnitude, whole ones and powers of ten, by lists."""
    chance = random.Random(8785)
    bits = [struct.unpack(">d", chance.randbytes(8))[0] for _ in range(30_000)]
    magnitudes = [chance.uniform(-1.0, 1.0) * 10.0 ** chance.randint(-12, 25) for _ in range(30_000)]
    whole = [float(chance.randint(-(10**n), 10**n)) for n in range(1, 26) for _ in range(1_000)]
    powers = [sign * 10.0**n for n in range(-323, 309) for sign in (1, -1)]
    numbers = [number for number in (*bits, *magnitudes, *whole, *powers) if math.isfinite(number)]
    for first in range(0, len(numbers), 500):
        part = numbers[first : first + 500]
        assert canonical(part).encode() == rfc8785.dumps(part)


def test_lines_of_a_game_are_those_of_the_reference_and_are_written_fast():
    """The chain hashes these bytes. No stroke of an ordinary game takes the slow way."""
    (game,) = play("random", "random", games=1, seed=3).games
    values = [json.loads(line) for line in game.record()]
    assert [line.encode() for line in game.record()] == [rfc8785.dumps(value) for value in values]
    with mock.patch("rfc8785.dumps", side_effect=lambda value: _only_numbers(value)):
        assert [canonical(value) for value in values] == list(game.record())


def _only_numbers(value, write=rfc8785.dumps):
    assert isinstance(value, float)
    return write(value)
