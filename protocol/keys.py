"""The server's public signing keys."""

from datetime import datetime
from typing import Annotated, Literal

from pydantic import Field, StringConstraints

from protocol.values import Digest, Message


class KeyView(Message):
    """A key that records are, or were, signed with.

    Attributes:
        id: the first 32 hexadecimal digits of the SHA-256 of the public key.
        public_key: 32 bytes as RFC 8032 encodes them, in hexadecimal digits.
        valid_from, valid_until: when it was in use; until is null for the one that is.
    """

    id: Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{32}$")]
    algorithm: Literal["Ed25519"] = "Ed25519"
    public_key: Digest
    valid_from: datetime
    valid_until: Annotated[datetime | None, Field()] = None


class KeyList(Message):
    """``GET /v1/keys``: every key there has been, the newest first."""

    keys: tuple[KeyView, ...]
