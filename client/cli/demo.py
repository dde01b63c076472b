"""`pooliad demo`: a server, two agents and a match between them, for real, from one command."""

from pathlib import Path
from typing import Annotated

import typer

from client.cli.output import USAGE, Json, emit, fail
from client.cli.tables import NAMES, load_table


def demo(
    agents: Annotated[
        tuple[str, str],
        typer.Option(
            help="Two agents, as in greedy random: each random, greedy, search, search:seconds=0.3, module:Class, or "
            "stdio:COMMAND."
        ),
    ] = ("greedy", "random"),
    games: Annotated[int, typer.Option(min=1, max=1000, help="Games in the match.")] = 1,
    seed: Annotated[
        int | None, typer.Option(min=0, help="Repeats racks, first breaker, noise and the agents' choices.")
    ] = None,
    noise: Annotated[float, typer.Option(min=0.0, max=5.0, help="Noise level; 1 is the Olympiad's.")] = 1.0,
    table: Annotated[str, typer.Option(help=f"{NAMES}, JSON with parameters, or a TOML file of them.")] = "olympiad",
    out: Annotated[
        Path | None, typer.Option(help="Directory for records, database and logs; a new one unless given.")
    ] = None,
    as_json: Json = False,
) -> None:
    """Play a real 8-ball match: embedded server and database, two agents as processes, over HTTP."""
    import secrets

    from client.cli.demo_session import DemoSession
    from client.cli.players import load_player
    from client.cli.processes import children
    from client.cli.serve import require_server

    require_server()
    cloth = load_table(table)
    for name in agents:
        load_player(name)
    seed = secrets.randbelow(2**32) if seed is None else seed
    directory = _directory(out)
    with children() as started:
        stage = DemoSession(started, directory, agents, seed, quiet=as_json)
        report = stage.play(games, noise, cloth)
    if as_json:
        emit(report)
    if report["status"] != "finished":
        fail(f"the match was {report['status']}; logs are in {directory}")


def _directory(out: Path | None) -> Path:
    """Where to keep things: the directory asked for, or a fresh one that stays."""
    import tempfile

    if out is None:
        return Path(tempfile.mkdtemp(prefix="pooliad-demo-"))
    out.mkdir(parents=True, exist_ok=True)
    if (out / "pooliad.db").exists():
        fail(f"{out} holds an earlier demo (pooliad.db); choose another --out", USAGE)
    return out.resolve()
