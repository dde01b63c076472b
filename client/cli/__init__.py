"""The `pooliad` command, one file a subcommand. Each imports what it needs when it runs: help is quick."""

import sys
from typing import Annotated

import typer

from client.cli import agent, backup, bench, calibrate, demo, doctor, keys, replay, serve, simulate, tournament
from client.cli.doctor import show_version
from client.cli.output import FAILED
from client.cli.tables import TableCommand


def application() -> typer.Typer:
    """The command with all its subcommands."""
    app = typer.Typer(
        name="pooliad",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    app.callback()(pooliad)
    app.command("demo", cls=TableCommand)(demo.demo)
    app.command("serve")(serve.serve)
    app.command("backup")(backup.backup)
    app.command("simulate", cls=TableCommand)(simulate.simulate)
    app.command("calibrate", cls=TableCommand)(calibrate.calibrate)
    app.command("doctor")(doctor.doctor)
    app.command("bench")(bench.bench)
    app.add_typer(agent.commands(), name="agent")
    app.add_typer(replay.commands(), name="replay")
    app.add_typer(tournament.commands(), name="tournament")
    app.add_typer(keys.commands(), name="keys")
    return app


def pooliad(
    version: Annotated[
        bool, typer.Option("--version", is_eager=True, callback=show_version, help="Print the version and leave.")
    ] = False,
) -> None:
    """Computational pool: simulate, play, serve and replay 8-ball matches between programs."""


def main() -> None:
    """Entry point: an error of ours is one line on standard error, never a traceback."""
    try:
        application()()
    except Exception as error:
        from client.errors import PooliadError

        if not isinstance(error, PooliadError | OSError):
            raise
        print(f"pooliad: {error}", file=sys.stderr)
        sys.exit(FAILED)
