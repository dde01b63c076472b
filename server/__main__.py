"""`python -m server --host H --port P --database URL --processes N`.

Other settings come from the environment.
"""

import argparse
import dataclasses
import os
import sys

from server.errors import SettingsError
from server.processes import serve_by_many
from server.serve import serve
from server.settings import Settings

MOST_PROCESSES = 64


def main() -> None:
    """Read the command line and the environment, and serve."""
    options = _parser().parse_args()
    try:
        settings = Settings.from_environment(os.environ)
        if options.database is not None:
            settings = dataclasses.replace(settings, database=options.database)
        if options.processes == 1:
            serve(settings, options.host, options.port)
        else:
            serve_by_many(settings, options.host, options.port, options.processes)
    except (SettingsError, OSError) as error:
        sys.exit(f"pooliad server: {error}")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m server", description=__doc__)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on")
    parser.add_argument("--port", type=_port, default=8080, help="0 takes a free one")
    parser.add_argument(
        "--database", help="sqlite:///path or postgresql://…; else POOLIAD_DATABASE, else sqlite:///pooliad.db"
    )
    parser.add_argument("--processes", type=_count, default=1, help="more than one on PostgreSQL only")
    return parser


def _port(text: str) -> int:
    port = int(text)
    if not 0 <= port <= 65535:
        raise argparse.ArgumentTypeError(f"{port} is no port; allowed: 0 to 65535")
    return port


def _count(text: str) -> int:
    count = int(text)
    if not 1 <= count <= MOST_PROCESSES:
        raise argparse.ArgumentTypeError(f"{count} processes; allowed: 1 to {MOST_PROCESSES}")
    return count


if __name__ == "__main__":
    main()
