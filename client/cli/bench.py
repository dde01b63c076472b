"""`pooliad bench`: measure this machine with the benchmarks of a checkout."""

from typing import Annotated, Any

import typer

from client.cli.output import USAGE, Json, emit, fail, say


def bench(
    name: Annotated[str | None, typer.Argument(help="Benchmark to run; without it, all are listed.")] = None,
    full: Annotated[bool, typer.Option("--full", help="The long run that documents cite.")] = False,
    as_json: Json = False,
) -> None:
    """Run a benchmark from a checkout and append what it measured to benchmarks/results.

    Leaves with 1 when the benchmark found failures.
    """
    catalogue = _catalogue()
    if name is None:
        _list(catalogue, as_json)
        return
    if name not in catalogue:
        fail(f"there is no benchmark {name!r}; there are {', '.join(catalogue)}", USAGE)
    line = _run(name, full, quiet=as_json)
    if as_json:
        emit(line)
    if line["tables"].get("failures"):
        fail(f"{name}: {len(line['tables']['failures'])} failures")


def _catalogue() -> dict[str, str]:
    """The benchmarks of the checkout this package loads from."""
    import sys
    from pathlib import Path

    root = Path(__file__).resolve().parents[2]
    if not (root / "benchmarks" / "catalogue.py").is_file():
        fail("benchmarks are not installed: run `pooliad bench` from a checkout (pip install -e '.[test]')")
    if str(root) not in sys.path:
        sys.path.insert(0, str(root))
    from benchmarks.catalogue import BENCHMARKS

    return BENCHMARKS


def _list(catalogue: dict[str, str], as_json: bool) -> None:
    """All benchmarks, a line each."""
    if as_json:
        emit(catalogue)
        return
    for name, summary in catalogue.items():
        say(f"{name:18} {summary}")


def _run(name: str, full: bool, quiet: bool) -> dict[str, Any]:
    """Run one and return its data line; ``quiet`` keeps its progress off standard output."""
    import contextlib
    import importlib
    import io

    from benchmarks import recording

    measure = importlib.import_module(f"benchmarks.{name}").measure
    with contextlib.redirect_stdout(io.StringIO()) if quiet else contextlib.nullcontext():
        return recording.run(name, measure, full)
