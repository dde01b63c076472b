"""`pooliad tournament`: run events, take them up again, decide about them while they run."""

import contextlib
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from client.cli.output import USAGE, Json, emit, fail, say

if TYPE_CHECKING:
    from client.arena.directory import EventDirectory
    from client.arena.remote import RemoteRunner
    from client.arena.runner import Observer, Runner
    from client.arena.terms import Terms
    from tournament import GameResult
    from tournament.ledger import Ledger
    from tournament.luck import GameLuck

REPLAYS = "replays"
"""Folder of an event's games as pages that play them."""
Event = Annotated[Path, typer.Argument(help="Directory of the event.")]
Executor = Annotated[str, typer.Option(help="Where games are played: processes, inline, or dask://HOST:PORT.")]
Workers = Annotated[int | None, typer.Option(min=1, max=4096, help="Processes; one for each core unless given.")]
Server = Annotated[str | None, typer.Option(envvar="POOLIAD_URL", help="Address of a server that makes the matches.")]
Token = Annotated[
    str | None, typer.Option(envvar="POOLIAD_ORGANISER_TOKEN", help="An organiser's; better in the environment.")
]
Reason = Annotated[str, typer.Option(help="Why; it stays in the journal.")]


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
        _estimate(terms, workers, as_json)
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
    event = _opened(directory)
    _play(event, Terms.from_dict(event.terms()), _Where(executor, workers, server, token), as_json)


def status(directory: Event, as_json: Json = False) -> None:
    """How an event stands, running or not."""
    event = _opened(directory)
    _report(event, _ledger(event), as_json)


def report(
    directory: Event,
    luck: Annotated[
        bool,
        typer.Option("--luck", help="Simulate strokes with fresh noise, seconds a game, to tell luck."),
    ] = False,
    replays: Annotated[
        int, typer.Option(min=0, help="Games to write as pages that play them, the newest; some 40 KB each.")
    ] = 100,
    as_json: Json = False,
) -> None:
    """Write an event's report, finished or not: a page, games to watch, JSON, and tables, into its directory."""
    import json

    from client.arena.directory import write_whole
    from client.arena.remote import PLACE
    from tournament.report import csv_text, event_report, json_lines, page, turning_points

    event = _opened(directory)
    played = _ledger(event).event
    at_server = (directory / PLACE).exists()  # there a seed is chosen for tests alone, and nobody is rated
    rated = not (at_server and played.spec.foreseeable)
    records = {one.record: directory / one.record for one in played.counted if (directory / one.record).is_file()}
    moments = turning_points(records)
    watched = dict.fromkeys([*(one.record for one in moments), *reversed(records)][: replays + len(moments)])
    data = event_report(
        played,
        _luck(directory, played.counted) if luck else None,
        rated=rated,
        moments=moments,
        replays=_replays(directory, {name: records[name] for name in watched} if replays else {}),
    )
    texts = {
        "report.html": page(data),
        "report.json": json.dumps(data, ensure_ascii=False, allow_nan=False, indent=2) + "\n",
        "results.csv": csv_text(played.counted),
        "results.jsonl": "".join(f"{line}\n" for line in json_lines(played.counted)),
    }
    for name, text in texts.items():
        write_whole(directory / name, text.encode())
    if as_json:
        emit(data)
    else:
        say(f"{', '.join(texts)} in {directory}; open {directory / 'report.html'} in a browser")


def _luck(directory: Path, results: Sequence["GameResult"]) -> "dict[tuple[str, int], GameLuck]":
    """The luck of the games whose records lie in the directory."""
    from tournament.luck import game_luck

    files = {(one.pair, one.leg): directory / one.record for one in results if one.record}
    return {key: game_luck(path) for key, path in files.items() if path.is_file()}


def _replays(directory: Path, records: dict[str, Path]) -> dict[str, str]:
    """Write games as pages that play them; where each is, by its record."""
    from client.arena.directory import write_whole
    from tournament.report import replay

    (directory / REPLAYS).mkdir(exist_ok=True)
    found = {}
    for name, path in records.items():
        text = replay(path)
        if text is not None:
            found[name] = f"{REPLAYS}/{path.stem}.html"
            write_whole(directory / found[name], text.encode())
    return found


def pause(directory: Event, reason: Reason = "") -> None:
    """Start no further game until `go-on`; those under way are played to their end."""
    _decide(directory, "pause", reason=reason)


def go_on(directory: Event, reason: Reason = "") -> None:
    """Take back a pause; an event whose runner has left goes on with `resume`."""
    _decide(directory, "go_on", reason=reason)


