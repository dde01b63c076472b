"""The tables, as SQLAlchemy Core sees them. The migrations create them; a test compares the two.

Times are nanoseconds, points in time since 1970 (`TimeSource`). What goes back to clients word for word
(answers, noisy shots, events) is stored as the JSON text it was; secrets (seeds) leave the database only when
their game is over.
"""

from sqlalchemy import (
    JSON,
    BigInteger,
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    LargeBinary,
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
)

metadata = MetaData(
    naming_convention={
        "ix": "ix_%(column_0_N_label)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s_%(referred_table_name)s",
        "pk": "pk_%(table_name)s",
    }
)

Identifier = String(64)
Sequence = BigInteger().with_variant(Integer, "sqlite")
"""A number that grows with every row; SQLite counts by itself only in a plain INTEGER."""

agents = Table(
    "agents",
    metadata,
    Column("id", Identifier, primary_key=True),
    Column("name", String(64), nullable=False, unique=True),
    Column("skeleton", String(128), nullable=False, server_default="", index=True),
    Column("house", Boolean, nullable=False),
    Column("created_at", BigInteger, nullable=False),
    Index("ix_agents_listed", "created_at", "id"),
    Index("ix_agents_listed_house", "house", "created_at", "id"),
)
"""`skeleton`: what names that look alike have in common (`server.security.names`); agents of version 0.1.0 may share
one. `house`: the server runs it itself."""

house = Table(
    "house",
    metadata,
    Column("agent_id", Identifier, ForeignKey("agents.id"), primary_key=True),
    Column("holder", Identifier, nullable=False),
    Column("until", BigInteger, nullable=False),
)
"""Which server process runs which house bot, and until when it may be believed to."""

tokens = Table(
    "tokens",
    metadata,
    Column("id", Identifier, primary_key=True),
    Column("digest", String(64), nullable=False, unique=True),
    Column("agent_id", Identifier, ForeignKey("agents.id")),
    Column("name", String(64)),
    Column("scopes", String(64), nullable=False),
    Column("created_at", BigInteger, nullable=False),
    Column("expires_at", BigInteger),
    Column("revoked_at", BigInteger),
    Index("ix_tokens_listed", "agent_id", "created_at", "id"),
)
"""`digest`: SHA-256 (hex) of the token. `agent_id`: whose it is, null for those who do not play."""

invitations = Table(
    "invitations",
    metadata,
    Column("digest", String(64), primary_key=True),
    Column("created_at", BigInteger, nullable=False),
    Column("expires_at", BigInteger),
    Column("used_at", BigInteger),
    Column("agent_id", Identifier),
)
"""Codes to register with, each for one agent."""

matches = Table(
    "matches",
    metadata,
    Column("id", Identifier, primary_key=True),
    Column("seat_0", Identifier, ForeignKey("agents.id"), nullable=False),
    Column("seat_1", Identifier, ForeignKey("agents.id"), nullable=False),
    Column("challenger", Identifier, ForeignKey("agents.id")),
    Column("status", String(16), nullable=False),
    Column("games", Integer, nullable=False),
    Column("rules", String(32), nullable=False),
    Column("table", JSON, nullable=False),
    Column("noise_level", Double, nullable=False),
    Column("noise_told", Boolean, nullable=False),
    Column("noise_sigmas", JSON(none_as_null=True)),
    Column("allowance", BigInteger, nullable=False),
    Column("simulations", BigInteger),
    Column("lag_turn", BigInteger, nullable=False),
    Column("lag_game", BigInteger, nullable=False),
    Column("seed", String(64), nullable=False),
    Column("start", JSON(none_as_null=True)),
    Column("rated", Boolean, nullable=False),
    Column("foreseeable", Boolean, nullable=False),
    Column("rack_seed", String(64)),
    Column("paired_racks", Boolean, nullable=False),
    Column("given_breaker", Integer),
    Column("engine", String(64), nullable=False),
    Column("engine_version", String(64), nullable=False),
    Column("commitment", String(64), nullable=False),
    Column("client_seed_0", String(64)),
    Column("client_seed_1", String(64)),
    Column("opening", BigInteger, nullable=False),
    Column("opens_until", BigInteger, index=True),
    Column("first_breaker", Integer),
    Column("created_at", BigInteger, nullable=False),
    Column("started_at", BigInteger),
    Column("ended_at", BigInteger),
    Index("ix_matches_listed", "created_at", "id"),
    Index("ix_matches_listed_status", "status", "created_at", "id"),
    Index("ix_matches_listed_seat_0", "seat_0", "created_at", "id"),
    Index("ix_matches_listed_seat_1", "seat_1", "created_at", "id"),
    Index("ix_matches_listed_seat_0_status", "seat_0", "status", "created_at", "id"),
    Index("ix_matches_listed_seat_1_status", "seat_1", "status", "created_at", "id"),
)
"""`seed`, `rack_seed` (null: the same): the secrets; `foreseeable`: `seed` was not drawn here, or follows from one that
was not. `engine`, `engine_version`: digest and version of the engine that the match is committed to.
`opening`: how long the players may add seeds; `opens_until`: when the first game begins at the latest, null
unless the match waits for that. `first_breaker`: known when the first game begins."""

