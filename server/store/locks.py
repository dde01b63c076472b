"""Who may go on with what, where several transactions write at once (PostgreSQL). On SQLite there is one writer: all of
this is free there.

Locks belong to transactions: they are given back at its end, and by the death of the process that held them. Nobody
waits in a circle: a transaction locks one match at most, and a name under which it also locks a match is always
locked before it or always after it.
"""

from sqlalchemy import Connection, func, select

from server.store.tables import games, matches


def only_one(connection: Connection, name: str) -> None:
    """Wait until nobody else is at work under this name, and keep them out until the transaction ends."""
    if is_shared(connection):
        connection.execute(select(func.pg_advisory_xact_lock(func.hashtextextended(name, 0))))


def hold_match(connection: Connection, match_id: str) -> None:
    """Wait until nobody else writes this match or its games, and keep them out until the transaction ends."""
    if is_shared(connection):
        connection.execute(select(matches.c.id).where(matches.c.id == match_id).with_for_update(key_share=True))


def hold_match_of(connection: Connection, game_id: str) -> None:
    """The same for the match of a game."""
    if is_shared(connection):
        owner = select(games.c.match_id).where(games.c.id == game_id).scalar_subquery()
        connection.execute(select(matches.c.id).where(matches.c.id == owner).with_for_update(key_share=True))


def lease_match_of(connection: Connection, game_id: str) -> bool:
    """The same without waiting: False when somebody else is at work on it (FOR NO KEY UPDATE SKIP LOCKED)."""
    if not is_shared(connection):
        return True
    owner = select(games.c.match_id).where(games.c.id == game_id).scalar_subquery()
    this = select(matches.c.id).where(matches.c.id == owner).with_for_update(key_share=True, skip_locked=True)
    return connection.execute(this).first() is not None


def is_shared(connection: Connection) -> bool:
    """Whether other transactions may write at the same time."""
    return connection.dialect.name == "postgresql"
