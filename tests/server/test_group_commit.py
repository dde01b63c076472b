"""Transactions that share a commit (`group_commit`): one flush, and nobody is better or worse off than alone."""

import sqlite3
import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from contextvars import ContextVar

import pytest
from sqlalchemy import bindparam, event, insert, select
from sqlalchemy.exc import IntegrityError

from server.errors import NotFound, Unavailable
from server.store import outages
from server.store.database import Database
from server.store.outages import Overtaken
from server.store.prepared import Prepared
from server.store.tables import agents
from server.store.upgrade import upgrade

WITHIN = 120.0
_ENTER = Prepared(insert(agents))
_FIND = Prepared(select(agents.c.id).where(agents.c.id == bindparam("id")))


class Shared:
    """A database with group commit, and how often it was flushed."""

    def __init__(self, path):
        self.database = Database(f"sqlite:///{path}", wait=0.2, group_commit=True)
        upgrade(self.database)
        self.commits = 0
        event.listen(self.database._engine, "commit", self._note)
        self.pool = ThreadPoolExecutor(40)

    def _note(self, _connection):
        self.commits += 1

    def close(self):
        self.pool.shutdown()
        self.database.dispose()

    @contextmanager
    def behind_another(self, waiting):
        """Somebody else has the writer's place until so many wait: one that leads, and those who follow it."""
        group = self.database._group
        with self.database._place:
            yield
            for _ in range(round(WITHIN / 0.01)):
                if len(group._waiting) == waiting:
                    return
                threading.Event().wait(0.01)
            raise AssertionError

    def carried_out(self, works):
        """What came of works that waited together: a value or an exception each."""
        with self.behind_another(len(works)):
            futures = [self.pool.submit(self.database.carry_out, work) for work in works]
        return [future.exception(WITHIN) or future.result() for future in futures]

    def stored(self):
        with self.database.reading() as connection:
            return {row.id for row in Prepared(select(agents.c.id)).all(connection)}


@pytest.fixture
def shared(tmp_path):
    made = Shared(tmp_path / "group.db")
    yield made
    made.close()


def enter(name, then=lambda connection: None):
    """Write a row, then do something; the name."""

    def work(connection):
        row = {"id": name, "name": name, "skeleton": name, "house": False, "created_at": 0}
        assert _ENTER.run(connection, row) == 1
        then(connection)
        return name

    return work


def raising(error):
    def then(_connection):
        raise error

    return then


def test_those_who_wait_together_share_one_commit(shared):
    names = [f"agent {number}" for number in range(30)]
    assert shared.carried_out([enter(name) for name in names]) == names
    assert shared.stored() == set(names)
    assert shared.commits == 1


def test_whoever_is_alone_waits_for_nobody(shared):
    assert shared.database.carry_out(enter("alone")) == "alone"
    assert shared.stored() == {"alone"}


@pytest.mark.parametrize("refusal", [NotFound("no"), Overtaken()], ids=["refusal", "overtaken"])
def test_a_refusal_takes_back_its_own_writes_alone(shared, refusal):
    works = [enter("first"), enter("refused", raising(refusal)), enter("last")]
    first, refused, last = shared.carried_out(works)
    assert (first, last) == ("first", "last")
    assert refused is refusal
    assert shared.stored() == {"first", "last"}
    assert shared.commits == 1


@pytest.mark.parametrize("place", [0, 1, 2])
def test_a_row_that_fails_is_carried_out_by_itself_and_hurts_nobody(shared, place):
    shared.database.carry_out(enter("taken"))
    works = [enter("one"), enter("two")]
    works.insert(place, enter("taken"))
    came = shared.carried_out(works)
    assert isinstance(came.pop(place), IntegrityError)
    assert came == ["one", "two"]
    assert shared.stored() == {"taken", "one", "two"}


def test_a_commit_that_fails_is_made_again_for_each_by_itself(shared):
    failures = [ZeroDivisionError("the disk's own way to fail")]

    def fail_once(_connection):
        if failures:
            raise failures.pop()

    event.listen(shared.database._engine, "commit", fail_once)
    names = ["one", "two", "three"]
    assert shared.carried_out([enter(name) for name in names]) == names
    assert shared.stored() == set(names)
    assert not failures


def test_while_the_database_does_not_answer_everybody_is_told_so_once(shared, tmp_path):
    names = [f"agent {number}" for number in range(8)]
    with sqlite3.connect(tmp_path / "group.db", isolation_level=None) as other:
        other.execute("BEGIN IMMEDIATE")
        came = shared.carried_out([enter(name) for name in names])
        other.execute("ROLLBACK")
    assert {type(each) for each in came} == {Unavailable}
    assert len({id(each) for each in came}) == len(names)  # each has a traceback of its own
    assert shared.stored() == set()
    assert shared.database.carry_out(enter("after")) == "after"


def test_whoever_waits_too_long_for_the_writers_place_is_told(shared, monkeypatch):
    monkeypatch.setattr(outages, "QUEUE_SECONDS", 0.05)
    with shared.database._place, pytest.raises(Unavailable):
        shared.database.carry_out(enter("waits"))
    assert shared.database.carry_out(enter("after")) == "after"
    assert shared.stored() == {"after"}


def test_nobody_is_answered_before_the_commit(shared):
    """A client with an answer finds what it wrote through any other connection, before the others are answered."""

    def asked(name):
        assert shared.database.carry_out(enter(name)) == name
        with shared.database.reading() as connection:
            return _FIND.first(connection, id=name) is not None

    assert all(shared.pool.map(asked, [f"agent {number}" for number in range(200)], timeout=WITHIN))
    assert len(shared.stored()) == 200


def test_others_who_write_are_waited_for_and_nobody_is_forgotten(shared):
    """Groups, ordinary transactions and refusals at once: all that was answered is there, and nothing else."""
    barrier = threading.Barrier(40)

    def one(number):
        barrier.wait(WITHIN)
        name = f"agent {number}"
        if number % 4 == 0:
            with shared.database.writing() as connection:
                return enter(name)(connection)
        if number % 4 == 1:
            with pytest.raises(Overtaken):
                shared.database.carry_out(enter(name, raising(Overtaken())))
            return None
        return shared.database.carry_out(enter(name))

    told = set(shared.pool.map(one, range(40), timeout=WITHIN)) - {None}
    assert shared.stored() == told
    assert len(told) == 30


def test_each_is_carried_out_in_its_own_context(shared):
    """A line of the log names its own request, although another thread wrote for it."""
    request: ContextVar[str] = ContextVar("request")

    def asked(name):
        request.set(name)
        return shared.database.carry_out(lambda _: request.get())

    names = [f"request {number}" for number in range(10)]
    with shared.behind_another(len(names)):
        futures = [shared.pool.submit(asked, name) for name in names]
    assert [future.result(WITHIN) for future in futures] == names


def test_without_the_setting_everybody_has_a_transaction_of_their_own(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'plain.db'}")
    assert database._group is None
    database.dispose()
