"""Bearer tokens: 256 random bits behind a prefix that says what they are for; only their hash is stored."""

import base64
import hashlib
import hmac
import secrets

AGENT_PREFIX = "pool_agt_"
STAFF_PREFIX = "pool_stf_"
"""Tokens of organisers, administrators and readers."""
INVITATION_PREFIX = "pool_inv_"
TOKEN_BYTES = 32


def new_token() -> str:
    """A fresh agent token, for example `pool_agt_Zq…` (43 characters of base64url after the prefix)."""
    return AGENT_PREFIX + secrets.token_urlsafe(TOKEN_BYTES)


def new_salt() -> str:
    """What `derived_token` starts from: 256 random bits."""
    return secrets.token_hex(TOKEN_BYTES)


def derived_token(presented: str, salt: str, prefix: str = AGENT_PREFIX) -> str:
    """The token that follows from the one presented and a random salt, as secret as both together.

    A request that is sent again gets the same token again, although neither token is stored.
    """
    secret = hmac.digest(presented.encode("utf-8", "surrogateescape"), salt.encode(), "sha256")
    return prefix + base64.urlsafe_b64encode(secret).decode().rstrip("=")


def digest(token: str) -> str:
    """What is stored of a token.

    SHA-256, hex. A token has 256 random bits, so no slow password hash is needed.
    """
    return hashlib.sha256(token.encode("utf-8", "surrogateescape")).hexdigest()


def matches(token: str, stored_digest: str) -> bool:
    """Whether this is the token of that digest, in a time that does not tell how much of it was right."""
    return hmac.compare_digest(digest(token), stored_digest)


def bearer(header: str | None) -> str | None:
    """The token in an `Authorization: Bearer …` header; None when there is none."""
    scheme, _, token = (header or "").partition(" ")
    return token.strip() or None if scheme.lower() == "bearer" else None
