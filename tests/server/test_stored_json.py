"""What a JSON column gives back is what was put into it, whoever wrote the text."""

import json

from server.store.stored_json import BY, dumps

VALUES = {
    "large": 2**256 - 1,
    "sixty-four bits": [2**63, 2**64 - 1, 2**64, -(2**63) - 1],
    "numbers": [0.1, -0.0, 5e-324, 1.7976931348623157e308, 1, 1.0, 2**53 + 1],
    "text": 'ünïcode "quoted" \\ \u2028 \U0001f3b1',
    "none": None,
    "deep": [[{"a": [True, False]}], {}],
}


def same(one, other):
    return json.dumps(one) == json.dumps(other)


def test_every_value_reads_back_as_it_was():
    assert same(BY["json_deserializer"](dumps(VALUES)), VALUES)


def test_texts_of_the_standard_library_read_the_same():
    """As version 0.1.0 wrote them."""
    assert same(BY["json_deserializer"](json.dumps(VALUES)), VALUES)


def test_keys_that_are_numbers_become_texts():
    assert dumps({7: 1.5}) == '{"7":1.5}'
