"""`python -m server`: the announcement, the settings, the schema, stopping."""

import json
import os
import socket
import sqlite3
import subprocess
import sys
import time

import pytest
from alembic.autogenerate import compare_metadata
from alembic.runtime.migration import MigrationContext

from server.errors import Draining, SettingsError
from server.routes.health import readiness
from server.serve import listening
from server.services.runtime import warmup
from server.services.runtime.context import Context
from server.settings import Settings
from server.store.database import Database
from server.store.tables import metadata
from server.store.upgrade import is_current, upgrade


def run(*arguments, **environment):
    command = [sys.executable, "-m", "server", *arguments]
    return subprocess.run(command, env=os.environ | environment, capture_output=True, text=True, timeout=60)


def test_the_first_line_announces_an_address_that_answers(server):
    assert server.url.startswith("http://127.0.0.1:")
    assert server.request("GET", "/healthz").json() == {"status": "ok"}


def test_ready_once_the_kernels_are_loaded(server):
    end = time.monotonic() + 120
    while (response := server.request("GET", "/readyz")).status_code == 503 and time.monotonic() < end:
        assert response.headers["retry-after"] == "1"
        time.sleep(0.2)
    assert response.json()["status"] == "ready"


def test_a_taken_port_is_an_error_in_words(tmp_path):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        done = run("--port", port, "--database", f"sqlite:///{tmp_path / 'x.db'}")
    assert done.returncode != 0
    assert f"port = {port}: must be free at 127.0.0.1" in done.stderr
    assert "--port 0 takes a free one" in done.stderr, "and what to do"
    assert len(done.stderr.splitlines()) == 1
    assert done.stdout == ""
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("host", ["203.0.113.1", "no.such.host.invalid"])
def test_a_host_that_is_not_ours_is_an_error_in_words(tmp_path, host):
    done = run("--host", host, "--port", "0", "--database", f"sqlite:///{tmp_path / 'x.db'}")
    assert done.returncode == 1
    assert f"host = {host}: must be an address of this machine" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize(
    ("environment", "named"),
    [
        ({"POOLIAD_DATABASE": "mysql://x"}, "mysql://x"),
        ({"POOLIAD_DATABASE": "sqlite://"}, "sqlite:///path"),
        ({"POOLIAD_DATABASE": "sqlite:///a.db?timeout=9"}, "sqlite:///path"),
        ({"POOLIAD_BODY_LIMIT": "1e6"}, "POOLIAD_BODY_LIMIT = '1e6': must be a whole number"),
        ({"POOLIAD_TIMER_PERIOD": "-1"}, "timer_period = -1.0"),
        ({"POOLIAD_BODY_SECONDS": "nan"}, "body_seconds = nan"),
        ({"POOLIAD_ORGANISER_TOKEN": "secret"}, "at least 32"),
    ],
)
def test_a_bad_setting_is_named_and_the_server_does_not_start(environment, named):
    done = run("--port", "0", **environment)
    assert done.returncode == 1
    assert named in done.stderr
    assert "Traceback" not in done.stderr
    assert "secret" not in done.stderr


def test_settings_come_from_the_environment():
    token = "t" * 40
    settings = Settings.from_environment(
        {
            "POOLIAD_DATABASE": "sqlite:////tmp/a.db",
            "POOLIAD_BODY_LIMIT": "1000",
            "POOLIAD_ORGANISER_TOKEN": token,
        }
    )
    assert (settings.database, settings.body_limit) == ("sqlite:////tmp/a.db", 1000)
    assert token not in repr(settings)


def test_settings_refuse_what_cannot_be():
    with pytest.raises(SettingsError, match="body_limit = 0: must be"):
        Settings(body_limit=0)


def test_the_migrations_make_exactly_the_tables(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'fresh.db'}")
    assert not is_current(database)
    upgrade(database)
    assert is_current(database)
    with database.reading() as connection:
        assert compare_metadata(MigrationContext.configure(connection), metadata) == []
    upgrade(database)
    database.dispose()


def test_the_database_is_in_wal_mode_and_flushed_at_every_commit(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'pragmas.db'}")
    with database.reading() as connection:
        values = {
            name: connection.exec_driver_sql(f"PRAGMA {name}").scalar()
            for name in ("journal_mode", "synchronous", "foreign_keys")
        }
    database.dispose()
    assert values == {"journal_mode": "wal", "synchronous": 2, "foreign_keys": 1}


def test_a_transaction_that_raises_leaves_nothing(tmp_path):
    database = Database(f"sqlite:///{tmp_path / 'atomic.db'}")
    upgrade(database)

    def fail():
        with database.writing() as connection:
            connection.exec_driver_sql("INSERT INTO agents (id, name, house, created_at) VALUES ('a', 'a', 0, 1)")
            raise RuntimeError("in the middle")

    with pytest.raises(RuntimeError, match="in the middle"):
        fail()
    with database.reading() as connection:
        assert connection.exec_driver_sql("SELECT count(*) FROM agents").scalar() == 0
    database.dispose()


def test_a_stopped_server_leaves_a_whole_database(own_server, table_at):
    server = own_server()
    table_at(server).play(1)
    assert server.stop() == 0
    with sqlite3.connect(server.database) as connection:
        assert connection.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        assert connection.execute("SELECT count(*) FROM moves").fetchone() == (1,)
    connection.close()


def test_the_organisers_token_is_nowhere_in_the_database(own_server, organiser):
    server = own_server()
    assert server.request("GET", "/v1/turns", organiser.token).status_code == 403
    server.stop()
    assert organiser.token.encode() not in server.database.read_bytes()
    assert json.dumps(organiser.token) not in server.log


@pytest.mark.parametrize("path", ["/healthz", "/readyz"])
def test_whoever_looks_after_the_server_may_ask_by_head(server, path):
    response = server.request("HEAD", path)
    assert response.status_code in (200, 503)
    assert response.content == b""


def test_kernels_that_cannot_be_loaded_are_logged_and_reported(tmp_path, monkeypatch, caplog):
    context = Context(Settings(), Database(f"sqlite:///{tmp_path / 'cold.db'}"))

    def fail(*_):
        raise OSError("no space for the kernels")

    monkeypatch.setattr(warmup, "self_test", fail)
    context.kernels.straight.start()
    assert context.kernels.straight.failed.wait(60)
    assert not context.kernels.straight.ready.is_set()
    assert "no space for the kernels" in caplog.text
    with pytest.raises(Draining, match="could not be loaded"):
        readiness(context)
    context.database.dispose()


def test_answers_do_not_wait_for_acknowledgements():
    """asyncio turns Nagle's algorithm off on sockets that say they are TCP.

    Seen on one that did not: 40 ms for every answer of two packets.
    """
    with listening("127.0.0.1", 0) as made:
        assert made.proto == socket.IPPROTO_TCP
