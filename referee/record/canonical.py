"""Canonical JSON (RFC 8785): one value, one text, so that a digest means the value.

``rfc8785`` defines the bytes; ``orjson`` writes the same ones ten times as fast, but for its numbers, which are put
into the RFC's form afterwards. Whatever might come out otherwise is left to ``rfc8785`` itself.
"""

import json
import marshal
import math
import re
from collections.abc import Iterator
from typing import Any, Final, NoReturn

import orjson
import rfc8785

_OPTIONS: Final = (
    orjson.OPT_SORT_KEYS
    | orjson.OPT_STRICT_INTEGER
    | orjson.OPT_PASSTHROUGH_DATACLASS
    | orjson.OPT_PASSTHROUGH_DATETIME
    | orjson.OPT_PASSTHROUGH_SUBCLASS
)
_PLAIN_MARSHAL: Final = 2
"""The version that writes a double as ``g`` and its 8 bytes, each time it occurs."""
_INFINITE_OR_NAN: Final = re.compile(rb"g.{6}[\xf0-\xff][\x7f\xff]", re.DOTALL)
"""A double whose exponent is all ones, or bytes that look like one: looked at closely, nothing is lost."""
_WHOLE: Final = re.compile(rb"\.0(?=[\],}])")
_NEGATIVE_ZERO: Final = re.compile(rb"-0(?=[\],}])")
_EXPONENT: Final = re.compile(rb"e(?:-6|\+?[0-9]+)(?=[\],}])")
"""How the numbers end that the RFC writes otherwise. Each begins with a letter, which is looked for fast. With
exponents from -7 down both write the same."""


def canonical(value: Any) -> str:
    """The canonical text of a JSON value: keys sorted, no spaces, shortest numbers that read back exactly.

    Raises:
        rfc8785.CanonicalizationError: NaN, infinity, an integer beyond 2^53, or something that is not JSON.
    """
    text = _fast(value)
    return rfc8785.dumps(value).decode() if text is None else text


def _fast(value: Any) -> str | None:
    """The canonical text, or None where it is not certain that this would be it."""
    try:
        if _INFINITE_OR_NAN.search(marshal.dumps(value, _PLAIN_MARSHAL)):  # which orjson would write as null
            return None
        text = orjson.dumps([value], option=_OPTIONS)  # in brackets, so that something follows every number
    except (ValueError, TypeError):  # not only dict, list, tuple, str, int, float, bool and None
        return None
    if not text.isascii() or b"\\" in text:  # keys are in order of UTF-16; strings end at the next quotation mark
        return None
    strings = b'"'.join(text.split(b'"')[1::2])
    if _WHOLE.search(strings) or _NEGATIVE_ZERO.search(strings) or _EXPONENT.search(strings):
        return None  # a string holds what looks like such a number
    text = _NEGATIVE_ZERO.sub(b"0", _WHOLE.sub(b"", text))
    return b"".join(_exponents_rewritten(text)).decode()


def _exponents_rewritten(text: bytes) -> Iterator[bytes]:
    """The pieces of a text, brackets off, its numbers with exponents as the RFC writes them."""
    done = 1
    for exponent in _EXPONENT.finditer(text):
        start, end = exponent.span()
        first = max(text.rfind(before, done - 1, start) for before in (b"[", b",", b":")) + 1
        yield text[done:first]
        yield rfc8785.dumps(float(text[first:end]))
        done = end
    yield text[done:-1]


def plain(value: Any) -> Any:
    """``value`` as it reads back from JSON (lists for tuples), its keys in their own order."""
    return json.loads(json.dumps(value, allow_nan=False))


def parse(text: str) -> Any:
    """Read JSON, strictly: no NaN, no infinity, no key twice.

    RFC 8785 writes doubles from 2^53 to 10^21 without an exponent: such numbers are read as doubles again.

    Raises:
        ValueError: the text is not JSON in this sense.
    """
    return json.loads(
        text,
        parse_int=_integer_or_double,
        parse_float=_finite,
        parse_constant=_refuse_constant,
        object_pairs_hook=_unique,
    )


def _integer_or_double(text: str) -> int | float:
    """An integer if a double can tell it from its neighbours, else the double."""
    return int(text) if len(text) < _SAFE_DIGITS else _finite(text)


_SAFE_DIGITS = 16
"""Numbers of at most 15 digits are below 2^53. Those of 16 would have to be compared; none occurs."""


def _finite(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text[:40]} is too great for a double")
    return number


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON number")


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) != len(pairs):
        raise ValueError(f"a key comes twice among {[key for key, _ in pairs]}")
    return values
