"""Bringing a database to the schema of this version of the server."""

from pathlib import Path
from typing import Final

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory
from sqlalchemy import Connection, exc, inspect

from server.errors import SettingsError
from server.settings import without_password
from server.store.database import Database
from server.store.locks import only_one

SCRIPTS = Path(__file__).parent / "migrations"
VERSION_TABLE: Final = "alembic_version"
ALWAYS_THERE: Final = frozenset({"agents", "matches", "games", "moves"})
"""Tables that a Pooliad database of any version has."""
MOST_NAMED: Final = 3
"""Foreign tables that are named in an error."""


def upgrade(database: Database) -> None:
    """Create the tables, or run the migrations that are missing, in one transaction; one process at a time.

    Raises `SettingsError` for what is no database, another program's or a newer Pooliad's, and leaves it unchanged.
    """
    try:
        with database.writing() as connection:
            only_one(connection, "upgrade")
            _require_ours(connection, database.url)
            config = _config()
            config.attributes["connection"] = connection
            command.upgrade(config, "head")
    except exc.DBAPIError as error:
        raise _unusable(database.url, f"must be a database of Pooliad or a new file; {error.orig}") from error


def _require_ours(connection: Connection, url: str) -> None:
    """Raise `SettingsError` for a database that this version must not touch; an empty one is new."""
    tables = set(inspect(connection).get_table_names())
    if not tables:
        return
    if VERSION_TABLE not in tables or not tables >= ALWAYS_THERE:
        names = sorted(tables - {VERSION_TABLE})[:MOST_NAMED]
        there = f"has tables of another program ({', '.join(names)})" if names else "was made by another program"
        raise _unusable(url, f"must be a database of Pooliad or empty; this one {there}")
    stored = MigrationContext.configure(connection).get_current_heads()
    known = {script.revision for script in ScriptDirectory.from_config(_config()).walk_revisions()}
    if unknown := sorted(set(stored) - known):
        raise _unusable(
            url,
            f"must be of this version or older; a newer version of Pooliad wrote it (tables {', '.join(unknown)}, "
            f"here {head()}): start that version, or use a backup made before the upgrade",
        )


def _unusable(url: str, what: str) -> SettingsError:
    return SettingsError(f"database = {without_password(url)}: {what}")


def is_current(database: Database) -> bool:
    """Whether the database has exactly this version's schema."""
    with database.reading() as connection:
        stored = MigrationContext.configure(connection).get_current_revision()
    return stored == head()


def head() -> str | None:
    """The revision of this version's schema."""
    return ScriptDirectory.from_config(_config()).get_current_head()


def _config() -> Config:
    config = Config()
    config.set_main_option("script_location", str(SCRIPTS).replace("%", "%%"))
    return config
