"""Errors on the wire: RFC 9457 problem details with a stable code (``application/problem+json``)."""

import re
from collections.abc import Mapping, Sized
from enum import StrEnum
from typing import Any, Self

from pydantic import ConfigDict, JsonValue

from protocol.values import Message
from protocol.view import View

PROBLEM_JSON = "application/problem+json"


class ProblemCode(StrEnum):
    """Every code a problem can have; a code never changes its meaning.

    Server and client have an exception class for each, named like it: ``NOT_YOUR_TURN`` is ``NotYourTurn``.

    Attributes:
        status: of HTTP.
    """

    status: int

    def __new__(cls, code: str, status: int) -> Self:
        """A code with its status."""
        member = str.__new__(cls, code)
        member._value_, member.status = code, status
        return member

    @classmethod
    def of_class(cls, name: str) -> "ProblemCode | None":
        """The code that an exception class of this name stands for; None for others, such as groups of them."""
        return cls.__members__.get(re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).upper())

    NOT_JSON = "not_json", 400
    """The body is not JSON."""
    BAD_HEADER = "bad_header", 400
    """A header is malformed, or one that is needed is missing."""
    UNAUTHORIZED = "unauthorized", 401
    """No token, or one that is not valid."""
    FORBIDDEN = "forbidden", 403
    """The token may not do this."""
    NOT_FOUND = "not_found", 404
    """No such thing."""
    METHOD_NOT_ALLOWED = "method_not_allowed", 405
    """The address exists, but not for this method."""
    SLOW_BODY = "slow_body", 408
    """The body did not arrive in time."""
    GAME_FINISHED = "game_finished", 409
    """The game is over."""
    GAME_UNFINISHED = "game_unfinished", 409
    """The game is still on, and this is for finished ones."""
    MATCH_UNFINISHED = "match_unfinished", 409
    """The match has untold noise and is still on; what its finished games tell is given when it is over."""
    TOURNAMENT_UNFINISHED = "tournament_unfinished", 409
    """The tournament has untold noise and is still on; what its finished games tell is given when it is over."""
    NOT_YOUR_TURN = "not_your_turn", 409
    """It is the other player's turn."""
    OUT_OF_TIME = "out_of_time", 409
    """The caller's clock has run out."""
    BUDGET_SPENT = "budget_spent", 409
    """The caller's budget of simulated shots has fewer left."""
    WRONG_STATUS = "wrong_status", 409
    """The match is not in a state that allows this."""
    NAME_TAKEN = "name_taken", 409
    """Another agent has this name."""
    STALE_VERSION = "stale_version", 412
    """The game has moved on; the problem carries the current view."""
    TOO_LARGE = "too_large", 413
    """The body is too large; with status 431, the header fields are."""
    UNSUPPORTED_MEDIA_TYPE = "unsupported_media_type", 415
    """The body must be application/json."""
    INVALID = "invalid", 422
    """A field is missing, unknown, of the wrong type or out of range."""
    REFUSED = "refused", 422
    """The referee refuses the stroke or the decision; nothing happened, the clock runs on."""
    KEY_REUSED = "key_reused", 422
    """This Idempotency-Key came before with another body."""
    VERSION_REQUIRED = "version_required", 428
    """The request needs If-Match with the version of the view it answers."""
    TOO_MANY_REQUESTS = "too_many_requests", 429
    """Wait for the seconds in Retry-After."""
    INTERNAL = "internal", 500
    """A fault of the server."""
    DRAINING = "draining", 503
    """The server is shutting down; try again soon."""
    UNAVAILABLE = "unavailable", 503
    """The server's database does not answer; try again soon."""


class Fault(Message):
    """One thing that is wrong with a request.

    Attributes:
        code: a refusal's own code, e.g. ``call_not_allowed``, or the kind of error in a field.
        field: which field, dotted from the top of the body; null when it concerns the whole.
        value: what came, NaN and infinity as text.
        allowed: what is allowed.
        detail: a sentence.
        rule: the rule id behind a refusal.
    """

    code: str
    field: str | None = None
    value: JsonValue = None
    allowed: str | None = None
    detail: str
    rule: str | None = None


class Problem(Message):
    """Why a request was not carried out.

    ``field``, ``value`` and ``allowed`` repeat the first of ``errors``, which lists every fault.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "type": "urn:pooliad:problem:not_your_turn",
                    "title": "Not your turn",
                    "status": 409,
                    "detail": "it is seat 1's turn",
                    "code": "not_your_turn",
                }
            ]
        }
    )

    type: str
    title: str
    status: int
    detail: str
    code: ProblemCode
    instance: str | None = None
    field: str | None = None
    value: JsonValue = None
    allowed: str | None = None
    errors: tuple[Fault, ...] = ()
    view: View | None = None

    @classmethod
    def of(cls, code: ProblemCode, detail: str, status: int | None = None, **extensions: Any) -> "Problem":
        """A problem with the type and title that belong to ``code``, and its status unless another is given."""
        return cls(
            type=f"urn:pooliad:problem:{code}",
            title=code.replace("_", " ").capitalize(),
            status=code.status if status is None else status,
            detail=detail,
            code=code,
            **extensions,
        )


def shown(value: Any, depth: int = 4) -> JsonValue:
    """``value`` in a form that JSON can carry.

    NaN and infinity become text, the unknown its repr; what is long, wide or deeper than ``depth`` is cut.
    """
    if isinstance(value, str):
        return value if len(value) <= _LONGEST else value[:_LONGEST] + "…"
    if value is None or isinstance(value, bool):
        return value
    if isinstance(value, int | float):
        return value if abs(value) <= _GREATEST else str(value)[:_LONGEST]
    if depth and isinstance(value, Mapping) and len(value) <= _WIDEST:
        return {str(key)[:_LONGEST]: shown(item, depth - 1) for key, item in value.items()}
    if depth and isinstance(value, list | tuple) and len(value) <= _WIDEST:
        return [shown(item, depth - 1) for item in value]
    return f"{type(value).__name__} of {len(value)}" if isinstance(value, Sized) else repr(value)[:_LONGEST]


_LONGEST = 200
"""Characters of a faulty value that are sent back: enough to recognise it, too few to echo a 10 MB body."""

_WIDEST = 16
"""Items of a faulty list or object that are sent back."""

_GREATEST = 1.7976931348623157e308
"""The greatest finite double; NaN does not compare, so it and infinity fall to the text form."""