games = Table(
    "games",
    metadata,
    Column("id", Identifier, primary_key=True),
    Column("match_id", Identifier, ForeignKey("matches.id"), nullable=False),
    Column("number", Integer, nullable=False),
    Column("noise_secret", String(64), nullable=False),
    Column("rack_secret", String(64), nullable=False),
    Column("noise_seed", String(64), nullable=False),
    Column("commitment", String(64), nullable=False),
    Column("breaker", Integer, nullable=False),
    Column("state", JSON, nullable=False),
    Column("version", Integer, nullable=False),
    Column("status", String(16), nullable=False),
    Column("winner", Integer),
    Column("mover", Identifier, ForeignKey("agents.id"), index=True),
    Column("used_0", BigInteger, nullable=False),
    Column("used_1", BigInteger, nullable=False),
    Column("lag_0", BigInteger, nullable=False),
    Column("lag_1", BigInteger, nullable=False),
    Column("grace_0", BigInteger, nullable=False),
    Column("grace_1", BigInteger, nullable=False),
    Column("simulated_0", BigInteger, nullable=False),
    Column("simulated_1", BigInteger, nullable=False),
    Column("present_0", Boolean, nullable=False),
    Column("present_1", Boolean, nullable=False),
    Column("carried", BigInteger, nullable=False),
    Column("carried_grace", BigInteger, nullable=False),
    Column("delivered", Boolean, nullable=False),
    Column("available_at", BigInteger, nullable=False),
    Column("clock_from", BigInteger, nullable=False),
    Column("deadline", BigInteger, index=True),
    Column("started_at", BigInteger, nullable=False),
    Column("ended_at", BigInteger),
    Column("header", Text, nullable=False),
    Column("ending", Text),
    Column("seal", Text),
    Column("head", String(64), nullable=False),
    UniqueConstraint("match_id", "number"),
    Index("ix_games_ended", "status", "ended_at", "id"),
)
"""`mover`: whose turn it is, null when the game is over. `available_at`: since when it could be fetched; `clock_from`:
since when it is charged, which is later by the grace or until it was fetched; `deadline`: when the turn is over
unplayed, null when the game is over. `used`: charged for turns that are over, `lag` and `grace`: given back for them,
by seat. `carried`: what the running turn was charged before the server stopped, `carried_grace`: given back then.
`simulated`: shots simulated or declared, by seat. `present`: whether the player ever fetched a turn of this game or
played one. `header`, `ending` and `seal`: the first line and the last two of the record; `head`: the digest of its
last line so far."""

charges = Table(
    "charges",
    metadata,
    Column("sequence", Sequence, primary_key=True, autoincrement=True),
    Column("game_id", Identifier, ForeignKey("games.id"), nullable=False, index=True),
    Column("seat", Integer, nullable=False),
    Column("move", Integer),
    Column("measured", BigInteger, nullable=False),
    Column("lag", BigInteger, nullable=False),
    Column("grace", BigInteger, nullable=False),
    Column("created_at", BigInteger, nullable=False),
)
"""The ledger of a game's clocks: a row for every turn that is over, `move` null where no move ended it. `measured` less
`lag` and `grace` was charged."""

heartbeats = Table(
    "heartbeats",
    metadata,
    Column("process", Identifier, primary_key=True),
    Column("beat_at", BigInteger, nullable=False),
    Column("clear_until", BigInteger, nullable=False),
    Column("stopped", Boolean, nullable=False),
    Column("present", JSON, nullable=False),
)
"""When each server process was last alive; `stopped`: it left in good order; `present`: the agents that poll it.
`clear_until`: every request that was complete at the process before then is done."""

