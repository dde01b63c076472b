"""`pooliad agent`: play on a server."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from client.cli.check import check
from client.cli.explain import explain
from client.cli.output import USAGE, Json, emit, fail, say
from client.cli.players import load_player
from client.cli.position import read_position
from client.cli.tables import TableCommand

if TYPE_CHECKING:
    from client.agents.registry import Player
    from protocol import MatchOver

Name = Annotated[str, typer.Argument(help="random, greedy, search:seconds=0.3, module:Class, or stdio:COMMAND.")]
Url = Annotated[str, typer.Option(envvar="POOLIAD_URL", help="Address of the server.")]
Token = Annotated[str, typer.Option(envvar="POOLIAD_TOKEN", help="The agent's token; better in the environment.")]
Seed = Annotated[int | None, typer.Option(min=0, help="Makes a shipped agent repeat its choices.")]


def commands() -> typer.Typer:
    """The subcommands."""
    app = typer.Typer(help="Run agents.", no_args_is_help=True)
    app.command("run")(run)
    app.command("spar")(spar)
    app.command("check")(check)
    app.command("explain", cls=TableCommand)(explain)
    return app


def run(
    name: Name,
    url: Url,
    token: Token,
    seed: Seed = None,
    forever: Annotated[bool, typer.Option("--forever", help="Go on with the next match when one is over.")] = False,
    as_json: Json = False,
) -> None:
    """Play every turn of an agent on a server until its match is over.

    What the agent does wrong is written to standard error.
    """
    from client.run import run_agent, serve_agent

    _prepare(token)
    player = _ready(name, seed)
    if forever:
        serve_agent(player, url, token)
    _report(run_agent(player, url, token), as_json)


def spar(
    name: Name,
    bot: Annotated[str, typer.Argument(help="A house bot of the server.")],
    url: Url,
    token: Token,
    games: Annotated[int, typer.Option(min=1, max=10, help="Games in the match.")] = 1,
    noise: Annotated[float, typer.Option(min=0.0, max=5.0, help="Noise level; 1 is the Olympiad's.")] = 1.0,
    seconds: Annotated[float, typer.Option(min=1.0, max=900.0, help="Thinking time of each player in a game.")] = 300.0,
    start: Annotated[
        Path | None, typer.Option(help="JSON file with a position to begin from, as docs/protocol.md has it.")
    ] = None,
    seed: Seed = None,
    as_json: Json = False,
) -> None:
    """Challenge a house bot of the server and play the match."""
    from client.sparring import spar as play

    _prepare(token)
    begin = None if start is None else read_position(start)
    over = play(_ready(name, seed), url, token, bot, games=games, noise=noise, seconds=seconds, start=begin)
    _report(over, as_json)


def _prepare(token: str) -> None:
    """Look at the token, and let the agent's log be seen."""
    import logging
    import sys

    from client.cli.reports import report_if_asked

    if not _can_be_sent(token):
        fail("--token holds characters that no token has: letters, digits and signs of ASCII only", USAGE)
    logging.basicConfig(stream=sys.stderr, format="%(asctime)s %(levelname)s %(message)s")
    report_if_asked()


def _ready(name: str, seed: int | None) -> "Player":
    """The player of a name, with the physics loaded before a clock runs; a command's is its own."""
    from client.agents.registry import STDIO
    from client.prepare import prepare
    from physics import Table

    player = load_player(name, seed)
    if not name.startswith(STDIO):
        prepare(Table.olympiad())
    return player


def _report(over: "MatchOver", as_json: bool) -> None:
    """How the match ended."""
    if as_json:
        emit(over.model_dump(mode="json"))
    else:
        score = f"{over.score[0]:g} to {over.score[1]:g}"
        say(f"match {over.match} {over.status}: {score}, this was seat {over.seat}")


def _can_be_sent(token: str) -> bool:
    """Whether an HTTP header can carry it: visible ASCII without spaces."""
    return bool(token) and all("!" <= character <= "~" for character in token)
