"""`pooliad tournament`: run events, take them up again, decide about them while they run."""

import contextlib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from client.cli.event_decisions import abort, disqualify, go_on, pause, void
from client.cli.event_estimate import say_estimate
from client.cli.event_report import report
from client.cli.events import Event, ledger_of, opened, say_standing
from client.cli.output import USAGE, Json, fail

if TYPE_CHECKING:
    from client.arena.directory import EventDirectory
    from client.arena.remote import RemoteRunner
    from client.arena.runner import Observer, Runner
    from client.arena.terms import Terms

Executor = Annotated[str, typer.Option(help="Where games are played: processes, inline, or dask://HOST:PORT.")]
Workers = Annotated[int | None, typer.Option(min=1, max=4096, help="Processes; one for each core unless given.")]
Server = Annotated[str | None, typer.Option(envvar="POOLIAD_URL", help="Address of a server that makes the matches.")]
Token = Annotated[
    str | None, typer.Option(envvar="POOLIAD_ORGANISER_TOKEN", help="An organiser's; better in the environment.")
]


def commands() -> typer.Typer:
    """The subcommands."""
    app = typer.Typer(help="Run tournaments.", no_args_is_help=True)
    for name, command in (
        ("run", run),
        ("resume", resume),
        ("status", status),
        ("report", report),
        ("pause", pause),
        ("go-on", go_on),
        ("abort", abort),
        ("void", void),
        ("disqualify", disqualify),
    ):
        app.command(name)(command)
    return app


def run(
    file: Annotated[Path, typer.Argument(help="The event's terms, TOML (docs/running-tournaments.md).")],
    out: Annotated[Path | None, typer.Option(help="Directory for the event; the file's name unless given.")] = None,
    executor: Executor = "processes",
    workers: Workers = None,
    server: Server = None,
    token: Token = None,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Only check the file and estimate the duration.")] = False,
    as_json: Json = False,
) -> None:
    """Play an event to its end, from its first game.

    Interrupted, it goes on with `pooliad tournament resume DIRECTORY`.
    """
    from client.arena.directory import EventDirectory
    from client.arena.hosted_agents import find_here
    from client.arena.terms import Terms

    find_here()
    terms = Terms.read(file)
    if dry_run:
        say_estimate(terms, workers, as_json)
        return
    directory = EventDirectory.create(out or Path(file.stem), terms.to_dict())
    directory.journal.append("opened", file=str(file))
    _play(directory, terms, _Where(executor, workers, server, token), as_json)


def resume(
    directory: Event,
    executor: Executor = "processes",
    workers: Workers = None,
    server: Server = None,
    token: Token = None,
    as_json: Json = False,
) -> None:
    """Take up an event that was interrupted: finished games stand, unfinished ones go on from their last stroke."""
    from client.arena.hosted_agents import find_here
    from client.arena.terms import Terms

    find_here()
    event = opened(directory)
    _play(event, Terms.from_dict(event.terms()), _Where(executor, workers, server, token), as_json)


def status(directory: Event, as_json: Json = False) -> None:
    """How an event stands, running or not."""
    event = opened(directory)
    say_standing(event, ledger_of(event), as_json)


@dataclass(frozen=True, slots=True)
class _Where:
    """Where an event is played: on an executor, or at a server."""

    executor: str
    workers: int | None
    server: str | None
    token: str | None

    @contextlib.contextmanager
    def runner(self, event: "EventDirectory", seen: "Observer") -> Iterator["Runner | RemoteRunner"]:
        """What runs the event there."""
        from client.arena.executors import pool_of
        from client.arena.remote import PLACE, RemoteRunner
        from client.arena.runner import Runner

        if self.server is not None:
            if self.token is None:
                fail("an event at a server takes an organiser's token: --token or POOLIAD_ORGANISER_TOKEN", USAGE)
            yield RemoteRunner(event, self.server, self.token, seen)
            return
        if (event.path / PLACE).exists():
            fail(f"{event.path} is an event at a server: give its address with --server", USAGE)
        with pool_of(self.executor, self.workers) as pool:
            yield Runner(event, pool, seen)


def _play(event: "EventDirectory", terms: "Terms", where: _Where, as_json: bool) -> None:
    """Play until the event is over, paused or interrupted, and say how it stands."""
    from client.cli.processes import termination_as_exception
    from client.cli.progress import shown
    from tournament.size import games_of

    try:
        with (
            termination_as_exception(),
            shown(games_of(terms.spec)[1], as_json) as seen,
            where.runner(event, seen) as it,
        ):
            ledger = it.run()
    except KeyboardInterrupt:
        event.journal.append("interrupted")
        fail(f"interrupted; go on with: pooliad tournament resume {event.path}", 130)
    except OSError as error:  # a full disk: the journal cannot say so
        fail(f"{error}; what was played stands, go on with: pooliad tournament resume {event.path}")
    say_standing(event, ledger, as_json)
    if ledger.aborted:
        fail("the event was aborted")
