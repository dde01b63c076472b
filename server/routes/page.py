"""The spectator's page and the reference of the HTTP interface, with the headers that keep everything else out."""

import hashlib
import json
import mimetypes
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Final

from fastapi import APIRouter, FastAPI, Request, Response

from physics import Table, rack
from physics.table import NAMED
from protocol import TableDescription
from referee.game import RULES
from server.errors import NotFound
from server.http.dependencies import Address, ContextDep, context_of
from server.joined import joined
from server.reference import reference
from server.services.watch.first_picture import first_picture
from server.services.watch.previews import preview
from tournament.luck import VALUE

router = APIRouter(include_in_schema=False)

HOME: Final = "index.html"
MAIN: Final = "main"
JOINED: Final = "page.js"
HEAD_END: Final = b"\n  </head>"
ROOT: Final = b'<html lang="en">'
LOBBY: Final = b'data-page="lobby"'
EMBEDDED: Final = b'<html lang="en" class="embedded">'
MAIN_ENDS: Final = b"</main>"
RULES_FILE: Final = "rules.json"
TABLES_SCRIPT: Final = "named_tables.js"
RACKS_FILE: Final = "racks.json"
VALUE_FILE: Final = "value.json"
RACKS: Final = 10
"""Racks of each named table that the laboratory offers, by their seeds from 0."""
TYPES: Final = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
}
ALONE: Final = "frame-ancestors 'none'"
POLICY: Final = (
    *("default-src 'none'", "script-src 'self'", "style-src 'self'", "img-src 'self'", "connect-src 'self'"),
    *("base-uri 'none'", "form-action 'none'", ALONE),
    *("require-trusted-types-for 'script'", "trusted-types 'none'"),
)
"""Nothing is loaded from anywhere else, no markup is made from text, nobody shows it in a frame unless allowed to."""
HEADERS: Final = {
    "Content-Security-Policy": "; ".join(POLICY),
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-cache",
}


@dataclass(frozen=True, slots=True)
class File:
    """A file of the page; `etag` changes with its content."""

    content: bytes
    media_type: str
    etag: str

    @classmethod
    def of(cls, name: str, content: bytes) -> "File":
        """A file by its name, which tells its type."""
        suffix = name[name.rindex(".") :]
        media_type = TYPES.get(suffix) or mimetypes.types_map[suffix]
        return cls(content, media_type, f'"{hashlib.sha256(content).hexdigest()[:16]}"')


@cache
def page_files() -> dict[str, File]:
    """All files of `server/web`, by name; its scripts as one; the referee's rules, the named tables and racks."""
    found = [one for one in files("server").joinpath("web").iterdir() if one.is_file()]
    contents = {one.name: one.read_bytes() for one in found}
    contents[RULES_FILE] = json.dumps(dict(RULES)).encode()
    described = {name: TableDescription.of(Table.named(name)).model_dump(mode="json") for name in NAMED}
    contents[TABLES_SCRIPT] = f"export const NAMED = {json.dumps(described)};\n".encode()
    racked = {name: [rack(Table.named(name), seed=seed).to_dict() for seed in range(RACKS)] for name in NAMED}
    contents[VALUE_FILE] = json.dumps({"source": VALUE.source, "weights": dict(VALUE.weights)}).encode()
    contents[RACKS_FILE] = json.dumps(racked).encode()
    scripts = {name.removesuffix(".js"): text.decode() for name, text in contents.items() if name.endswith(".js")}
    contents[JOINED] = joined(scripts, MAIN).encode()
    return {name: File.of(name, content) for name, content in contents.items()}


@router.get("/")
async def home(request: Request) -> Response:
    """The page; the one file that may be shown in a frame, by those whom the settings name."""
    return _framed(request, _served(request, HOME))


@router.get("/games/{game_id}")
def game(game_id: str, request: Request, context: ContextDep, address: Address) -> Response:
    """The page of a game: its head tells of it, for those who show previews of links; its body shows how it stands."""
    context.limits.count_stranger(address)
    found = preview(context, game_id)
    if found is None:
        answer = _served(request, HOME)
        answer.status_code = 404 if answer.status_code == 200 else answer.status_code
        return _framed(request, answer)
    content = page_files()[HOME].content
    if request.headers.get("sec-fetch-dest") == "iframe":
        content = content.replace(ROOT, EMBEDDED, 1)
    content = content.replace(LOBBY, LOBBY + b' aria-current="page"', 1)
    for place, more in (
        (HEAD_END, found.tags(str(request.base_url).rstrip("/"))),
        (MAIN_ENDS, first_picture(context, game_id)),
    ):
        content = content.replace(place, more.encode() + place, 1)
    answer = _framed(request, _answered(request, File.of(HOME, content)))
    answer.headers["Vary"] = "Sec-Fetch-Dest"
    return answer


def _framed(request: Request, answer: Response) -> Response:
    """May be shown in a frame by those whom the settings name."""
    if named := context_of(request).settings.framing_origins:
        policy = HEADERS["Content-Security-Policy"].replace(ALONE, f"frame-ancestors {' '.join(named)}")
        answer.headers["Content-Security-Policy"] = policy
    return answer


@router.get("/docs")
def interface(request: Request) -> Response:
    """The OpenAPI document to read in a browser."""
    return _answered(request, _interface(request.app))


@cache
def _interface(app: FastAPI) -> File:
    return File.of("docs.html", reference(app.openapi()).encode())


@router.get("/web/{name}")
async def part(name: str, request: Request) -> Response:
    """A script, the style sheet, the rules in words."""
    return _served(request, name)


def _served(request: Request, name: str) -> Response:
    file = page_files().get(name)
    if file is None:
        raise NotFound(f"the page has no file {name!r}")
    return _answered(request, file)


def _answered(request: Request, file: File) -> Response:
    """A file, or that the asker has it already."""
    headers = HEADERS | {"ETag": file.etag}
    if request.headers.get("if-none-match") == file.etag:
        return Response(status_code=304, headers=headers)
    return Response(file.content, media_type=file.media_type, headers=headers)
