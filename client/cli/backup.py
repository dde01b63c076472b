"""`pooliad backup`: copy a database that is being served."""

from pathlib import Path
from typing import Annotated

import typer

from client.cli.serve import require_server


def backup(
    file: Annotated[Path, typer.Argument(help="The copy; a new file.")],
    database: Annotated[
        str, typer.Option(envvar="POOLIAD_DATABASE", help="What to copy: sqlite:///path.")
    ] = "sqlite:///pooliad.db",
) -> None:
    """Copy a server's SQLite database while it serves."""
    import os
    import sys

    require_server()
    # -P: a folder called server where the user stands is not ours
    os.execv(sys.executable, [sys.executable, "-P", "-m", "server.backup", "--database", database, "--", str(file)])
