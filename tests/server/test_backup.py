"""`pooliad backup` (docs/operations.md, "Backup"): a copy made while games are played is whole, and of one moment."""

import json
import subprocess
import sys
import threading
import time

import pytest

from referee.record import verify_record

TERMS = {"games": 100, "clock": {"seconds": 3600}}


def copied(url, target):
    command = [sys.executable, "-m", "client.cli", "backup", "--database", url, str(target)]
    return subprocess.run(command, capture_output=True, text=True, timeout=60)


@pytest.mark.slow
def test_a_copy_made_under_load_is_restored_and_goes_on(own_server, table_at, tmp_path):
    server = own_server()
    tables = [table_at(server, **TERMS) for _ in range(3)]
    played = [table.play(2, seed=seed) for seed, table in enumerate(tables)]
    stop, faults = threading.Event(), []

    def load(table, seed):
        try:
            while not stop.is_set():
                table.play(1, seed=seed)
        except Exception as fault:  # shown below
            faults.append(fault)

    workers = [threading.Thread(target=load, args=(table, seed)) for seed, table in enumerate(tables)]
    for worker in workers:
        worker.start()
    time.sleep(0.2)
    copies = [tmp_path / f"copy{number}.db" for number in range(3)]
    for copy in copies:
        done = copied(server.database_url, copy)
        assert done.returncode == 0, done.stderr
        assert json.loads(done.stdout)["bytes"] == copy.stat().st_size
        assert copy.stat().st_mode & 0o077 == 0
    stop.set()
    for worker in workers:
        worker.join()
    assert not faults, faults[0]

    restored = own_server(f"sqlite:///{copies[-1]}")
    for table, answers in zip(tables, played, strict=True):
        for player in (*table.players, table.organiser):
            player.server = restored
        first = answers[0]["game"]
        strokes = table.organiser.get(f"/v1/games/{first}/shots", limit=200).json()["shots"]
        assert strokes[: len(answers)] == [answer["stroke"] for answer in answers]
        table.play(1, seed=9)
        match = table.organiser.post(f"/v1/matches/{table.match['id']}/abort").json()
        for game in match["played"]:
            assert verify_record(table.organiser.get(f"/v1/games/{game['id']}/record").text.splitlines()).ok


@pytest.mark.parametrize(
    ("url", "target", "words"),
    [
        ("sqlite:///{folder}/none.db", "copy.db", "there is no database"),
        ("sqlite:///{folder}/there.db", "there.db", "this one exists"),
        ("postgresql://user:secret@host/pool", "copy.db", "pg_dump"),
        ("mysql://x", "copy.db", "must be sqlite:///path"),
        ("sqlite:///{folder}/text.db", "copy.db", "file is not a database"),
        ("sqlite:///{folder}/there.db", "no/such/folder/copy.db", "No such file or directory"),
    ],
)
def test_what_cannot_be_copied_is_said_in_a_line(tmp_path, url, target, words):
    (tmp_path / "there.db").touch()
    (tmp_path / "text.db").write_text("not a database " * 100)
    done = copied(url.format(folder=tmp_path), tmp_path / target)
    assert done.returncode == 1
    assert words in done.stderr
    assert "Traceback" not in done.stderr
    assert "secret" not in done.stderr
    assert not (tmp_path / "copy.db").exists()
    assert not list(tmp_path.glob("*.unfinished"))
