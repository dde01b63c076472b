"""`python -m server.keys show|rotate --database URL`: the keys that records are signed with.

A running server takes a rotation up with the next game that ends.
"""

import argparse
import dataclasses
import os
import sys

from sqlalchemy.exc import SQLAlchemyError

from server.errors import SettingsError, Unavailable
from server.security import keys
from server.services.runtime.time import TimeSource
from server.settings import Settings
from server.store.database import Database
from server.store.upgrade import upgrade


def main() -> None:
    """Print the public keys as JSON, after a new one was made if that is asked for."""
    options = _parser().parse_args()
    try:
        settings = Settings.from_environment(os.environ)
        if options.database is not None:
            settings = dataclasses.replace(settings, database=options.database)
        print(_done(options.action, Database(settings.database)))  # noqa: T201
    except (SettingsError, Unavailable, OSError, SQLAlchemyError) as error:
        sys.exit(f"pooliad keys: {error}")


def _done(action: str, database: Database) -> str:
    upgrade(database)
    now = database.clock() if database.is_shared else TimeSource().now()
    with database.writing() as connection:
        if action == "rotate":
            keys.rotate(connection, now)
        keys.ensure(connection, now)
        listed = keys.published(connection)
    database.dispose()
    return listed.model_dump_json(indent=2)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m server.keys", description=__doc__)
    parser.add_argument("action", choices=("show", "rotate"), help="what to do")
    parser.add_argument("--database", help="else POOLIAD_DATABASE, else sqlite:///pooliad.db")
    return parser


if __name__ == "__main__":
    main()
