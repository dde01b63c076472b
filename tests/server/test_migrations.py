"""A database of version 0.1.0 (revision 0001) is brought to this version's tables; its rows are kept."""

from alembic import command
from sqlalchemy import MetaData, insert, select

from server.store.database import Database
from server.store.tables import matches
from server.store.upgrade import _config, is_current, upgrade

MATCH = {
    "seat_0": "ann",
    "seat_1": "bob",
    "status": "running",
    "games": 1,
    "rules": "eight_ball",
    "table": {},
    "noise_level": 1.0,
    "noise_told": True,
    "allowance": 1,
    "lag_turn": 0,
    "lag_game": 0,
    "seed": "5" * 64,
    "rated": True,
    "paired_racks": False,
    "engine": "e",
    "commitment": "c",
    "opening": 0,
    "created_at": 1,
}
AGENT = {"house": False, "created_at": 1}


def test_matches_of_the_first_version_are_foreseeable_where_a_seed_may_have_been_given(new_database):
    """Its tables do not say whether an organiser gave one; whoever challenges cannot."""
    database = Database(new_database())
    with database.writing() as connection:
        config = _config()
        config.attributes["connection"] = connection
        command.upgrade(config, "0001")
        first = MetaData()
        first.reflect(connection)
        connection.execute(insert(first.tables["agents"]), [AGENT | {"id": one, "name": one} for one in ("ann", "bob")])
        rows = [MATCH | {"id": "organised", "challenger": None}, MATCH | {"id": "challenged", "challenger": "ann"}]
        connection.execute(insert(first.tables["matches"]), rows)
    assert not is_current(database)
    for _ in range(2):
        upgrade(database)
        assert is_current(database)
    with database.reading() as connection:
        found = {row.id: (row.foreseeable, row.rated) for row in connection.execute(select(matches))}
    assert found == {"organised": (True, True), "challenged": (False, True)}
    database.dispose()
