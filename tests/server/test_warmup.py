"""Kernels of tables with jaws: loaded when one asks; nothing begins on such a table before that."""

import threading

import pytest

import physics
from physics.self_test import SelfTest
from server.errors import Unavailable
from server.services.runtime import warmup
from server.services.runtime.warmup import Kernels, KernelsMissing

PASSED = SelfTest(ok=True, digest="0" * 64, events=1)


@pytest.fixture
def compiler(monkeypatch):
    """A compiler that takes until it is let go, and how often it was started."""
    done, runs = threading.Event(), []

    def compile_and_test(jaws):
        runs.append(jaws)
        assert done.wait(60)
        return PASSED

    monkeypatch.setattr(warmup, "self_test", compile_and_test)
    monkeypatch.setattr(warmup, "is_compiled", lambda jaws: done.is_set())
    yield done, runs
    done.set()


def test_a_table_with_straight_mouths_waits_for_nothing(compiler):
    _done, runs = compiler
    kernels = Kernels()
    kernels.require(physics.Table.olympiad())
    assert not kernels.are_loading
    assert runs == []


def test_the_first_table_with_jaws_has_its_kernels_compiled_once(compiler):
    """Minutes: a request does not wait for them, it is told to come again."""
    done, runs = compiler
    kernels = Kernels()
    for _ in range(3):
        with pytest.raises(KernelsMissing, match="takes minutes") as refused:
            kernels.require(physics.Table.nine_foot())
        assert refused.value.seconds == 15
    assert (refused.value.status, refused.value.code) == (503, "unavailable")
    assert kernels.are_loading
    done.set()
    assert kernels.awaited(lambda: kernels.require(physics.Table.nine_foot())) is None
    assert runs == [True]
    assert kernels.jaws.tested == PASSED


def test_a_request_waits_for_kernels_that_lie_in_the_cache(compiler, monkeypatch):
    done, _runs = compiler
    monkeypatch.setattr(warmup, "is_compiled", lambda jaws: True)
    kernels = Kernels()
    threading.Timer(0.3, done.set).start()
    kernels.awaited(lambda: kernels.require(physics.Table.nine_foot()))
    assert kernels.jaws.ready.is_set()


def test_kernels_that_do_not_work_are_told_of(monkeypatch, caplog):
    monkeypatch.setattr(warmup, "self_test", lambda jaws: SelfTest(ok=False, digest="0" * 64, events=1))
    monkeypatch.setattr(warmup, "is_compiled", lambda jaws: True)
    kernels = Kernels()
    with pytest.raises(Unavailable, match="the log says why"):
        kernels.awaited(lambda: kernels.require(physics.Table.seven_foot()))
    assert "two answers" in caplog.text


def test_a_server_loads_them_when_the_first_match_asks(own_server, table_at):
    server = own_server()
    table = table_at(server, table="nine_foot")
    assert len(table.play(1)) == 1
    loaded = [line for line in server.log.splitlines() if "kernels loaded" in line]
    assert ['"jaws": true' in line for line in loaded].count(True) == 1
