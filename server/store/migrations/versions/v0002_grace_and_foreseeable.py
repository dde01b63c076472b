"""What is given back for turns fetched late; whether a match's seed was chosen."""

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the columns, each with a default: SQLite need not copy a table for them.

    Version 0.1.0 kept no account of what it gave back for turns fetched late. Nor did it keep whether an organiser had
    given a seed: every match that was no challenge (in which no seed can be given) counts as one that can be foreseen.
    """
    for table, names in (("games", ("grace_0", "grace_1", "carried_grace")), ("charges", ("grace",))):
        for name in names:
            op.add_column(table, sa.Column(name, sa.BigInteger(), nullable=False, server_default=sa.text("0")))
    op.add_column("matches", sa.Column("foreseeable", sa.Boolean(), nullable=False, server_default=sa.false()))
    matches = sa.table("matches", sa.column("foreseeable", sa.Boolean()), sa.column("challenger", sa.String()))
    op.execute(matches.update().where(matches.c.challenger.is_(None)).values(foreseeable=sa.true()))
