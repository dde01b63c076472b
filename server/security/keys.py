"""The server's signing keys: made at the first start, rotated by command, published, never logged."""

from datetime import UTC, datetime
from typing import Any

from sqlalchemy import Connection, Row, insert, select, update

from protocol import KeyList, KeyView
from referee.play.clock import SECOND_NS
from referee.record import SigningKey
from server.store.locks import only_one
from server.store.tables import signing_keys

OVERLAP_NS = 60 * SECOND_NS
"""How much longer a key that was replaced is valid: a game may end in the very moment of the rotation."""


def ensure(connection: Connection, now: int) -> None:
    """Make the first key, if there is none."""
    if _active(connection) is None:
        only_one(connection, "signing keys")
        if _active(connection) is None:
            _insert(connection, now)


def rotate(connection: Connection, now: int) -> str:
    """Replace the key in use; the new one's id. Records sealed before keep verifying with the old one."""
    only_one(connection, "signing keys")
    in_use = signing_keys.c.valid_until.is_(None)
    connection.execute(update(signing_keys).where(in_use).values(valid_until=now + OVERLAP_NS))
    return _insert(connection, now)


def sealing(connection: Connection, now: int) -> tuple[SigningKey, str]:
    """The key that records are sealed with now, and the time the seal bears.

    Whoever made the key may have had a clock that was ahead: no seal is older than its key.
    """
    ensure(connection, now)
    row = _active(connection)
    assert row is not None
    return SigningKey(bytes(row.private_key)), time_text(max(now, row.valid_from))


def published(connection: Connection) -> KeyList:
    """The public half of every key there has been, the newest first."""
    rows = connection.execute(select(signing_keys).order_by(signing_keys.c.valid_from.desc(), signing_keys.c.id))
    return KeyList(keys=tuple(_view(row) for row in rows))


def time_text(nanoseconds: int) -> str:
    """A point in time as seals hold it: RFC 3339 in UTC, whole seconds."""
    return _seconds(nanoseconds).strftime("%Y-%m-%dT%H:%M:%SZ")


def _active(connection: Connection) -> Row[Any] | None:
    in_use = select(signing_keys).where(signing_keys.c.valid_until.is_(None))
    return connection.execute(in_use.order_by(signing_keys.c.valid_from.desc(), signing_keys.c.id).limit(1)).first()


def _insert(connection: Connection, now: int) -> str:
    key = SigningKey.fresh()
    row = {
        "id": key.public.id,
        "private_key": key.value,
        "public_key": key.public.value.hex(),
        "valid_from": now,
    }
    connection.execute(insert(signing_keys).values(row))
    return key.public.id


def _view(row: Row[Any]) -> KeyView:
    until = row.valid_until
    return KeyView(
        id=row.id,
        public_key=row.public_key,
        valid_from=_seconds(row.valid_from),
        valid_until=None if until is None else _seconds(until),
    )


def _seconds(nanoseconds: int) -> datetime:
    return datetime.fromtimestamp(nanoseconds // SECOND_NS, UTC)
