"""Lists in the order they are shown: a page is read from an index, however many rows there are."""

from typing import Final

from alembic import op

revision = "0006"
down_revision = "0005"
branch_labels = None
depends_on = None

ORDER: Final = ("created_at", "id")
NEW: Final = {
    "ix_agents_listed": ("agents", ORDER),
    "ix_agents_listed_house": ("agents", ("house", *ORDER)),
    "ix_tokens_listed": ("tokens", ("agent_id", *ORDER)),
    "ix_matches_listed": ("matches", ORDER),
    "ix_matches_listed_status": ("matches", ("status", *ORDER)),
    "ix_matches_listed_seat_0": ("matches", ("seat_0", *ORDER)),
    "ix_matches_listed_seat_1": ("matches", ("seat_1", *ORDER)),
    "ix_matches_listed_seat_0_status": ("matches", ("seat_0", "status", *ORDER)),
    "ix_matches_listed_seat_1_status": ("matches", ("seat_1", "status", *ORDER)),
    "ix_games_ended": ("games", ("status", "ended_at", "id")),
    "ix_tournaments_listed": ("tournaments", ORDER),
    "ix_tournaments_listed_status": ("tournaments", ("status", *ORDER)),
    "ix_tournament_entries_noted": ("tournament_entries", ("tournament_id", "sequence")),
}
CONTAINED: Final = {
    "ix_tokens_agent_id": "tokens",
    "ix_matches_seat_0": "matches",
    "ix_matches_seat_1": "matches",
    "ix_matches_status": "matches",
    "ix_tournaments_status": "tournaments",
    "ix_tournament_entries_tournament_id": "tournament_entries",
}
"""Indices that a new one begins with."""


def upgrade() -> None:
    """Make the indices, and drop those that they contain."""
    for name, (table, columns) in NEW.items():
        op.create_index(op.f(name), table, list(columns))
    for name, table in CONTAINED.items():
        op.drop_index(op.f(name), table_name=table)
