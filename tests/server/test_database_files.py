"""The files of an SQLite database: private, served by one process, Pooliad's own (docs/operations.md, "Databases")."""

import json
import os
import signal
import sqlite3
import stat
import subprocess
import sys
from contextlib import closing

import pytest
from typer.testing import CliRunner

from client.cli import application
from server.errors import SettingsError
from server.store import files
from server.store.database import Database
from server.store.upgrade import head, upgrade

OPEN_UMASK = 0o022


def modes(database):
    """The mode of every file of the database that is there."""
    there = [database.with_name(database.name + suffix) for suffix in files.SUFFIXES]
    return {file.name: stat.S_IMODE(file.stat().st_mode) for file in there if file.exists()}


def start(*arguments):
    """A server that is expected to leave: what it said."""
    command = [sys.executable, "-m", "server", "--port", "0", *arguments]
    return subprocess.run(command, capture_output=True, text=True, timeout=120)


def doctor(*arguments):
    """`pooliad doctor`, in this process: its self-test compiles once."""
    return CliRunner().invoke(application(), ["doctor", *arguments])


def require_one_sentence(done, *words):
    assert done.returncode == 1
    assert done.stdout == ""
    assert "Traceback" not in done.stderr
    (line,) = done.stderr.splitlines()
    assert line.startswith("pooliad server: "), line
    for word in words:
        assert word in line, line


@pytest.fixture
def usual_umask():
    """The umask by which files are readable for everybody."""
    before = os.umask(OPEN_UMASK)
    yield
    os.umask(before)


def test_nobody_else_may_read_the_files(usual_umask, own_server, table_at):
    server = own_server()
    table_at(server).play(1)
    found = modes(server.database)
    assert {"pooliad.db", "pooliad.db-wal", "pooliad.db-shm"} <= set(found)
    assert set(found.values()) == {0o600}, found
    assert "others may read" not in server.log


def test_files_that_others_may_read_are_told_of_at_the_start(own_server):
    server = own_server()
    server.stop()
    server.database.chmod(0o644)
    server.start()
    (line,) = [json.loads(line) for line in server.log.splitlines() if "others may read" in line]
    assert line["level"] == "warning"
    for words in ("(0644)", "signing key", f"chmod 600 {server.database}"):
        assert words in line["message"]


