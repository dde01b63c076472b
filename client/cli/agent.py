"""`pooliad agent`: play on a server."""

from typing import Annotated

import typer

from client.cli.output import USAGE, Json, emit, fail, say
from client.cli.players import load_player


def commands() -> typer.Typer:
    """The subcommands."""
    app = typer.Typer(help="Run agents.", no_args_is_help=True)
    app.command("run")(run)
    app.callback()(_group)
    return app


def _group() -> None:
    """Run agents."""


def run(
    name: Annotated[str, typer.Argument(help="random, greedy, or module:Class of your own.")],
    url: Annotated[str, typer.Option(envvar="POOLIAD_URL", help="Address of the server.")],
    token: Annotated[str, typer.Option(envvar="POOLIAD_TOKEN", help="The agent's token; better in the environment.")],
    seed: Annotated[int | None, typer.Option(min=0, help="Makes a shipped agent repeat its choices.")] = None,
    as_json: Json = False,
) -> None:
    """Play every turn of an agent on a server until its match is over.

    What the agent does wrong is written to standard error.
    """
    import logging
    import sys

    from client.run import run_agent

    if not _can_be_sent(token):
        fail("--token holds characters that no token has: letters, digits and signs of ASCII only", USAGE)
    logging.basicConfig(stream=sys.stderr, format="%(asctime)s %(levelname)s %(message)s")
    over = run_agent(load_player(name, seed), url, token)
    if as_json:
        emit(over.model_dump(mode="json"))
    else:
        score = f"{over.score[0]:g} to {over.score[1]:g}"
        say(f"match {over.match} {over.status}: {score}, this was seat {over.seat}")


def _can_be_sent(token: str) -> bool:
    """Whether an HTTP header can carry it: visible ASCII without spaces."""
    return bool(token) and all("!" <= character <= "~" for character in token)
