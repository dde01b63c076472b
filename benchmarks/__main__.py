"""`python -m benchmarks [NAME] [--full] [--json]`: what `pooliad bench` starts. Lists the benchmarks, or runs one."""

import argparse
import contextlib
import importlib
import io
import json
import sys
from collections.abc import Sequence
from typing import Any

from benchmarks import recording
from benchmarks.catalogue import BENCHMARKS


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; its exit code: 1 when the benchmark found failures, 2 when there is none of that name."""
    options = _parser().parse_args(arguments)
    if options.name is None:
        _list(options.json)
        return 0
    if options.name not in BENCHMARKS:
        print(f"pooliad: there is no benchmark {options.name!r}; there are {', '.join(BENCHMARKS)}", file=sys.stderr)
        return 2
    line = _run(options.name, options.full, quiet=options.json)
    if options.json:
        print(json.dumps(line, ensure_ascii=False, indent=2, allow_nan=False))
    failures = line["tables"].get("failures")
    if failures:
        print(f"pooliad: {options.name}: {len(failures)} failures", file=sys.stderr)
    return 1 if failures else 0


def _list(as_json: bool) -> None:
    """All benchmarks, a line each."""
    if as_json:
        print(json.dumps(BENCHMARKS, ensure_ascii=False, indent=2))
        return
    for name, summary in BENCHMARKS.items():
        print(f"{name:18} {summary}")


def _run(name: str, full: bool, quiet: bool) -> dict[str, Any]:
    """Run one and return its data line; ``quiet`` keeps its progress off standard output."""
    measure = importlib.import_module(f"benchmarks.{name}").measure
    with contextlib.redirect_stdout(io.StringIO()) if quiet else contextlib.nullcontext():
        return recording.run(name, measure, full)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="pooliad bench", description="Measure this machine.")
    parser.add_argument("name", nargs="?", help="benchmark to run; without it, all are listed")
    parser.add_argument("--full", action="store_true", help="the long run that documents cite")
    parser.add_argument("--json", action="store_true", help="print one JSON value instead of text")
    return parser


if __name__ == "__main__":
    sys.exit(main())
