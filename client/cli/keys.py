"""`pooliad keys`: the keys that a server's records are signed with; and reading such keys for `replay verify`."""

import os
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, NoReturn

import typer

from client.cli.output import USAGE, fail
from client.cli.serve import require_server

if TYPE_CHECKING:
    from protocol import KeyView
    from referee.record import PublicKey

Database = Annotated[
    str | None, typer.Option(envvar="POOLIAD_DATABASE", help="The server's database; its own default unless given.")
]


def commands() -> typer.Typer:
    """The subcommands."""
    app = typer.Typer(help="Show and rotate the keys that a server signs records with.", no_args_is_help=True)
    app.command("show")(show)
    app.command("rotate")(rotate)
    return app


def show(database: Database = None) -> None:
    """Print the public keys as JSON, as GET /v1/keys answers them."""
    _run("show", database)


def rotate(database: Database = None) -> None:
    """Make a new key and retire the one in use; records signed before keep verifying."""
    _run("rotate", database)


def read_keys(given: str) -> list["PublicKey"]:
    """The public keys that a user names: 64 hexadecimal digits, a server's address, or a file with either answer.

    Leaves the command when there are none to be had.
    """
    if given.startswith(("http://", "https://")):
        return _listed(_fetched(given), given)
    if (path := Path(given)).is_file():
        try:
            given, text = str(path), path.read_text(encoding="utf-8").strip()
        except (OSError, UnicodeDecodeError) as error:
            fail(f"--key {given} cannot be read: {error}", USAGE)
        return _listed(text.encode(), given) if text.startswith("{") else [_single(text, given)]
    return [_single(given, given)]


def _run(action: str, database: str | None) -> NoReturn:
    require_server()
    options = [] if database is None else ["--database", database]
    # -P: a folder called server where the user stands is not ours
    command = [sys.executable, "-P", "-m", "server.keys", action, *options]
    os.execv(command[0], command)


def _fetched(url: str) -> bytes:
    """What a server answers about its keys."""
    import httpx2

    address = url if url.rstrip("/").endswith("/v1/keys") else f"{url.rstrip('/')}/v1/keys"
    try:
        response = httpx2.get(address, timeout=30.0)
        response.raise_for_status()
    except httpx2.HTTPError as error:
        fail(f"--key {url}: {error}")
    return response.content


def _listed(text: bytes, given: str) -> list["PublicKey"]:
    """The keys in an answer of `GET /v1/keys`."""
    from pydantic import ValidationError

    from protocol import KeyList

    try:
        return [_of_view(view) for view in KeyList.model_validate_json(text).keys]
    except ValidationError as error:
        fail(f"--key {given} holds no keys as GET /v1/keys answers them: {error.errors()[0]['msg']}", USAGE)


def _of_view(view: "KeyView") -> "PublicKey":
    from referee.record import PublicKey

    until = None if view.valid_until is None else _time_text(view.valid_until)
    return PublicKey(bytes.fromhex(view.public_key), _time_text(view.valid_from), until)


def _single(text: str, given: str) -> "PublicKey":
    from referee.record import PublicKey

    try:
        return PublicKey.from_hex(text)
    except ValueError as error:
        fail(f"--key {given} is no server's address, no file and no key: {error}", USAGE)


def _time_text(time: datetime) -> str:
    """A point in time as seals hold it."""
    return time.astimezone(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
