"""After a fault of the server's own: whoever asks next is served."""

from sqlalchemy import insert, select

from server.store.database import Database
from server.store.tables import agents
from server.store.upgrade import upgrade


def register(database, name):
    with database.writing() as connection:
        connection.execute(insert(agents).values(id=name, name=name, house=False, created_at=0))


def test_a_result_half_read_when_a_fault_came_keeps_nobody_from_writing(tmp_path):
    """Its cursor lives as long as the traceback does, and SQLite's snapshot as long as the cursor: the connection went
    back to the pool with it, and whoever wrote through it next was told at once that the database is locked.
    """
    database, other = (Database(f"sqlite:///{tmp_path / 'faults.db'}") for _ in range(2))
    upgrade(database)
    for name in ("ann", "bob"):
        register(database, name)
    half_read = []
    for look in (database.writing, database.reading):
        try:
            with look() as connection:
                half_read.append(connection.execute(select(agents)))
                half_read[-1].fetchone()
                raise RuntimeError("a fault")
        except RuntimeError:
            register(other, f"cat {len(half_read)}")
            register(database, f"dan {len(half_read)}")
    for each in (database, other):
        each.dispose()
