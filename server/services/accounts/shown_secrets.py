"""Secrets that the answer to a request shows. None is stored: what is kept for a repetition is a salt, from which only
the token presented makes the secrets again.
"""

import hmac
from collections.abc import Callable

from sqlalchemy import Connection

from server.errors import KeyReused
from server.http.commands import Answer, Command, once
from server.security.tokens import derived_token, digest, new_salt


def once_with_salt(connection: Connection, command: Command, act: Callable[[str], str]) -> tuple[str, str]:
    """Carry out a command unless it was carried out before; the salt of its secrets, and what `act` said when it did.

    Raises `KeyReused` when it came before with another token, which a rotation leaves: from this one other secrets
    would follow, that nobody ever stored.
    """

    def kept() -> Answer:
        salt = new_salt()
        return Answer(200, f"{salt} {_mark(command, salt)} {act(salt)}".encode())

    salt, mark, said = once(connection, command, kept).body.decode().split(" ", 2)
    if not hmac.compare_digest(mark, _mark(command, salt)):
        raise KeyReused(
            "this Idempotency-Key came before with another token, which the answer's secrets are made from",
            field="Idempotency-Key",
            value=command.key,
        )
    return salt, said


def _mark(command: Command, salt: str) -> str:
    """Tells whether this token made the secrets, and no more of the token than they do."""
    return digest(derived_token(command.caller.token, salt))
