"""The lines of records, compressed: the numbers of a stroke's events are most of what is stored.

Rows that are there keep their lines as they are.
"""

import sqlalchemy as sa
from alembic import op

revision = "0007"
down_revision = "0006"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the column; no row is written for it."""
    op.add_column("moves", sa.Column("packed", sa.LargeBinary()))