@pytest.mark.slow
def test_doctor_and_backup_tell_of_them_too(own_server, tmp_path):
    server = own_server()
    server.stop(signal.SIGKILL)
    server.database.chmod(0o640)
    done = doctor("--json", "--database", server.database_url)
    assert done.exit_code == 1
    assert f"{server.database} (0640)" in json.loads(done.stdout)["database"]["open_to_others"]
    assert f"{server.database} (0640)" in done.stderr
    copy = tmp_path / "copy.db"
    backup = [sys.executable, "-m", "server.backup", "--database", server.database_url, str(copy)]
    done = subprocess.run(backup, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0
    assert "(0640)" in done.stderr
    assert modes(copy) == {"copy.db": 0o600}
    done = doctor("--json", "--database", f"sqlite:///{copy}")
    assert json.loads(done.stdout)["database"]["open_to_others"] == []


@pytest.mark.slow
def test_a_backup_follows_no_link_that_lay_there(own_server, tmp_path):
    """What a killed backup left, or somebody planted, under the unfinished copy's name."""
    server = own_server()
    elsewhere, copy = tmp_path / "elsewhere", tmp_path / "copy.db"
    elsewhere.touch(0o644)
    (tmp_path / "copy.db.unfinished").symlink_to(elsewhere)
    backup = [sys.executable, "-m", "server.backup", "--database", server.database_url, str(copy)]
    subprocess.run(backup, check=True, capture_output=True, timeout=60)
    assert elsewhere.read_bytes() == b""
    assert modes(copy) == {"copy.db": 0o600}


@pytest.mark.parametrize(
    "kind", ["symlink", *(pytest.param(each, marks=pytest.mark.slow) for each in ("folder", "hard link"))]
)
def test_one_file_is_served_once_by_whatever_name(own_server, tmp_path, kind):
    """Two servers on one file would each believe that its clocks, caches and locks are the only ones."""
    server = own_server()
    other = tmp_path / "other"
    if kind == "folder":
        other.symlink_to(server.database.parent)
        other = other / server.database.name
    elif kind == "symlink":
        other.symlink_to(server.database)
    else:
        os.link(server.database, other)
    done = start("--database", f"sqlite:///{other}")
    require_one_sentence(done, "is served by another process", f"({server.process.pid})")
    assert server.request("GET", "/v1/agents").status_code == 200
    server.stop(signal.SIGKILL)
    if kind != "hard link":  # SQLite's log goes by the name
        server.database_url = f"sqlite:///{other}"
    server.start()


def test_the_lock_outlives_the_connections(tmp_path):
    """SQLite opens and closes the file all the time; the server's lock is not given back with it."""
    database = Database(f"sqlite:///{tmp_path / 'locked.db'}")
    database.membership.enter()
    upgrade(database)
    database._engine.dispose()
    with pytest.raises(SettingsError, match=f"another process \\({os.getpid()}\\)"):
        Database(database.url).membership.enter()
    database.dispose()
    again = Database(database.url)
    again.membership.enter()
    again.dispose()


def test_the_servers_lock_keeps_nobody_from_reading(own_server, table_at):
    server = own_server()
    table_at(server)
    with closing(sqlite3.connect(server.database, timeout=30.0)) as reader:
        assert reader.execute("SELECT count(*) FROM matches").fetchone() == (1,)


def no_database(path):
    path.write_bytes(b"not a database " * 1000)
    return "file is not a database"


def foreign(path):
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("CREATE TABLE recipes (id INTEGER)")
    return "tables of another program (recipes)"


def foreign_with_migrations(path):
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("CREATE TABLE alembic_version (version_num VARCHAR(32) NOT NULL)")
        connection.execute("INSERT INTO alembic_version VALUES ('0001')")
        connection.execute("CREATE TABLE agents (id INTEGER)")
    return "tables of another program (agents)"


def newer(path):
    upgrade(database := Database(f"sqlite:///{path}"))
    database.dispose()
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute("UPDATE alembic_version SET version_num = '9999'")
    return f"a newer version of Pooliad wrote it (tables 9999, here {head()})"


def damaged(path):
    upgrade(database := Database(f"sqlite:///{path}"))
    database.dispose()
    content = bytearray(path.read_bytes())
    content[100:4096] = b"\xff" * 3996  # the page that says which tables there are
    path.write_bytes(content)
    return "database disk image is malformed"


def a_folder(path):
    path.mkdir()
    return "Is a directory"


@pytest.mark.parametrize(
    "make",
    [
        newer,
        damaged,
        *(
            pytest.param(each, marks=pytest.mark.slow)
            for each in (no_database, foreign, foreign_with_migrations, a_folder)
        ),
    ],
)
def test_a_database_that_is_not_ours_ends_in_one_sentence(tmp_path, make):
    path = tmp_path / "odd.db"
    words = make(path)
    before = path.read_bytes() if path.is_file() else None
    require_one_sentence(start("--database", f"sqlite:///{path}"), words)
    assert before == (path.read_bytes() if path.is_file() else None), "it is left as it was"
    keys = [sys.executable, "-m", "server.keys", "show", "--database", f"sqlite:///{path}"]
    done = subprocess.run(keys, capture_output=True, text=True, timeout=60)
    assert done.returncode == 1
    assert "Traceback" not in done.stderr


def test_a_file_that_is_no_database_is_a_fault_for_doctor(tmp_path):
    no_database(tmp_path / "odd.db")
    done = doctor("--database", f"sqlite:///{tmp_path / 'odd.db'}")
    assert done.exit_code == 1
    assert "must be an SQLite database or a new file" in done.stderr


def test_a_newer_postgresql_is_named_too(postgres):
    database = Database(postgres.new())
    upgrade(database)
    with database.writing() as connection:
        connection.exec_driver_sql("UPDATE alembic_version SET version_num = '9999'")
    with pytest.raises(SettingsError, match="a newer version of Pooliad wrote it"):
        upgrade(database)
    database.dispose()
