"""`pooliad agent check`: does an agent keep the protocol, in every situation?"""

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from client.cli.output import FAILED, USAGE, Json, emit, fail, say

if TYPE_CHECKING:
    from client.compliance import Report, Situation


def check(
    name: Annotated[
        str | None, typer.Argument(help="random, greedy, search, module:Class of your own, or stdio:COMMAND.")
    ] = None,
    command: Annotated[
        str | None,
        typer.Option(help="Instead: a program that speaks HTTP; POOLIAD_URL and POOLIAD_TOKEN are in its environment."),
    ] = None,
    only: Annotated[list[str] | None, typer.Option(help="One situation by name; may be given again.")] = None,
    out: Annotated[
        Path | None, typer.Option(help="Directory for the logs; unless given, a new one, kept if there are faults.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Play an agent through scripted situations on a server of its own, and say what it does wrong.

    Leaves with 0 when it did nothing wrong, with 1 when it did.
    """
    import shutil
    import tempfile

    from client.cli import embedded
    from client.cli.processes import children
    from client.compliance import Checker

    line = _command(name, command)
    situations = _situations(only)
    directory = Path(tempfile.mkdtemp(prefix="pooliad-check-")) if out is None else out
    directory.mkdir(parents=True, exist_ok=True)
    with children() as started:
        server = embedded.start(started, directory)
        checker = Checker(server.url, server.organiser, line, directory)
        reports = checker.run(situations, on_report=(lambda report: None) if as_json else _tell)
    faults = sum(len(report.faults) for report in reports)
    kept = faults > 0 or out is not None
    if not kept:
        shutil.rmtree(directory)
    if as_json:
        where = str(directory) if kept else None
        emit({"ok": faults == 0, "directory": where, "situations": [each.to_dict() for each in reports]})
    else:
        say(f"{len(reports)} situations, {faults} faults" + (f"; logs in {directory}" if kept else ""))
    if faults:
        raise typer.Exit(FAILED)


def _command(name: str | None, command: str | None) -> list[str]:
    """What starts the agent; leaves the command when there is no such agent."""
    import shutil

    from client.cli.players import load_player

    if (name is None) == (command is None):
        fail("give exactly one of an agent's name and --command", USAGE)
    if name is not None:
        load_player(name)
        return [sys.executable, "-P", "-m", "client.cli", "agent", "run", "--forever", "--", name]
    try:
        line = shlex.split(command or "")
    except ValueError as error:
        fail(f"--command is {command!r}: {error}", USAGE)
    if not line:
        fail("--command is empty", USAGE)
    if shutil.which(line[0]) is None:
        fail(f"--command is {command!r}: {line[0]!r} is no program that can be run here", USAGE)
    return line


def _situations(only: list[str] | None) -> "list[Situation]":
    """Those asked for; all unless told."""
    from client.compliance import SITUATIONS

    names = [each.name for each in SITUATIONS]
    for name in only or ():
        if name not in names:
            fail(f"--only is {name!r}; situations are {', '.join(names)}", USAGE)
    return [each for each in SITUATIONS if not only or each.name in only]


def _tell(report: "Report") -> None:
    """A line for a situation, and one for each fault in it."""
    took = "" if report.seconds is None else f"  ({report.seconds:.1f} s)"
    say(f"{'FAULT' if report.faults else 'ok':5s}  {report.situation.name}: {report.situation.words}{took}")
    for fault in report.faults:
        say(f"       {fault.name}: {fault.words}")
