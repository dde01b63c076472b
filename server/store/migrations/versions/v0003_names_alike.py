"""What names look like: names that look alike are one name from now on. Those that are there stay."""

import sqlalchemy as sa
from alembic import op

from server.security.names import skeleton

revision = "0003"
down_revision = "0002"
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Add the column, filled for the agents that are there, two of whom may look alike: it is not unique."""
    column = sa.Column("skeleton", sa.String(length=128), nullable=False, server_default="")
    op.add_column("agents", column)
    agents = sa.table("agents", sa.column("id"), sa.column("name"), sa.column("skeleton"))
    connection = op.get_bind()
    rows = connection.execute(sa.select(agents.c.id, agents.c.name)).all()
    for agent_id, name in rows:
        connection.execute(sa.update(agents).where(agents.c.id == agent_id).values(skeleton=skeleton(name)))
    op.create_index(op.f("ix_agents_skeleton"), "agents", ["skeleton"], unique=False)


def downgrade() -> None:
    """Drop it."""
    op.drop_index(op.f("ix_agents_skeleton"), table_name="agents")
    op.drop_column("agents", "skeleton")
