"""`pooliad replay`: look at the record of a game, and verify it."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from client.cli.output import FAILED, USAGE, Json, emit, fail, say
from client.cli.reproduce import Form, reproduction

if TYPE_CHECKING:
    from referee.record import Record, Verification

File = Annotated[Path, typer.Argument(help="A record: JSON lines as the server and the demo write them.")]


def commands() -> typer.Typer:
    """The subcommands."""
    app = typer.Typer(help="Show, draw and verify records of games.", no_args_is_help=True)
    app.command("show")(show)
    app.command("verify")(verify)
    app.command("picture")(picture)
    app.command("html")(page)
    return app


def show(
    file: File,
    shot: Annotated[
        int | None, typer.Option(min=1, help="One stroke with its events, by the number the list shows.")
    ] = None,
    form: Annotated[
        Form | None, typer.Option("--as", help="With --shot: what simulates it again, as a program or a request.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Print a game, a sentence a stroke; or one stroke with everything that happened in it."""
    record = _read(file)
    if form is not None and (shot is None or as_json):
        fail("--as goes with --shot, and without --json", USAGE)
    with _whole(file):
        if form is not None and shot is not None:
            print(reproduction(record.header, _stroke(record, shot), form))
        elif shot is not None:
            _show_stroke(record, shot, as_json)
        elif as_json:
            emit({"header": record.header, "strokes": record.entries, "end": record.end})
        else:
            _tell_game(record)


def picture(
    file: File,
    shot: Annotated[int, typer.Option(min=1, help="The stroke, by the number that `replay show` lists.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Where to: .svg, .png or .html, which moves.")],
) -> None:
    """Draw one stroke as it was played, noise included."""
    from client.cli.drawing import called, draw, played

    record = _read(file)
    with _whole(file):
        entry = _stroke(record, shot)
        result, stroke = played(record, entry)
        sentence, call = _sentence(entry, record.header["players"]), called(entry)
    draw(output, result, stroke, call, sentence)
    say(f"{output}")


def page(
    file: File,
    output: Annotated[Path, typer.Option("--output", "-o", help="Where to.")],
) -> None:
    """Write the whole game as one HTML file that plays it, without a network."""
    import pictures
    from client.cli.drawing import played, write

    record = _read(file)
    with _whole(file):
        players = record.header["players"]
        strokes = [entry for entry in record.entries if entry["stroke"] is not None]
        scenes = [pictures.ReplayShot(played(record, entry)[0], _sentence(entry, players)) for entry in strokes]
    if not scenes:
        fail(f"{file}: nothing was played in this game")
    write(output, pictures.html(scenes, title=f"{players[0]} against {players[1]}").encode())
    say(f"{output}")


def verify(
    file: File,
    key: Annotated[
        str | None,
        typer.Option(
            help="Whose signature it must bear: a server's address, a public key (64 hexadecimal digits), or a file."
        ),
    ] = None,
    as_json: Json = False,
) -> None:
    """Play a record again from its secrets and actions, compare every bit, and check chain and signature.

    Leaves with 1 and names the first difference when the record is not what really follows, a line does not
    continue the one before it, or the signature is not the given key's. A record that another engine made is
    played again too, and said to be that one's.
    """
    from client.cli.keys import read_keys
    from referee.record import verify_record

    try:
        found = verify_record(file, None if key is None else read_keys(key))
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{file} cannot be read: {error}", USAGE)
    if as_json:
        emit(_verification(file, found))
    else:
        say(f"{file}: {found}")
    if not found.ok:
        raise typer.Exit(FAILED)


def _verification(file: Path, found: "Verification") -> dict[str, Any]:
    """What was found, as JSON."""
    return {
        "record": str(file),
        "ok": found.ok,
        "verdict": found.verdict.value,
        "strokes": found.strokes,
        "outcome": None if found.outcome is None else found.outcome.to_dict(),
        "budget": None if found.budget is None else found.budget.to_dict(),
        "simulated": found.simulated,
        "difference": None if found.difference is None else asdict(found.difference),
        "needs": None if found.needs is None else found.needs.to_dict(),
        "chain": None if found.chain is None else asdict(found.chain),
        "signature": None if found.seal is None else asdict(found.seal),
        "words": str(found),
    }


def _read(file: Path) -> "Record":
    """The record in a file; leaves the command when it is none."""
    from referee.record import InvalidRecord, read_record

    try:
        return read_record(file)
    except InvalidRecord as error:
        fail(f"{file} is no record of a game: {error}")
    except (OSError, UnicodeDecodeError) as error:
        fail(f"{file} cannot be read: {error}", USAGE)


@contextmanager
def _whole(file: Path) -> Iterator[None]:
    """Leave the command when a record lacks what a record has."""
    try:
        yield
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        fail(f"{file} is no whole record of a game: {error!r}")


def _sentence(entry: dict[str, Any], players: tuple[str, str]) -> str:
    """A stroke or a decision in a sentence."""
    from client.cli.sentences import sentence

    return sentence(entry["stroke"], players, entry["ruling"]["words"], entry["ruling"]["rules"])


def _tell_game(record: "Record") -> None:
    """The whole game, for people."""
    header, outcome = record.header, record.end["outcome"]
    players, level = header["players"], header["noise"]["level"]
    winner = "nobody" if outcome["winner"] is None else players[outcome["winner"]]
    say(f"{players[0]} against {players[1]}, noise {level:g}")
    for entry in record.entries:
        say(_sentence(entry, players))
    say(f"{winner} wins: {outcome['reason']} ({outcome['rule']})")


def _stroke(record: "Record", number: int) -> dict[str, Any]:
    """The stroke of this number, from 1; leaves the command when there is none."""
    entry = next((each for each in record.entries if each["stroke"] == number - 1), None)
    if entry is None:
        strokes = sum(each["stroke"] is not None for each in record.entries)
        fail(f"--shot is {number}; this game has strokes 1 to {strokes}", USAGE)
    return entry


def _show_stroke(record: "Record", number: int, as_json: bool) -> None:
    """One stroke in full."""
    entry = _stroke(record, number)
    if as_json:
        emit(entry)
    else:
        _tell_stroke(entry, record.header["players"])


def _tell_stroke(entry: dict[str, Any], players: tuple[str, str]) -> None:
    """One stroke in full, for people."""
    from client import notation
    from physics import Event, EventKind, TableState

    say(_sentence(entry, players))
    say(f"from   {notation.write(TableState.from_dict(entry['before']))}")
    for title, shot in (("meant", entry["action"]["shot"]), ("played", entry["shot"])):
        say(f"{title:6s} " + "  ".join(f"{name} {value:.6g}" for name, value in shot.items()))
    for event in entry["events"]:
        kind = EventKind(event["kind"])
        say(f"{event['index']:4d}  {Event(event['index'], event['time'], kind, event['ball'], event['other'], ())}")
    say(f"to     {notation.write(TableState.from_dict(entry['final']))}")
