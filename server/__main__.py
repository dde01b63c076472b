"""`python -m server --host H --port P --database URL --processes N --config FILE`.

Other settings come from the file and from the environment (docs/operations.md).
"""

import argparse
import os
import sys
from pathlib import Path

from server.errors import SettingsError, Unavailable
from server.processes import serve_by_many
from server.serve import serve
from server.settings import effective

MOST_PROCESSES = 64


def main() -> None:
    """Read the command line and the environment, and serve."""
    options = _parser().parse_args()
    try:
        found = effective(options.config, os.environ, {"database": options.database})
        settings = found.settings
        if options.print_config:
            print(found)  # noqa: T201
        elif options.processes == 1:
            serve(settings, options.host, options.port)
        else:
            serve_by_many(settings, options.host, options.port, options.processes)
    except (SettingsError, Unavailable, OSError) as error:
        sys.exit(f"pooliad server: {error}")


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m server", description=__doc__)
    parser.add_argument("--host", default="127.0.0.1", help="address to listen on")
    parser.add_argument("--port", type=_port, default=8080, help="0 takes a free one")
    parser.add_argument(
        "--database", help="sqlite:///path or postgresql://…; else POOLIAD_DATABASE, else sqlite:///pooliad.db"
    )
    parser.add_argument("--config", type=Path, default=os.environ.get("POOLIAD_CONFIG"), help="a TOML file of settings")
    parser.add_argument("--print-config", action="store_true", help="print the settings in effect, and leave")
    parser.add_argument("--processes", type=_count, default=1, help="more than one on PostgreSQL only")
    return parser


def _port(text: str) -> int:
    port = int(text)
    if not 0 <= port <= 65535:
        raise argparse.ArgumentTypeError(f"port = {port}: must be from 0 to 65535")
    return port


def _count(text: str) -> int:
    count = int(text)
    if not 1 <= count <= MOST_PROCESSES:
        raise argparse.ArgumentTypeError(f"processes = {count}: must be from 1 to {MOST_PROCESSES}")
    return count


if __name__ == "__main__":
    main()
