"""Bringing a database to the schema of this version of the server."""

from pathlib import Path

from alembic import command
from alembic.config import Config
from alembic.runtime.migration import MigrationContext
from alembic.script import ScriptDirectory

from server.store.database import Database
from server.store.locks import only_one

SCRIPTS = Path(__file__).parent / "migrations"


def upgrade(database: Database) -> None:
    """Create the tables, or run the migrations that are missing, in one transaction; one process at a time."""
    with database.writing() as connection:
        only_one(connection, "upgrade")
        config = _config()
        config.attributes["connection"] = connection
        command.upgrade(config, "head")


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
