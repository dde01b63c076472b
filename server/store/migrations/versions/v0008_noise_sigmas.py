"""Standard deviations of a match's noise, where they are not the Olympiad's."""

import sqlalchemy as sa
from alembic import op

revision = "0008"
down_revision = "0007"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add them."""
    op.add_column("matches", sa.Column("noise_sigmas", sa.JSON(), nullable=True))
