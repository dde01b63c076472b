"""Stored answers by their age: the old ones are found without reading the others."""

from alembic import op

revision = "0005"
down_revision = "0004"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Index them."""
    op.create_index(op.f("ix_answers_created_at"), "answers", ["created_at"])
