"""`pooliad serve`: run the match server."""

from importlib.util import find_spec
from pathlib import Path
from typing import Annotated

import typer

from client.cli.output import fail

NEEDED = ("fastapi", "uvicorn", "prometheus_client", "sqlalchemy", "alembic", "psycopg")
"""What the `server` extra brings."""


def require_server() -> None:
    """Leave with what to install when the server's libraries are not there."""
    missing = [name for name in NEEDED if find_spec(name) is None]
    if missing:
        fail(f"the server needs {', '.join(missing)}; install it with: pip install 'pooliad[server]'")


def server_command(host: str, port: int, database: str | None) -> list[str]:
    """The command line that runs the server as a program; leaves with what to install when it cannot run."""
    import sys

    require_server()
    # -P: a folder called server where the user stands is not ours
    command = [sys.executable, "-P", "-m", "server", "--host", host, "--port", str(port)]
    return command if database is None else [*command, "--database", database]


def serve(
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on; 0 picks a free one.")] = 8080,
    database: Annotated[
        str | None, typer.Option(help="Where games are kept: sqlite:///path or postgresql://…; else a setting.")
    ] = None,
    processes: Annotated[int, typer.Option(min=1, help="Server processes; more than one on PostgreSQL only.")] = 1,
    config: Annotated[
        Path | None,
        typer.Option(envvar="POOLIAD_CONFIG", help="A TOML file of settings."),
    ] = None,
    print_config: Annotated[bool, typer.Option(help="Print the settings in effect and leave.")] = False,
) -> None:
    """Serve matches over HTTP until interrupted."""
    import os

    command = [*server_command(host, port, database), "--processes", str(processes)]
    command += ["--config", str(config)] if config else []
    command += ["--print-config"] if print_config else []
    os.execv(command[0], command)
