"""What a power cut leaves of SQLite's files, with and without `group_commit`.

The server is stopped (SIGSTOP) at random moments under load and its files are copied as they are: what was acknowledged
before is in them. A cut also takes what had not reached the disk: the copy of the write-ahead log is cut off anywhere
behind what the games began with. Then whole strokes are lost, the latest first, and never a part of one, whatever
shared its commit.
"""

import json
import random
import shutil
import signal
import sqlite3
import threading
import uuid
from contextlib import closing

import pytest

from referee.record import GENESIS, line_digest
from server.services.play import stored_strokes
from server.services.play.live_game import FIRST_VERSION
from server.store.database import Database

MOMENTS = 6
CUTS = 5
"""Of each copy."""
TABLES = 4
TERMS = {"games": 100, "noise": {"level": 1.0}, "clock": {"seconds": 3600}}


class Hand:
    """Plays both sides of a match; what was acknowledged, by key, as it came."""

    def __init__(self, table, script, seed, stop):
        self.table, self.script, self.chance, self.stop = table, script, random.Random(seed), stop
        self.acknowledged = {}
        self.fault = None

    def play(self):
        try:
            while not self.stop.is_set():
                mover, view = self.table.mover()
                key = str(uuid.uuid4())
                answer = mover.act(view, self.script(view, self.chance), key=key)
                assert answer.status_code in (200, 422), answer.text
                if answer.status_code == 200:
                    self.acknowledged[key] = answer.content
        except BaseException as fault:
            self.fault = fault


@pytest.mark.slow
@pytest.mark.parametrize("group_commit", ["false", "true"])
def test_a_power_cut_loses_nothing_acknowledged_and_no_part_of_a_stroke(
    own_server, table_at, script, tmp_path, group_commit
):
    server, stop, chance = own_server(POOLIAD_GROUP_COMMIT=group_commit), threading.Event(), random.Random(7)
    hands = [Hand(table_at(server, **TERMS), script, seed, stop) for seed in range(TABLES)]
    begun = size_of_log(server.database)
    players = [threading.Thread(target=hand.play) for hand in hands]
    for player in players:
        player.start()
    copies = []
    try:
        for number in range(MOMENTS):
            before = sum(len(hand.acknowledged) for hand in hands)
            while sum(len(hand.acknowledged) for hand in hands) < before + TABLES and not any(
                hand.fault for hand in hands
            ):
                stop.wait(chance.uniform(0.0, 0.1))
            acknowledged = {key: body for hand in hands for key, body in tuple(hand.acknowledged.items())}
            server.process.send_signal(signal.SIGSTOP)
            try:
                copies.append((copied(server.database, tmp_path / f"moment {number}"), acknowledged))
            finally:
                server.process.send_signal(signal.SIGCONT)
    finally:
        stop.set()
        for player in players:
            player.join()
    assert not any(hand.fault for hand in hands), [hand.fault for hand in hands]
    for copy, acknowledged in copies:
        assert acknowledged.items() <= answers_in(copied(copy, tmp_path / "whole")).items()
        whole = size_of_log(copy)
        for _ in range(CUTS):
            cut = copied(copy, tmp_path / "cut")
            with cut.with_name(f"{cut.name}-wal").open("r+b") as log:
                log.truncate(chance.randint(begun, whole))
            require_whole_strokes(cut)


def size_of_log(database):
    """Bytes of the write-ahead log."""
    return database.with_name(f"{database.name}-wal").stat().st_size


def copied(database, folder):
    """The files of a database, as they are."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for ending in ("", "-wal"):
        shutil.copyfile(f"{database}{ending}", folder / f"{database.name}{ending}")
    return folder / database.name


def answers_in(database):
    """The answers that a recovered database gives again, by key."""
    with closing(sqlite3.connect(database)) as recovered:
        assert recovered.execute("PRAGMA integrity_check").fetchone() == ("ok",)
        return dict(recovered.execute("SELECT key, body FROM answers"))


def require_whole_strokes(path):
    """Every game is what its strokes made of it; each stroke has its answer and its charge."""
    answers = [json.loads(body) for body in answers_in(path).values() if body.startswith(b'{"game":')]
    database = Database(f"sqlite:///{path}")
    with database.reading() as connection:
        games = connection.exec_driver_sql("SELECT id, version, head, header FROM games WHERE status = 'running'").all()
        for game in games:
            moves = connection.exec_driver_sql(
                "SELECT number, packed, line FROM moves WHERE game_id = ? ORDER BY number", (game.id,)
            ).all()
            assert [move.number for move in moves] == list(range(game.version - FIRST_VERSION))
            lines = [game.header, *(stored_strokes.line(move) for move in moves)]
            heads = [GENESIS, *map(line_digest, lines)]
            assert [json.loads(line)["previous"] for line in lines] == heads[:-1]
            assert game.head == heads[-1]
            charges = connection.exec_driver_sql("SELECT move FROM charges WHERE game_id = ?", (game.id,)).scalars()
            assert sorted(charges) == list(range(len(moves)))
            told = sorted(answer["view"]["version"] for answer in answers if answer["game"] == game.id)
            assert told == list(range(FIRST_VERSION + 1, game.version + 1))
    database.dispose()


def test_every_commit_is_flushed(tmp_path):
    """SQLite's own word for it: 2 is FULL, the write-ahead log flushed at each commit."""
    database = Database(f"sqlite:///{tmp_path / 'flushed.db'}", group_commit=True)
    level = database.carry_out(lambda connection: connection.exec_driver_sql("PRAGMA synchronous").scalar_one())
    assert level == 2
    database.dispose()
