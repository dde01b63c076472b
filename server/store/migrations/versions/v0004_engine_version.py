"""The version of the engine that a match is committed to: two versions may have the same engine.

Every match of a database without this column was made by version 0.1.0.
"""

import sqlalchemy as sa
from alembic import op

revision = "0004"
down_revision = "0003"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add it."""
    column = sa.Column("engine_version", sa.String(length=64), nullable=False, server_default="0.1.0")
    op.add_column("matches", column)
    if op.get_bind().dialect.name != "sqlite":  # which cannot drop a default; nothing relies on it
        op.alter_column("matches", "engine_version", server_default=None)
