"""Statements that go to SQLite's driver itself (`server.store.prepared`) come to what the library makes of them."""

import sqlite3

import pytest
from sqlalchemy import bindparam, insert, select, update
from sqlalchemy.exc import IntegrityError

from server.errors import Unavailable
from server.store import prepared
from server.store.database import Database
from server.store.prepared import MOST_IDS, Prepared, PreparedForIds
from server.store.tables import agents, answers
from server.store.upgrade import upgrade

AGENT = {"id": "agent_1", "name": "ann", "skeleton": "ann", "house": True, "created_at": 2**62}
ANSWER = {
    "caller": "agent_1",
    "route": "/r",
    "key": "k",
    "request_digest": "0" * 64,
    "status": 200,
    "headers": {"etag": '"1"', "é": [None, 1.5]},
    "body": b"\x00\xff",
    "created_at": 1,
}


@pytest.fixture
def database(tmp_path):
    made = Database(f"sqlite:///{tmp_path / 'prepared.db'}")
    upgrade(made)
    yield made
    made.dispose()


@pytest.mark.parametrize("is_direct", [True, False])
@pytest.mark.parametrize(
    ("table", "row"), [(agents, AGENT), (answers, ANSWER)], ids=lambda each: getattr(each, "name", "")
)
def test_what_is_written_is_read_again_by_either_way(database, table, row, is_direct, monkeypatch):
    monkeypatch.setattr(prepared, "is_direct", lambda _: is_direct)
    with database.writing() as connection:
        assert Prepared(insert(table)).run(connection, row) == 1
    statement = Prepared(select(table).where(table.c.created_at == bindparam("at")))
    for reads_directly in (True, False):
        monkeypatch.setattr(prepared, "is_direct", lambda _, direct=reads_directly: direct)
        with database.reading() as connection:
            found = statement.first(connection, at=row["created_at"])
            assert found._asdict() == row
            assert [type(value) for value in found] == [type(value) for value in row.values()]
            assert [each._asdict() for each in statement.all(connection, at=row["created_at"])] == [row]
            assert statement.first(connection, at=0) is None
            assert statement.all(connection, at=0) == []


@pytest.mark.parametrize("is_direct", [True, False])
@pytest.mark.parametrize("count", [0, 1, 2, 3, 64, 65, MOST_IDS, MOST_IDS + 1, 3 * MOST_IDS - 1])
def test_rows_are_found_by_however_many_ids_each_once(database, count, is_direct, monkeypatch):
    """Made up to a power of two, and in more than one statement: none is missed, none comes twice or unasked."""
    monkeypatch.setattr(prepared, "is_direct", lambda _: is_direct)
    names = [f"agent_{number}" for number in range(count)]
    with database.writing() as connection:
        for name in [*names, "nobody's"]:
            Prepared(insert(agents)).run(connection, AGENT | {"id": name, "name": name, "skeleton": name})
    found = PreparedForIds(select(agents.c.id), agents.c.id)
    with database.reading() as connection:
        assert sorted(row.id for row in found.all(connection, {*names, "unknown"})) == sorted(names)
        assert found.all(connection, []) == []


def test_rows_that_are_changed_are_counted(database):
    renamed = Prepared(update(agents).where(agents.c.name == bindparam("seen")))
    with database.writing() as connection:
        Prepared(insert(agents)).run(connection, AGENT)
        assert renamed.run(connection, {"seen": "bob", "name": "eve"}) == 0
        assert renamed.run(connection, {"seen": "ann", "name": "eve"}) == 1


def test_a_value_in_the_statement_itself_is_sent(database):
    """The library writes the 1 of a LIMIT as a parameter of its own."""
    with database.writing() as connection:
        for number in range(2):
            Prepared(insert(agents)).run(connection, AGENT | {"id": f"agent_{number}", "name": f"{number}"})
        first = Prepared(select(agents.c.id).where(agents.c.house.is_(True)).order_by(agents.c.id).limit(1))
        assert [row.id for row in first.all(connection)] == ["agent_0"]


@pytest.mark.parametrize("headers", [None, {}, {"a": 1.5}, [], "null", 0])
def test_the_database_gets_the_same_bytes_by_either_way(database, tmp_path, headers, monkeypatch):
    """None in a column of JSON is its null, and no value of the database's."""
    for is_direct in (True, False):
        monkeypatch.setattr(prepared, "is_direct", lambda _, direct=is_direct: direct)
        with database.writing() as connection:
            Prepared(insert(answers)).run(connection, ANSWER | {"key": str(is_direct), "headers": headers})
    with sqlite3.connect(tmp_path / "prepared.db") as seen:
        kinds = ", ".join(f'typeof("{name}"), "{name}"' for name in ANSWER if name != "key")
        direct, through_the_library = seen.execute(f"SELECT {kinds} FROM answers")
    assert direct == through_the_library


def test_what_the_transaction_wrote_is_rolled_back_with_it(database):
    def fail(connection):
        Prepared(insert(agents)).run(connection, AGENT)
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError), database.writing() as connection:
        fail(connection)
    with database.reading() as connection:
        assert Prepared(select(agents)).all(connection) == []


def test_a_look_is_one_moment(database):
    """A snapshot: nothing that is committed after its first statement is seen."""
    every = Prepared(select(agents.c.id))
    with database.reading() as connection:
        assert every.all(connection) == []
        with database.writing() as other:
            Prepared(insert(agents)).run(other, AGENT)
        assert every.all(connection) == []
    with database.reading() as connection:
        assert len(every.all(connection)) == 1


def test_a_fault_of_the_driver_is_no_outage_and_an_outage_is_told(database, tmp_path):
    def twice(connection):
        for _ in range(2):
            Prepared(insert(agents)).run(connection, AGENT)

    with pytest.raises(IntegrityError), database.writing() as connection:
        twice(connection)
    assert not database.writes_fail.is_set()
    impatient = Database(database.url, wait=0.05)
    with sqlite3.connect(tmp_path / "prepared.db", isolation_level=None) as other:
        other.execute("BEGIN IMMEDIATE")
        with pytest.raises(Unavailable):
            impatient.carry_out(lambda connection: Prepared(insert(agents)).run(connection, AGENT))
        assert impatient.writes_fail.is_set()
        other.execute("ROLLBACK")
    with impatient.writing() as connection:
        assert Prepared(insert(agents)).run(connection, AGENT) == 1
    impatient.dispose()
