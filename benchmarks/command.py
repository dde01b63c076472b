"""`python -m benchmarks.NAME [--full]`."""

import sys
from collections.abc import Callable
from typing import NoReturn

from benchmarks import recording


def main(name: str, measure: Callable[[bool], recording.Tables]) -> NoReturn:
    """Run the benchmark of this name; leaves with 1 when its table of failures has a row."""
    unknown = [word for word in sys.argv[1:] if word != "--full"]
    if unknown:
        print(f"benchmarks.{name}: unknown {unknown}; the only option is --full", file=sys.stderr)
        sys.exit(2)
    line = recording.run(name, measure, "--full" in sys.argv)
    sys.exit(1 if line["tables"].get("failures") else 0)
