"""Today's server on the database that version 0.1.0 left behind (tests/upgrade/README.md): docs/upgrading.md."""

import hashlib
import json
import lzma

import pytest
from alembic import command
from alembic.config import Config
from sqlalchemy import MetaData, create_engine, func, insert, select
from support.cup import Cup
from support.require import ROOT

from referee.record import Engine, PublicKey, RecordVerdict, read_record, this_engine, verify_record
from server.store.upgrade import SCRIPTS

FIXTURES = ROOT / "tests" / "upgrade"
LEFT = json.loads((FIXTURES / "v0_1_0.json").read_text(encoding="utf-8"))
"""What version 0.1.0 left, and what it had served of it."""


@pytest.fixture(scope="module")
def left_behind(database_kind, new_database, tmp_path_factory):
    """The URL of a copy of the database: the file itself, or its rows in a PostgreSQL of that version's schema."""
    file = tmp_path_factory.mktemp("left") / "pooliad.db"
    file.write_bytes(lzma.decompress((FIXTURES / "v0_1_0.db.xz").read_bytes()))
    if database_kind == "sqlite":
        return f"sqlite:///{file}"
    url = new_database()
    _copy(f"sqlite:///{file}", url)
    return url


def _copy(source, target):
    """Every row of an SQLite database of version 0.1.0, in a PostgreSQL that has that version's tables."""
    old, new = create_engine(source), create_engine(target.replace("postgresql:", "postgresql+psycopg:"))
    there, here = MetaData(), MetaData()
    there.reflect(old)
    with old.connect() as reading, new.begin() as writing:
        migrations = Config()
        migrations.set_main_option("script_location", str(SCRIPTS))
        migrations.attributes["connection"] = writing
        command.upgrade(migrations, "0001")
        here.reflect(writing)
        for table in here.sorted_tables:
            rows = [dict(row) for row in reading.execute(select(there.tables[table.name])).mappings()]
            if table.name == "alembic_version" or not rows:
                continue
            writing.execute(insert(table), rows)
            if "sequence" in table.c:
                counter = func.pg_get_serial_sequence(table.name, "sequence")
                writing.execute(select(func.setval(counter, max(row["sequence"] for row in rows))))
    old.dispose()
    new.dispose()


@pytest.fixture(scope="module")
def upgraded(left_behind, new_running):
    """Today's server on it."""
    return new_running(left_behind, POOLIAD_ORGANISER_TOKEN=LEFT["organiser"])


def get(server, path, token=None):
    answer = server.request("GET", path, token)
    assert answer.status_code == 200, answer.text
    return answer


def record_of(server, game):
    return get(server, f"/v1/games/{game}/record").text


def test_finished_games_are_served_as_they_were(upgraded):
    for game, digest in LEFT["records"].items():
        assert hashlib.sha256(record_of(upgraded, game).encode()).hexdigest() == digest


def test_finished_games_verify_and_say_which_engine_made_them(upgraded):
    """Bit for bit the same game, signed by one of the two keys that version 0.1.0 had."""
    keys = [PublicKey.from_hex(key["public_key"]) for key in get(upgraded, "/v1/keys").json()["keys"]]
    for game in LEFT["records"]:
        found = verify_record(record_of(upgraded, game).splitlines(), keys)
        assert found.ok, str(found)
        assert found.verdict is RecordVerdict.SAME_GAME
        assert found.needs == Engine.from_dict(LEFT["engine"])


def test_the_keys_are_still_published(upgraded):
    assert get(upgraded, "/v1/keys").json()["keys"] == LEFT["keys"]


def test_finished_matches_and_the_finished_event_read_as_before(upgraded):
    for what, match in LEFT["finished"].items():
        expected = "aborted" if what == "called off" else "finished"
        assert get(upgraded, f"/v1/matches/{match}").json()["status"] == expected
    event = f"/v1/tournaments/{LEFT['events']['finished']}"
    assert get(upgraded, event).json()["status"] == "finished"
    for line, before in zip(get(upgraded, f"{event}/standings").json()["standings"], LEFT["standings"], strict=True):
        assert before.items() <= line.items()


def test_matches_that_were_on_are_called_off_and_their_records_are_true(upgraded):
    """Version 0.1.0's engine is another one: nothing more is played with this one in a match committed to that one."""
    for match in LEFT["unfinished"].values():
        view = get(upgraded, f"/v1/matches/{match}").json()
        assert view["status"] == "aborted"
        assert f"match {match} is committed to another engine" in upgraded.log
        for game in view["played"]:
            record = record_of(upgraded, game["id"])
            assert verify_record(record.splitlines()).ok
            assert record_of(upgraded, game["id"]) == record
    on = get(upgraded, f"/v1/matches/{LEFT['unfinished']['in the middle of a turn']}").json()
    first, second = (read_record(record_of(upgraded, game["id"]).splitlines()) for game in on["played"])
    assert first.end["outcome"]["reason"] == "concession"
    assert (second.end["outcome"]["reason"], len(second.entries)) == ("aborted", 1)


def test_a_stroke_sent_again_after_the_upgrade_is_not_played_again(upgraded):
    """Its answer was lost when the server stopped: the same request, with the same key."""
    stroke = LEFT["stroke"]
    before = get(upgraded, f"/v1/games/{stroke['game']}/shots").json()
    answer = upgraded.request(
        "POST",
        f"/v1/games/{stroke['game']}/shots",
        LEFT["agents"][stroke["player"]]["token"],
        json=stroke["action"],
        headers={"Idempotency-Key": stroke["key"], "If-Match": f'"{stroke["version"]}"'},
    )
    kept = answer.status_code == 200
    assert not kept or hashlib.sha256(answer.content).hexdigest() == stroke["answer"]
    assert kept or answer.status_code == 409, answer.text
    assert get(upgraded, f"/v1/games/{stroke['game']}/shots").json() == before


def test_players_keep_their_tokens_and_are_told_that_matches_are_over(upgraded):
    """Also of what they had not fetched before the upgrade."""
    called_off = set(LEFT["unfinished"].values()) - {LEFT["unfinished"]["a challenge"]}
    told = set()
    for name, agent in LEFT["agents"].items():
        assert get(upgraded, "/v1/agents/me", agent["token"]).json()["name"] == name
        while (answer := upgraded.request("GET", "/v1/turns?wait=0", agent["token"])).status_code == 200:
            message = answer.json()
            if message["type"] == "turn":
                break
            told |= {message["match"]} if message["type"] == "match_over" else set()
    assert called_off <= told


def test_the_event_that_was_on_goes_on_and_ends(upgraded, player_with):
    """Its match is called off and played again with this engine; what was counted stays."""
    players = {name: player_with(upgraded, **agent) for name, agent in LEFT["agents"].items()}
    organiser = player_with(upgraded, "organiser", LEFT["organiser"])
    event = Cup.of(organiser, players, LEFT["events"]["running"])
    view = event.read()
    assert (view["status"], view["games"]) == ("running", 1)
    (game,) = event.play_out()
    record = record_of(upgraded, game).splitlines()
    assert verify_record(record).verdict is RecordVerdict.VERIFIED
    assert read_record(record).header["engine"] == this_engine().to_dict()
    assert (event.read()["status"], event.read()["games"]) == ("finished", 2)
