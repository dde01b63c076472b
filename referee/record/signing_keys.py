"""The keys of a seal, Ed25519. ``cryptography`` is loaded when something is signed or checked, never before."""

import hashlib
from dataclasses import dataclass, field
from typing import Any, Final, Self

KEY_BYTES: Final = 32


@dataclass(frozen=True, slots=True)
class PublicKey:
    """A key that signatures are checked with.

    Attributes:
        value: 32 bytes, as RFC 8032 encodes a public key.
        valid_from, valid_until: RFC 3339 in UTC with seconds; None where there is no bound.
    """

    value: bytes
    valid_from: str | None = None
    valid_until: str | None = None

    def __post_init__(self) -> None:
        if not isinstance(self.value, bytes) or len(self.value) != KEY_BYTES:
            raise ValueError(f"public key = {self.value!r}: must be {KEY_BYTES} bytes")

    @property
    def id(self) -> str:
        """The first 32 hexadecimal digits of the SHA-256 of the key: nobody can give it to another key."""
        return hashlib.sha256(self.value).hexdigest()[:32]

    @classmethod
    def from_hex(cls, text: str) -> Self:
        """Read 64 hexadecimal digits."""
        return cls(bytes_of_hex("public key", text, KEY_BYTES))

    def was_valid_at(self, time: str) -> bool:
        """Whether the key was in use then; times of this form are in the order of their texts."""
        return (self.valid_from or time) <= time <= (self.valid_until or time)

    def verifies(self, signature: bytes, message: bytes) -> bool:
        """Whether the key's owner has signed this."""
        from cryptography.exceptions import InvalidSignature
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey

        try:
            Ed25519PublicKey.from_public_bytes(self.value).verify(signature, message)
        except (InvalidSignature, ValueError):
            return False
        return True


@dataclass(frozen=True, slots=True)
class SigningKey:
    """The private half. It shows in no ``repr``.

    Attributes:
        value: 32 bytes, as RFC 8032 takes a private key.
    """

    value: bytes = field(repr=False)

    @classmethod
    def fresh(cls) -> Self:
        """A new key from the operating system."""
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

        return cls(Ed25519PrivateKey.generate().private_bytes_raw())

    @property
    def public(self) -> PublicKey:
        """What may be published."""
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

        return PublicKey(Ed25519PrivateKey.from_private_bytes(self.value).public_key().public_bytes_raw())

    def sign(self, message: bytes) -> bytes:
        """The signature, 64 bytes."""
        from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey

        return Ed25519PrivateKey.from_private_bytes(self.value).sign(message)


def bytes_of_hex(name: str, text: Any, size: int) -> bytes:
    """So many bytes from lower-case hexadecimal digits and nothing else."""
    try:
        value = bytes.fromhex(text)
    except (TypeError, ValueError):
        value = b""
    if len(value) != size or value.hex() != text:
        raise ValueError(f"{name} = {str(text)[:80]!r}: must be {2 * size} lower-case hexadecimal digits")
    return value
