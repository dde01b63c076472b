"""What `/openapi.json` says about an operation beyond what the framework reads off a function's signature.

Bodies are not the framework's to read: token, ownership, repetition and version come before a body's content.
"""

from collections.abc import Mapping
from typing import Any, Final

from pydantic import BaseModel

from protocol import PROBLEM_JSON
from server.errors import (
    BadHeader,
    Forbidden,
    Internal,
    Invalid,
    KeyReused,
    NotFound,
    NotJson,
    ServerError,
    SlowBody,
    TooLarge,
    TooManyRequests,
    Unauthorized,
    Unavailable,
    UnsupportedMediaType,
)
from server.http.commands import LONGEST_KEY
from server.http.preferences import MINIMAL
from server.store import paging

TOKEN_SCHEME = "token"
BODY_PROBLEMS = (NotJson, SlowBody, TooLarge, UnsupportedMediaType, Invalid)
KEY_PROBLEMS = (BadHeader, KeyReused)
OWNED = (Forbidden, NotFound)

NUMBER: Final[dict[str, Any]] = {"pattern": f"^[0-9]{{1,{paging.LONGEST_NUMBER}}}$"}
PLACE: Final[dict[str, Any]] = {"pattern": r"^(0|[0-9]{1,18}\.[ -~]{1,64})$"}
PAGE_LIMIT: Final[dict[str, Any]] = {"pattern": "^(0{0,2}[1-9]|0?[1-9][0-9]|1[0-9]{2}|200)$"}
SEARCH: Final[dict[str, Any]] = {"pattern": f"^{paging.SEARCH}$"}
NO_NUL: Final[dict[str, Any]] = {"pattern": "^[^\\u0000]*$"}
KEY: Final[dict[str, Any]] = {"type": "string", "pattern": f"^[!-~]([ -~]{{0,{LONGEST_KEY - 2}}}[!-~])?$"}
VERSION: Final[dict[str, Any]] = {"type": "string", "pattern": '^("[0-9]{1,15}"|[0-9]{1,15})$'}

PREFER: Final[dict[str, Any]] = {"type": "string", "pattern": "^[ -~]{0,200}$"}

EVENT_STREAM: Final = "text/event-stream"
TEXT: Final[dict[str, Any]] = {"type": "string"}
EVENT: Final[dict[str, Any]] = {
    "type": "object",
    "properties": {"id": TEXT, "event": TEXT, "data": TEXT, "retry": {"type": "integer"}},
}
"""One event of a stream; `data` is a message in JSON."""

Described = dict[str, Any]


def describe(
    *problems: type[ServerError],
    body: type[BaseModel] | None = None,
    optional_body: bool = False,
    success: Mapping[int, Any] | None = None,
    token: bool = True,
    key: bool = False,
    optional_key: bool = False,
    version: bool = False,
    minimal: bool = False,
    limited: bool = True,
) -> Described:
    """Keyword arguments for a route.

    Args:
        problems: the errors it may answer with, beside those that the other arguments imply.
        body: the message it takes; optional_body: it may be left out.
        success: the message it answers with, or the media type of what is none, by status; None leaves it to
            the
            framework.
        limited: whether it may be asked too often.
        token: whether it takes one; key: an Idempotency-Key, which optional_key says is not always needed;
            version: If-Match; minimal: Prefer: return=minimal.
    """
    implied: list[type[ServerError]] = [Unauthorized] if token else []
    implied += [*BODY_PROBLEMS] if body else []
    implied += [SlowBody, TooLarge, *KEY_PROBLEMS] if key or optional_key else []
    extra: dict[str, Any] = {"security": [{TOKEN_SCHEME: []}] if token else []}
    if body:
        extra["requestBody"] = _request_body(body) | {"required": not optional_body}
    if headers := _headers(key, optional_key, version, minimal):
        extra["parameters"] = headers
    responses = {status: _success(answer) for status, answer in (success or {}).items()}
    described: Described = {
        "openapi_extra": extra,
        "responses": responses
        | _problems(*problems, *implied, *([TooManyRequests] if limited else []), Internal, Unavailable),
    }
    if success:
        described |= {"status_code": min(success), "response_model": None}
    return described


def _request_body(body: type[BaseModel]) -> dict[str, Any]:
    examples = body.model_json_schema().get("examples", [])
    content = {
        "schema": {"$ref": f"#/components/schemas/{body.__name__}"},
        "examples": {f"example_{number}": {"value": value} for number, value in enumerate(examples, 1)},
    }
    return {"content": {"application/json": content}}


def _success(answer: Any) -> dict[str, Any]:
    if isinstance(answer, str):
        return {
            "description": "Success",
            "content": {answer: {"schema": EVENT if answer == EVENT_STREAM else TEXT}} if answer else {},
        }
    return {"description": "Success", "model": answer}


def _problems(*errors: type[ServerError]) -> dict[int | str, dict[str, Any]]:
    codes: dict[int, list[str]] = {}
    for error in errors:
        known = codes.setdefault(error.code.status, [])
        known += [error.code] if error.code not in known else []
    content = {PROBLEM_JSON: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    return {
        status: {"description": "Problem: " + ", ".join(names), "content": content}
        for status, names in sorted(codes.items())
    }


def _headers(key: bool, optional_key: bool, version: bool, minimal: bool) -> list[dict[str, Any]]:
    headers = []
    if key or optional_key:
        example = "6a1f0c52-7f0e-4d43-9c1b-5b2f3f0f7f11"
        headers.append(_header("Idempotency-Key", KEY, example, "a name of the request's own", required=key))
    if version:
        headers.append(_header("If-Match", VERSION, '"1"', "the version of the view that the request answers"))
    if minimal:
        words = "the answer need not repeat the stroke: its view has it (RFC 7240)"
        headers.append(_header("Prefer", PREFER, MINIMAL, words, required=False))
    return headers


def _header(
    name: str, schema: dict[str, Any], example: str, description: str, *, required: bool = True
) -> dict[str, Any]:
    return {
        "name": name,
        "in": "header",
        "required": required,
        "description": description,
        "schema": schema,
        "example": example,
    }