moves = Table(
    "moves",
    metadata,
    Column("sequence", Sequence, primary_key=True, autoincrement=True),
    Column("game_id", Identifier, ForeignKey("games.id"), nullable=False),
    Column("number", Integer, nullable=False),
    Column("seat", Integer, nullable=False),
    Column("stroke", JSON, nullable=False),
    Column("line", Text, nullable=False),
    Column("packed", LargeBinary),
    Column("created_at", BigInteger, nullable=False),
    UniqueConstraint("game_id", "number"),
)
"""Every stroke and decision of a game, by number from 0. `packed`: the record's line, compressed; `line`: the same
in rows of earlier versions, else empty; `stroke`: a `StrokeDetail` without its events, null where it is read from the
line (`server.services.play.stored_strokes`)."""

answers = Table(
    "answers",
    metadata,
    Column("caller", Identifier, primary_key=True),
    Column("route", String(200), primary_key=True),
    Column("key", String(200), primary_key=True),
    Column("request_digest", String(64), nullable=False),
    Column("status", Integer, nullable=False),
    Column("headers", JSON, nullable=False),
    Column("body", LargeBinary, nullable=False),
    Column("created_at", BigInteger, nullable=False, index=True),
)
"""The idempotency rows: what was answered to an accepted request, stored in the transaction that did it."""

signing_keys = Table(
    "signing_keys",
    metadata,
    Column("id", String(32), primary_key=True),
    Column("private_key", LargeBinary, nullable=False),
    Column("public_key", String(64), nullable=False),
    Column("valid_from", BigInteger, nullable=False),
    Column("valid_until", BigInteger),
)
"""What records are sealed with. The one without an end is in use; those that were stay, for old records."""

notices = Table(
    "notices",
    metadata,
    Column("sequence", Sequence, primary_key=True, autoincrement=True),
    Column("agent_id", Identifier, ForeignKey("agents.id"), nullable=False),
    Column("message", Text, nullable=False),
    Column("delivered_at", BigInteger),
    Index("ix_notices_agent_delivered", "agent_id", "delivered_at"),
)
"""Messages that are news rather than a question: `game_over` and `match_over`, one row for each player."""

tournaments = Table(
    "tournaments",
    metadata,
    Column("id", Identifier, primary_key=True),
    Column("name", String(64), nullable=False),
    Column("status", String(16), nullable=False),
    Column("terms", JSON, nullable=False),
    Column("agents", JSON, nullable=False),
    Column("games", Integer, nullable=False),
    Column("due", Integer, nullable=False),
    Column("created_at", BigInteger, nullable=False),
    Column("started_at", BigInteger),
    Column("ended_at", BigInteger),
    Index("ix_tournaments_listed", "created_at", "id"),
    Index("ix_tournaments_listed_status", "status", "created_at", "id"),
)
"""`terms`: the whole `tournament.Spec`, its secret seed among them; `agents`: entrant's name to agent id.
`games`: counted so far; `due`: certain and not finished. Both follow from the entries, and are here for lists."""

tournament_entries = Table(
    "tournament_entries",
    metadata,
    Column("sequence", Sequence, primary_key=True, autoincrement=True),
    Column("tournament_id", Identifier, ForeignKey("tournaments.id"), nullable=False),
    Column("kind", String(32), nullable=False),
    Column("by", Identifier, nullable=False),
    Column("fields", JSON, nullable=False),
    Column("created_at", BigInteger, nullable=False),
    Index("ix_tournament_entries_noted", "tournament_id", "sequence"),
)
"""What happened in an event, in order: results and decisions. How it stands follows from its terms and these alone."""

tournament_games = Table(
    "tournament_games",
    metadata,
    Column("match_id", Identifier, ForeignKey("matches.id"), primary_key=True),
    Column("tournament_id", Identifier, ForeignKey("tournaments.id"), nullable=False),
    Column("pair", String(64), nullable=False),
    Column("leg", Integer, nullable=False),
    Column("attempt", Integer, nullable=False),
    UniqueConstraint("tournament_id", "pair", "leg", "attempt"),
)
"""Which match plays which game of an event."""
