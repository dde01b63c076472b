"""The first tables: agents, tokens, matches, games, moves, answers, notices, signing keys, tournaments."""

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None


def upgrade() -> None:
    """Create them."""
    _create_callers()
    _create_play()
    _create_server()
    _create_events()


def _sequence() -> sa.Column[int]:
    """A number that grows with every row."""
    kind = sa.BigInteger().with_variant(sa.Integer(), "sqlite")
    return sa.Column("sequence", kind, autoincrement=True, nullable=False)


def _create_callers() -> None:
    """Who calls, with what right, and what was answered and told."""
    op.create_table(
        "agents",
        sa.Column("id", sa.String(length=64), nullable=False),
        sa.Column("name", sa.String(length=64), nullable=False),
        sa.Column("house", sa.Boolean(), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_agents")),
        sa.UniqueConstraint("name", name=op.f("uq_agents_name")),
    )
    op.create_table(
        "house",
        sa.Column("agent_id", sa.String(length=64), nullable=False),
        sa.Column("holder", sa.String(length=64), nullable=False),
        sa.Column("until", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["agent_id"], ["agents.id"], name=op.f("fk_house_agent_id_agents")),
        sa.PrimaryKeyConstraint("agent_id", name=op.f("pk_house")),
    )
    op.create_table(
        "answers",
        sa.Column("caller", sa.String(length=64), nullable=False),
        sa.Column("route", sa.String(length=200), nullable=False),
        sa.Column("key", sa.String(length=200), nullable=False),
        sa.Column("request_digest", sa.String(length=64), nullable=False),
        sa.Column("status", sa.Integer(), nullable=False),
        sa.Column("headers", sa.JSON(), nullable=False),
        sa.Column("body", sa.LargeBinary(), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.PrimaryKeyConstraint("caller", "route", "key", name=op.f("pk_answers")),
    )
    op.create_table(
        "notices",
        _sequence(),
        sa.Column("agent_id", sa.String(length=64), nullable=False),
        sa.Column("message", sa.Text(), nullable=False),
        sa.Column("delivered_at", sa.BigInteger(), nullable=True),
        sa.ForeignKeyConstraint(["agent_id"], ["agents.id"], name=op.f("fk_notices_agent_id_agents")),
        sa.PrimaryKeyConstraint("sequence", name=op.f("pk_notices")),
    )
    op.create_index("ix_notices_agent_delivered", "notices", ["agent_id", "delivered_at"], unique=False)
    op.create_table(
        "tokens",
        sa.Column("id", sa.String(length=64), nullable=False),
        sa.Column("digest", sa.String(length=64), nullable=False),
        sa.Column("agent_id", sa.String(length=64), nullable=True),
        sa.Column("name", sa.String(length=64), nullable=True),
        sa.Column("scopes", sa.String(length=64), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.Column("expires_at", sa.BigInteger(), nullable=True),
        sa.Column("revoked_at", sa.BigInteger(), nullable=True),
        sa.ForeignKeyConstraint(["agent_id"], ["agents.id"], name=op.f("fk_tokens_agent_id_agents")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_tokens")),
        sa.UniqueConstraint("digest", name=op.f("uq_tokens_digest")),
    )
    op.create_table(
        "invitations",
        sa.Column("digest", sa.String(length=64), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.Column("expires_at", sa.BigInteger(), nullable=True),
        sa.Column("used_at", sa.BigInteger(), nullable=True),
        sa.Column("agent_id", sa.String(length=64), nullable=True),
        sa.PrimaryKeyConstraint("digest", name=op.f("pk_invitations")),
    )
    op.create_index(op.f("ix_tokens_agent_id"), "tokens", ["agent_id"], unique=False)


def _create_play() -> None:
    """Matches, their games, every stroke, every charge of a clock."""
    op.create_table(
        "matches",
        sa.Column("id", sa.String(length=64), nullable=False),
        sa.Column("seat_0", sa.String(length=64), nullable=False),
        sa.Column("seat_1", sa.String(length=64), nullable=False),
        sa.Column("challenger", sa.String(length=64), nullable=True),
        sa.Column("status", sa.String(length=16), nullable=False),
        sa.Column("games", sa.Integer(), nullable=False),
        sa.Column("rules", sa.String(length=32), nullable=False),
        sa.Column("table", sa.JSON(), nullable=False),
        sa.Column("noise_level", sa.Double(), nullable=False),
        sa.Column("noise_told", sa.Boolean(), nullable=False),
        sa.Column("allowance", sa.BigInteger(), nullable=False),
        sa.Column("simulations", sa.BigInteger(), nullable=True),
        sa.Column("lag_turn", sa.BigInteger(), nullable=False),
        sa.Column("lag_game", sa.BigInteger(), nullable=False),
        sa.Column("seed", sa.String(length=64), nullable=False),
        sa.Column("start", sa.JSON(), nullable=True),
        sa.Column("rated", sa.Boolean(), nullable=False),
        sa.Column("rack_seed", sa.String(length=64), nullable=True),
        sa.Column("paired_racks", sa.Boolean(), nullable=False),
        sa.Column("given_breaker", sa.Integer(), nullable=True),
        sa.Column("engine", sa.String(length=64), nullable=False),
        sa.Column("commitment", sa.String(length=64), nullable=False),
        sa.Column("client_seed_0", sa.String(length=64), nullable=True),
        sa.Column("client_seed_1", sa.String(length=64), nullable=True),
        sa.Column("opening", sa.BigInteger(), nullable=False),
        sa.Column("opens_until", sa.BigInteger(), nullable=True),
        sa.Column("first_breaker", sa.Integer(), nullable=True),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.Column("started_at", sa.BigInteger(), nullable=True),
        sa.Column("ended_at", sa.BigInteger(), nullable=True),
        sa.ForeignKeyConstraint(["challenger"], ["agents.id"], name=op.f("fk_matches_challenger_agents")),
        sa.ForeignKeyConstraint(["seat_0"], ["agents.id"], name=op.f("fk_matches_seat_0_agents")),
        sa.ForeignKeyConstraint(["seat_1"], ["agents.id"], name=op.f("fk_matches_seat_1_agents")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_matches")),
    )
    op.create_index(op.f("ix_matches_opens_until"), "matches", ["opens_until"], unique=False)
    op.create_index(op.f("ix_matches_seat_0"), "matches", ["seat_0"], unique=False)
    op.create_index(op.f("ix_matches_seat_1"), "matches", ["seat_1"], unique=False)
    op.create_index(op.f("ix_matches_status"), "matches", ["status"], unique=False)
    op.create_table(
        "games",
        sa.Column("id", sa.String(length=64), nullable=False),
        sa.Column("match_id", sa.String(length=64), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("noise_secret", sa.String(length=64), nullable=False),
        sa.Column("rack_secret", sa.String(length=64), nullable=False),
        sa.Column("noise_seed", sa.String(length=64), nullable=False),
        sa.Column("commitment", sa.String(length=64), nullable=False),
        sa.Column("breaker", sa.Integer(), nullable=False),
        sa.Column("state", sa.JSON(), nullable=False),
        sa.Column("version", sa.Integer(), nullable=False),
        sa.Column("status", sa.String(length=16), nullable=False),
        sa.Column("winner", sa.Integer(), nullable=True),
        sa.Column("mover", sa.String(length=64), nullable=True),
        sa.Column("used_0", sa.BigInteger(), nullable=False),
        sa.Column("used_1", sa.BigInteger(), nullable=False),
        sa.Column("lag_0", sa.BigInteger(), nullable=False),
        sa.Column("lag_1", sa.BigInteger(), nullable=False),
        sa.Column("simulated_0", sa.BigInteger(), nullable=False),
        sa.Column("simulated_1", sa.BigInteger(), nullable=False),
        sa.Column("present_0", sa.Boolean(), nullable=False),
        sa.Column("present_1", sa.Boolean(), nullable=False),
        sa.Column("carried", sa.BigInteger(), nullable=False),
        sa.Column("delivered", sa.Boolean(), nullable=False),
        sa.Column("available_at", sa.BigInteger(), nullable=False),
        sa.Column("clock_from", sa.BigInteger(), nullable=False),
        sa.Column("deadline", sa.BigInteger(), nullable=True),
        sa.Column("started_at", sa.BigInteger(), nullable=False),
        sa.Column("ended_at", sa.BigInteger(), nullable=True),
        sa.Column("header", sa.Text(), nullable=False),
        sa.Column("ending", sa.Text(), nullable=True),
        sa.Column("seal", sa.Text(), nullable=True),
        sa.Column("head", sa.String(length=64), nullable=False),
        sa.ForeignKeyConstraint(["match_id"], ["matches.id"], name=op.f("fk_games_match_id_matches")),
        sa.ForeignKeyConstraint(["mover"], ["agents.id"], name=op.f("fk_games_mover_agents")),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_games")),
        sa.UniqueConstraint("match_id", "number", name=op.f("uq_games_match_id_number")),
    )
    op.create_index(op.f("ix_games_deadline"), "games", ["deadline"], unique=False)
    op.create_index(op.f("ix_games_mover"), "games", ["mover"], unique=False)
    op.create_table(
        "charges",
        _sequence(),
        sa.Column("game_id", sa.String(length=64), nullable=False),
        sa.Column("seat", sa.Integer(), nullable=False),
        sa.Column("move", sa.Integer(), nullable=True),
        sa.Column("measured", sa.BigInteger(), nullable=False),
        sa.Column("lag", sa.BigInteger(), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["game_id"], ["games.id"], name=op.f("fk_charges_game_id_games")),
        sa.PrimaryKeyConstraint("sequence", name=op.f("pk_charges")),
    )
    op.create_index(op.f("ix_charges_game_id"), "charges", ["game_id"], unique=False)
    op.create_table(
        "moves",
        _sequence(),
        sa.Column("game_id", sa.String(length=64), nullable=False),
        sa.Column("number", sa.Integer(), nullable=False),
        sa.Column("seat", sa.Integer(), nullable=False),
        sa.Column("stroke", sa.JSON(), nullable=False),
        sa.Column("line", sa.Text(), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(["game_id"], ["games.id"], name=op.f("fk_moves_game_id_games")),
        sa.PrimaryKeyConstraint("sequence", name=op.f("pk_moves")),
        sa.UniqueConstraint("game_id", "number", name=op.f("uq_moves_game_id_number")),
    )


def _create_server() -> None:
    """What the server processes themselves keep."""
    op.create_table(
        "signing_keys",
        sa.Column("id", sa.String(length=32), nullable=False),
        sa.Column("private_key", sa.LargeBinary(), nullable=False),
        sa.Column("public_key", sa.String(length=64), nullable=False),
        sa.Column("valid_from", sa.BigInteger(), nullable=False),
        sa.Column("valid_until", sa.BigInteger(), nullable=True),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_signing_keys")),
    )
    op.create_table(
        "heartbeats",
        sa.Column("process", sa.String(length=64), nullable=False),
        sa.Column("beat_at", sa.BigInteger(), nullable=False),
        sa.Column("clear_until", sa.BigInteger(), nullable=False),
        sa.Column("stopped", sa.Boolean(), nullable=False),
        sa.Column("present", sa.JSON(), nullable=False),
        sa.PrimaryKeyConstraint("process", name=op.f("pk_heartbeats")),
    )


def _create_events() -> None:
    """Tournaments, their entries and their games."""
    op.create_table(
        "tournaments",
        sa.Column("id", sa.String(length=64), nullable=False),
        sa.Column("name", sa.String(length=64), nullable=False),
        sa.Column("status", sa.String(length=16), nullable=False),
        sa.Column("terms", sa.JSON(), nullable=False),
        sa.Column("agents", sa.JSON(), nullable=False),
        sa.Column("games", sa.Integer(), nullable=False),
        sa.Column("due", sa.Integer(), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.Column("started_at", sa.BigInteger(), nullable=True),
        sa.Column("ended_at", sa.BigInteger(), nullable=True),
        sa.PrimaryKeyConstraint("id", name=op.f("pk_tournaments")),
    )
    op.create_index(op.f("ix_tournaments_status"), "tournaments", ["status"], unique=False)
    op.create_table(
        "tournament_entries",
        _sequence(),
        sa.Column("tournament_id", sa.String(length=64), nullable=False),
        sa.Column("kind", sa.String(length=32), nullable=False),
        sa.Column("by", sa.String(length=64), nullable=False),
        sa.Column("fields", sa.JSON(), nullable=False),
        sa.Column("created_at", sa.BigInteger(), nullable=False),
        sa.ForeignKeyConstraint(
            ["tournament_id"], ["tournaments.id"], name=op.f("fk_tournament_entries_tournament_id_tournaments")
        ),
        sa.PrimaryKeyConstraint("sequence", name=op.f("pk_tournament_entries")),
    )
    op.create_index(op.f("ix_tournament_entries_tournament_id"), "tournament_entries", ["tournament_id"], unique=False)
    op.create_table(
        "tournament_games",
        sa.Column("match_id", sa.String(length=64), nullable=False),
        sa.Column("tournament_id", sa.String(length=64), nullable=False),
        sa.Column("pair", sa.String(length=64), nullable=False),
        sa.Column("leg", sa.Integer(), nullable=False),
        sa.Column("attempt", sa.Integer(), nullable=False),
        sa.ForeignKeyConstraint(["match_id"], ["matches.id"], name=op.f("fk_tournament_games_match_id_matches")),
        sa.ForeignKeyConstraint(
            ["tournament_id"], ["tournaments.id"], name=op.f("fk_tournament_games_tournament_id_tournaments")
        ),
        sa.PrimaryKeyConstraint("match_id", name=op.f("pk_tournament_games")),
        sa.UniqueConstraint(
            "tournament_id", "pair", "leg", "attempt", name=op.f("uq_tournament_games_tournament_id_pair_leg_attempt")
        ),
    )


def downgrade() -> None:
    """Drop them."""
    op.drop_table("tournament_games")
    op.drop_index(op.f("ix_tournament_entries_tournament_id"), table_name="tournament_entries")
    op.drop_table("tournament_entries")
    op.drop_index(op.f("ix_tournaments_status"), table_name="tournaments")
    op.drop_table("tournaments")
    op.drop_table("moves")
    op.drop_table("heartbeats")
    op.drop_index(op.f("ix_charges_game_id"), table_name="charges")
    op.drop_table("charges")
    op.drop_index(op.f("ix_games_mover"), table_name="games")
    op.drop_index(op.f("ix_games_deadline"), table_name="games")
    op.drop_table("games")
    op.drop_index(op.f("ix_tokens_agent_id"), table_name="tokens")
    op.drop_table("tokens")
    op.drop_table("signing_keys")
    op.drop_table("invitations")
    op.drop_index("ix_notices_agent_delivered", table_name="notices")
    op.drop_table("notices")
    op.drop_index(op.f("ix_matches_status"), table_name="matches")
    op.drop_index(op.f("ix_matches_seat_1"), table_name="matches")
    op.drop_index(op.f("ix_matches_seat_0"), table_name="matches")
    op.drop_index(op.f("ix_matches_opens_until"), table_name="matches")
    op.drop_table("matches")
    op.drop_table("answers")
    op.drop_table("house")
    op.drop_table("agents")
