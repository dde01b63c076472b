"""Canonical JSON (RFC 8785): one value, one text, so that a digest means the value."""

import hashlib
import json
from typing import Any, NoReturn

import rfc8785


def canonical(value: Any) -> str:
    """The canonical text of a JSON value: keys sorted, no spaces, shortest numbers that read back exactly.

    Raises:
        rfc8785.CanonicalizationError: NaN, infinity, an integer beyond 2^53, or something that is not JSON.
    """
    return rfc8785.dumps(value).decode()


def digest(value: Any) -> str:
    """SHA-256 of the canonical text, hex."""
    return hashlib.sha256(rfc8785.dumps(value)).hexdigest()


def plain(value: Any) -> Any:
    """``value`` as it reads back from JSON (lists for tuples), its keys in their own order."""
    return json.loads(json.dumps(value, allow_nan=False))


def parse(text: str) -> Any:
    """Read JSON, strictly: no NaN, no infinity, no key twice.

    Raises:
        ValueError: the text is not JSON in this sense.
    """
    return json.loads(text, parse_constant=_refuse_constant, object_pairs_hook=_unique)


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON number")


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    values = dict(pairs)
    if len(values) != len(pairs):
        raise ValueError(f"a key comes twice among {[key for key, _ in pairs]}")
    return values
