"""`pooliad bench`: measure this machine with the benchmarks of a checkout, which are a program of their own."""

from pathlib import Path
from typing import Annotated

import typer

from client.cli.output import Json, fail


def bench(
    name: Annotated[str | None, typer.Argument(help="Benchmark to run; without it, all are listed.")] = None,
    full: Annotated[bool, typer.Option("--full", help="The long run that documents cite.")] = False,
    as_json: Json = False,
) -> None:
    """Run a benchmark from a checkout and append what it measured to benchmarks/results.

    Leaves with 1 when the benchmark found failures.
    """
    import os
    import sys

    root = Path(__file__).resolve().parents[2]
    if not (root / "benchmarks" / "__main__.py").is_file():
        fail("benchmarks are not installed: run `pooliad bench` from a checkout (pip install -e '.[test]')")
    chosen = {"--full": full, "--json": as_json}
    options = [option for option, on in chosen.items() if on] + ([] if name is None else ["--", name])
    path = os.pathsep.join(filter(None, [str(root), os.environ.get("PYTHONPATH")]))
    # -P: a folder called benchmarks where the user stands is not ours
    os.execve(sys.executable, [sys.executable, "-P", "-m", "benchmarks", *options], os.environ | {"PYTHONPATH": path})