def abort(directory: Event, reason: Reason = "") -> None:
    """End an event for good; its results so far stand."""
    _decide(directory, "abort", reason=reason)


def void(
    directory: Event,
    pair: Annotated[str, typer.Argument(help="Id of the pair, as in r0-m2-p1.")],
    leg: Annotated[int, typer.Argument(min=0, max=1, help="0 for its first game, 1 for its second.")],
    reason: Reason = "",
) -> None:
    """Take a finished game out of the event; it is played again, on the same racks with fresh noise."""
    _decide(directory, "void", pair=pair, leg=leg, reason=reason)


def disqualify(
    directory: Event, name: Annotated[str, typer.Argument(help="The entrant's name.")], reason: Reason = ""
) -> None:
    """Take an entrant out: its due games are forfeit, and it is not paired any more."""
    _decide(directory, "disqualify", name=name, reason=reason)


def _opened(directory: Path) -> "EventDirectory":
    from client.arena.directory import EventDirectory

    return EventDirectory.open(directory)


def _ledger(event: "EventDirectory") -> "Ledger":
    from client.arena.terms import Terms
    from tournament import Tournament as Played
    from tournament.ledger import Ledger

    return Ledger(Played(Terms.from_dict(event.terms()).spec)).after(event.journal.new())


def _decide(directory: Path, kind: str, **fields: Any) -> None:
    """Write an organiser's decision into the journal, if it can be carried out as the event stands."""
    from client.arena.remote import PLACE
    from tournament.ledger import Act

    event = _opened(directory)
    if (event.path / PLACE).exists():
        fail(f"{event.path} is an event at a server: POST /v1/tournaments/ID/… there decides about it", USAGE)
    before = _ledger(event)
    after = before.after([Act(kind, fields)])
    if len(after.refused) > len(before.refused):
        fail(after.refused[-1], USAGE)
    if before.aborted:
        fail("the event was aborted; nothing more can be decided about it", USAGE)
    event.journal.append(kind, by=_who(), **fields)
    say(f"noted in {event.journal.path}; a runner acts on it within a second")


def _who() -> str:
    """Who decides, for the journal."""
    import getpass

    try:
        return getpass.getuser()
    except (KeyError, OSError):
        return "unknown"


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
    _report(event, ledger, as_json)
    if ledger.aborted:
        fail("the event was aborted")


def _report(event: "EventDirectory", ledger: "Ledger", as_json: bool) -> None:
    """How the event stands, for people or as JSON."""
    if as_json:
        emit(_account(event, ledger))
        return
    from rich.console import Console

    from client.cli.progress import standings_table

    Console().print(standings_table(ledger))
    say(_sentence(event, ledger))


def _account(event: "EventDirectory", ledger: "Ledger") -> dict[str, Any]:
    """Everything about how the event stands."""
    from dataclasses import asdict

    from tournament import standings

    played = ledger.event
    return {
        "name": played.spec.name,
        "directory": str(event.path),
        "state": ledger.state,
        "games": len(played.counted),
        "due": len(played.due),
        "standings": [line.to_dict() for line in standings(played)],
        "sprt": None if played.test is None else asdict(played.test),
        "refused": list(ledger.refused),
    }


def _sentence(event: "EventDirectory", ledger: "Ledger") -> str:
    test = ledger.event.test
    words = f"{ledger.state}: {len(ledger.event.counted)} games; records and journal in {event.path}"
    if test is not None:
        words += f"; the test says {test.verdict} after {test.pairs} pairs (log-likelihood ratio {test.llr:.2f})"
    return words


def _estimate(terms: "Terms", workers: int | None, as_json: bool) -> None:
    """Say what the event will take."""
    from client.arena.estimate import estimate
    from client.arena.executors import cores

    found = estimate(terms, workers or cores())
    if as_json:
        emit(found.to_dict())
        return
    games = f"{found.games[0]}" if found.games[0] == found.games[1] else f"{found.games[0]} to {found.games[1]}"
    say(f"{terms.spec.name}: {len(terms.spec.entrants)} entrants, {terms.spec.format}, {games} games")
    if found.seconds is not None:
        low, high = (_duration(each) for each in found.seconds)
        span = low if low == high else f"{low} to {high}"
        say(
            f"about {span} with {found.workers} workers ({found.sampled} sample games, {found.game_seconds:.1f} s each)"
        )
    if found.longest_seconds is not None:
        say(f"at most {_duration(found.longest_seconds)}, if everybody used the whole clock")


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes} min" if hours else f"{minutes} min {rest} s" if minutes else f"{rest} s"
