"""Pictures from commands: which kind a file's ending asks for, and the strokes of a record as they were played."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from client.cli.output import USAGE, fail

if TYPE_CHECKING:
    from physics import Result, Shot
    from referee.record import Record

ENDINGS = (".svg", ".png", ".html")


def draw(file: Path, result: "Result", shot: "Shot | None", call: tuple[int, int] | None, title: str) -> None:
    """Write a picture of a shot; leaves the command when the file's ending is not one of `ENDINGS`."""
    import pictures

    ending = file.suffix.lower()
    if ending == ".html":
        write(file, pictures.html(pictures.ReplayShot(result, title), title=title).encode())
    elif ending == ".svg":
        write(file, pictures.svg(result, shot=shot, call=call, title=title).encode())
    elif ending == ".png":
        try:
            write(file, pictures.png(result, shot=shot, call=call, title=title))
        except ImportError as error:
            fail(str(error), USAGE)
    else:
        fail(f"file = {str(file)!r}: must end in {', '.join(ENDINGS)}", USAGE)


def write(file: Path, data: bytes) -> None:
    """Write a file; leaves the command when that cannot be done."""
    try:
        file.write_bytes(data)
    except OSError as error:
        fail(f"{file} cannot be written: {error.strerror}", USAGE)


def played(record: "Record", entry: Mapping[str, Any]) -> "tuple[Result, Shot]":
    """A stroke of a record simulated again, with its noise."""
    from physics import Shot, Table, TableState, simulate

    shot = Shot.from_dict(entry["shot"])
    return simulate(Table.from_dict(record.header["table"]), TableState.from_dict(entry["before"]), shot), shot


def called(entry: Mapping[str, Any]) -> tuple[int, int] | None:
    """The called ball and pocket of a stroke."""
    call = entry["action"].get("call")
    return (call["ball"], call["pocket"]) if isinstance(call, dict) else None
