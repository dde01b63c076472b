"""A copy of a database that is being served: `python -m server.backup --database sqlite:///pooliad.db FILE`.

SQLite's online backup: the copy is the database as it was at one moment between two transactions. Nobody waits for it
but who copies. It is checked before it gets its name.
"""

import argparse
import json
import os
import sqlite3
import sys
from contextlib import closing
from pathlib import Path

from server.errors import SettingsError
from server.settings import Settings, without_password
from server.store import postgresql
from server.store.files import create_private, exposure
from server.store.sqlite import path_of


def backup(url: str, target: Path) -> int:
    """Copy the database of `url` into a new file; its size in bytes.

    The file is readable for its owner alone: it holds the seeds of games that are being played. Raises `SettingsError`
    when there is no such database, the target is there already, or the database is not SQLite's.
    """
    source = Path(path_of(_sqlite(url)))
    if not source.is_file():
        raise SettingsError(f"there is no database {source}")
    if target.exists():
        raise SettingsError(f"target = {target}: must be the name of a new file; this one exists")
    unfinished = target.with_name(f"{target.name}.unfinished")
    try:
        _copy(source, unfinished)
        unfinished.rename(target)
    finally:
        unfinished.unlink(missing_ok=True)
    _flush(target.parent)
    return target.stat().st_size


def _sqlite(url: str) -> str:
    Settings(database=url)
    if postgresql.is_ours(url):
        raise SettingsError(
            f"{without_password(url)} is copied while it is served by PostgreSQL's own pg_dump: "
            "pg_dump --format=custom --file=FILE --dbname=URL"
        )
    return url


def _copy(source: Path, target: Path) -> None:
    target.unlink(missing_ok=True)  # of a run that was killed, or planted here: with another mode, or a link elsewhere
    create_private(str(target))
    existing = f"{source.absolute().as_uri()}?mode=rw"
    with closing(sqlite3.connect(existing, uri=True)) as served, closing(sqlite3.connect(target)) as copy:
        served.backup(copy)  # in one step: a reader of one moment, beside whom others write on
        (verdict,) = copy.execute("PRAGMA integrity_check").fetchone()
    if verdict != "ok":
        raise SettingsError(f"the copy of {source} is damaged, and so may be the database: {verdict}")
    _flush(target)


def _flush(path: Path) -> None:
    """Have what was written survive a power cut."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)


def main() -> None:
    """Copy, and say so on one line."""
    parser = argparse.ArgumentParser(prog="python -m server.backup", description=__doc__)
    parser.add_argument("--database", default=os.environ.get("POOLIAD_DATABASE", "sqlite:///pooliad.db"))
    parser.add_argument("file", type=Path, help="the copy; it must not be there yet")
    options = parser.parse_args()
    try:
        size = backup(options.database, options.file)
        if warning := exposure(path_of(options.database)):
            print(f"pooliad backup: {warning}", file=sys.stderr)  # noqa: T201
    except (SettingsError, OSError, sqlite3.Error) as error:
        sys.exit(f"pooliad backup: {error}")
    print(json.dumps({"backup": str(options.file), "bytes": size}))  # noqa: T201


if __name__ == "__main__":
    main()
