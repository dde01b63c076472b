"""Canonical JSON (RFC 8785): one value, one text, so that a digest means the value."""

import json
import math
from typing import Any, NoReturn

import rfc8785


def canonical(value: Any) -> str:
    """The canonical text of a JSON value: keys sorted, no spaces, shortest numbers that read back exactly.

    Raises:
        rfc8785.CanonicalizationError: NaN, infinity, an integer beyond 2^53, or something that is not JSON.
    """
    return rfc8785.dumps(value).decode()


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
