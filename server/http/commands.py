"""A state-changing request and its answer: carried out once, however often it is sent."""

import hashlib
import json
from collections import Counter
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from email.message import Message as Headers
from typing import Final, TypeVar

from pydantic import BaseModel, ValidationError
from pydantic_core import from_json
from sqlalchemy import Connection, bindparam, insert, select

from protocol import shown
from server.errors import BadHeader, KeyReused, NotJson, UnsupportedMediaType, invalid_field, invalid_fields
from server.security.callers import Caller
from server.store.locks import only_one
from server.store.prepared import Prepared
from server.store.tables import answers

LONGEST_KEY = 200
LONGEST_CHECKED = 64 * 1024
"""Bytes of a body up to which a key that comes twice is looked for: more than any but a batch of simulations has."""
JSON_TYPE: Final = "application/json"
NUL = b"\\u0000"
"""The one way to write it in JSON."""

M = TypeVar("M", bound=BaseModel)


@dataclass(frozen=True, slots=True)
class Command:
    """Who asks for what, how it is recognised when it comes again, and the body as it came.

    `arrived` is when the last byte of the body was here, in the server's time. `minimal`: the answer need not repeat
    what was done.
    """

    caller: Caller
    route: str
    key: str | None
    if_match: str | None
    content_type: str | None
    body: bytes
    arrived: int
    minimal: bool = False

    @property
    def request_digest(self) -> str:
        """SHA-256 (hex) of the body: what makes a request with the same key the same request."""
        return hashlib.sha256(self.body).hexdigest()


@dataclass(frozen=True, slots=True)
class Answer:
    """A response that can be kept and given again byte for byte."""

    status: int
    body: bytes
    headers: Mapping[str, str] = field(default_factory=dict)

    @classmethod
    def of(cls, status: int, message: BaseModel, **headers: str) -> "Answer":
        """The answer that carries a wire message."""
        return cls(status, message.model_dump_json().encode(), headers)


def parse(command: Command, model: type[M]) -> M:
    """The command's body as a wire message; raises 415, 400 or 422, naming every faulty field."""
    return parse_body(command.body, command.content_type, model)


def parse_body(body: bytes, content_type: str | None, model: type[M]) -> M:
    """A body as a wire message; raises `UnsupportedMediaType`, `NotJson` or `Invalid`."""
    _require_json(content_type)
    try:
        content = from_json(body, allow_inf_nan=True)
        if len(body) <= LONGEST_CHECKED and body.count(b":") != _count_keys(content):
            json.loads(body, object_pairs_hook=_unique)
    except ValueError as error:
        raise NotJson(f"the body is not JSON: {error}", field="body", allowed="JSON in UTF-8") from error
    if NUL in body:
        _require_no_nul(content, ())
    try:
        return model.model_validate(content)
    except ValidationError as error:
        raise invalid_fields(error) from error


def _require_json(content_type: str | None) -> None:
    if content_type == JSON_TYPE:
        return
    headers = Headers()
    headers["content-type"] = content_type or ""
    if headers.get_content_type() != JSON_TYPE:
        raise UnsupportedMediaType(f"the body's type is {content_type!r}", field="Content-Type", allowed=JSON_TYPE)


def _count_keys(content: object) -> int:
    """Keys of all objects. Every colon outside a text belongs to one: where the counts agree no key came twice."""
    if isinstance(content, dict):
        return len(content) + sum(map(_count_keys, content.values()))
    return sum(map(_count_keys, content)) if isinstance(content, list) else 0


def _unique(pairs: list[tuple[str, object]]) -> None:
    twice = [key for key, count in Counter(key for key, _ in pairs).items() if count > 1]
    if twice:
        raise ValueError(f"the key {shown(twice[0])!r} comes twice")


def _require_no_nul(content: object, place: tuple[str, ...]) -> None:
    """Raise `Invalid` for a text with a NUL: no name has one, and not every database can store one."""
    if isinstance(content, str) and "\0" in content:
        raise invalid_field(".".join(place) or "body", content, "a text without NUL")
    if isinstance(content, dict):
        for key, value in content.items():
            _require_no_nul(key, (*place, "key"))
            _require_no_nul(value, (*place, str(shown(key))))
    if isinstance(content, list):
        for index, value in enumerate(content):
            _require_no_nul(value, (*place, str(index)))


_KEEP: Final = Prepared(insert(answers))
_STORED: Final = Prepared(select(answers).where(*(column == bindparam(column.name) for column in answers.primary_key)))


def recall(connection: Connection, command: Command) -> Answer | None:
    """The stored answer if this command was carried out before.

    Raises `BadHeader` without a usable Idempotency-Key and `KeyReused` when the key came with another body.
    """
    row = _STORED.first(connection, caller=command.caller.id, route=command.route, key=usable_key(command))
    if row is None:
        return None
    if row.request_digest != command.request_digest:
        raise KeyReused(
            "this Idempotency-Key came before with another body", field="Idempotency-Key", value=command.key
        )
    return Answer(row.status, row.body, row.headers)


def keep(connection: Connection, command: Command, answer: Answer) -> None:
    """Store the answer beside what the command changed, in the same transaction."""
    row = {
        "caller": command.caller.id,
        "route": command.route,
        "key": command.key,
        "request_digest": command.request_digest,
        "status": answer.status,
        "headers": dict(answer.headers),
        "body": answer.body,
        "created_at": command.arrived,
    }
    _KEEP.run(connection, row)


def once(connection: Connection, command: Command, act: Callable[[], Answer]) -> Answer:
    """Carry out a command unless it was carried out before.

    `connection` is in the transaction that `act` writes in.
    """
    only_one(connection, f"{command.caller.id} {command.route} {usable_key(command)}")
    if stored := recall(connection, command):
        return stored
    answer = act()
    keep(connection, command, answer)
    return answer


def usable_key(command: Command) -> str:
    """The Idempotency-Key; raises `BadHeader` for none and for one that is not usable."""
    key = command.key
    if key is None or not 1 <= len(key) <= LONGEST_KEY or not key.isascii() or not key.isprintable():
        raise BadHeader(
            "the request needs an Idempotency-Key: a name of its own, the same when it is sent again",
            field="Idempotency-Key",
            value=key and key[:LONGEST_KEY],
            allowed=f"1 to {LONGEST_KEY} printable ASCII characters",
        )
    return key
