"""The seal, a record's last line: an Ed25519 signature over the whole chain, or the statement that there is none.

What is signed is the seal itself without its signature, in canonical form: with the digest of the line before
it, all lines are covered; with the key's id and the time, those are, too.
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final

from referee.record.canonical import canonical
from referee.record.chain import PREVIOUS
from referee.record.signing_keys import PublicKey, SigningKey, bytes_of_hex

ALGORITHM: Final = "Ed25519"
SIGNATURE_BYTES: Final = 64


def unsigned_seal() -> dict[str, Any]:
    """The last entry of a record that nobody signs."""
    return {"type": "seal", "signature": None}


def signed_seal(key: SigningKey, head: str, signed_at: str) -> dict[str, Any]:
    """The last entry of a record that is signed.

    Args:
        key: whose signature it is.
        head: the digest of the line before.
        signed_at: RFC 3339 in UTC with seconds, like ``2026-11-22T04:00:00Z``.
    """
    seal = {"type": "seal", "algorithm": ALGORITHM, "key": key.public.id, "signed_at": signed_at}
    return seal | {"signature": key.sign(_signed_bytes(seal | {PREVIOUS: head})).hex()}


class SealState(StrEnum):
    """What is known of a record's signature."""

    UNSIGNED = "unsigned"
    """There is none: whoever had the secrets could have written this record."""
    UNCHECKED = "unchecked"
    """There is one, and no key was given to check it with."""
    VALID = "valid"
    """The owner of the key has signed exactly this."""
    INVALID = "invalid"
    """It is not what the given keys sign, or there is none though a key was given."""


@dataclass(frozen=True, slots=True)
class Seal:
    """What was found about a signature.

    Attributes:
        state: see there. key: the id of the key the record names, None if unsigned.
        problem: why it is invalid, in words.
    """

    state: SealState
    key: str | None = None
    problem: str | None = None

    def __str__(self) -> str:
        match self.state:
            case SealState.UNSIGNED:
                return "unsigned: it is as trustworthy as whoever it came from"
            case SealState.UNCHECKED:
                return f"signed by key {self.key}, not checked: no key was given"
            case SealState.VALID:
                return f"signed by key {self.key}"
            case SealState.INVALID:
                return f"bad signature: {self.problem}"


def check_seal(seal: Mapping[str, Any], keys: Iterable[PublicKey] | None) -> Seal:
    """What a record's last line says and is worth.

    Args:
        seal: the last line as it reads, with the digest of the line before.
        keys: those that are trusted; None: the signature is not checked.

    Raises:
        ValueError: it is neither form of a seal.
    """
    if seal.get("signature") is None:
        _require_keys(seal, unsigned_seal())
        return Seal(SealState.UNSIGNED) if keys is None else _invalid(None, "there is none; the record is unsigned")
    _require_keys(seal, dict.fromkeys(("type", "algorithm", "key", "signed_at", "signature")))
    if seal["algorithm"] != ALGORITHM:
        raise ValueError(f"algorithm = {seal['algorithm']!r}: must be {ALGORITHM!r}")
    named, signed_at = (_text(name, seal[name]) for name in ("key", "signed_at"))
    signature = bytes_of_hex("signature", seal["signature"], SIGNATURE_BYTES)
    return Seal(SealState.UNCHECKED, named) if keys is None else _checked(seal, named, signed_at, signature, [*keys])


def _checked(seal: Mapping[str, Any], named: str, signed_at: str, signature: bytes, keys: list[PublicKey]) -> Seal:
    key = next((key for key in keys if key.id == named), None)
    if key is None:
        return _invalid(named, f"key {named} is not among those given ({', '.join(key.id for key in keys) or 'none'})")
    message = _signed_bytes({name: value for name, value in seal.items() if name != "signature"})
    if not key.verifies(signature, message):
        return _invalid(named, f"it is not key {named}'s over these lines")
    if not key.was_valid_at(signed_at):
        bounds = f"{key.valid_from or 'ever'} to {key.valid_until or 'now'}"
        return _invalid(named, f"signed at {signed_at}, and key {named} is valid from {bounds}")
    return Seal(SealState.VALID, named)


def _invalid(key: str | None, problem: str) -> Seal:
    return Seal(SealState.INVALID, key, problem)


def _signed_bytes(seal: Mapping[str, Any]) -> bytes:
    return canonical(dict(seal)).encode()


def _require_keys(seal: Mapping[str, Any], wanted: Mapping[str, Any]) -> None:
    if set(seal) != {*wanted, PREVIOUS}:
        raise ValueError(f"a seal of {sorted(seal)}: must have {sorted({*wanted, PREVIOUS})}")


def _text(name: str, value: Any) -> str:
    if not isinstance(value, str):
        raise ValueError(f"{name} = {value!r}: must be a string")
    return value
