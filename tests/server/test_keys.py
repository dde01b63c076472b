"""Issue: records signed with Ed25519, keys published and rotated. docs/protocol.md, Record."""

import json
import os
import sqlite3
import subprocess
import sys

import pytest

from referee.record import PublicKey, SealState, verify_record


def published(server):
    answer = server.request("GET", "/v1/keys")
    assert answer.status_code == 200
    return answer.json()["keys"]


def public_keys(server):
    return [PublicKey(bytes.fromhex(k["public_key"]), k["valid_from"], k["valid_until"]) for k in published(server)]


def play(table):
    """Concede the next game; its record."""
    mover, view = table.mover()
    assert mover.post(f"/v1/games/{view['game']}/concede", version=view["version"]).status_code == 200
    for player, news in zip(table.players, table.news, strict=True):
        news.append(player.turn())
    return table.organiser.get(f"/v1/games/{view['game']}/record").text.splitlines()


def command(server, *arguments):
    """`pooliad keys …` beside the running server."""
    environment = os.environ | {"POOLIAD_DATABASE": f"sqlite:///{server.database}"}
    done = subprocess.run(
        [sys.executable, "-m", "client.cli", "keys", *arguments],
        capture_output=True,
        text=True,
        env=environment,
        timeout=60,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["keys"]


def test_every_record_is_signed_with_the_published_key(server, new_table):
    (key,) = published(server)
    assert (key["algorithm"], key["valid_until"]) == ("Ed25519", None)
    found = verify_record(play(new_table()), public_keys(server))
    assert found.ok
    assert (found.seal.state, found.seal.key) == (SealState.VALID, key["id"])


@pytest.mark.slow
def test_a_rotation_takes_effect_at_once_and_old_records_keep_verifying(own_server, table_at):
    server = own_server()
    table = table_at(server, games=3)
    before = play(table)
    old = published(server)[0]["id"]
    listed = command(server, "rotate")
    assert [key["id"] for key in listed] == [key["id"] for key in published(server)]
    new, retired = listed
    assert (retired["id"], new["valid_until"]) == (old, None)
    assert retired["valid_until"] > retired["valid_from"]
    after = play(table)
    assert [json.loads(record[-1])["key"] for record in (before, after)] == [old, new["id"]]
    server.restart()
    assert command(server, "show") == published(server) == listed
    for record in (before, after, play(table)):
        assert verify_record(record, public_keys(server)).ok
    only_new = [key for key in public_keys(server) if key.id == new["id"]]
    assert verify_record(before, only_new).seal.state is SealState.INVALID


def test_the_private_key_is_told_to_nobody(own_server, table_at):
    server = own_server()
    record = play(table_at(server))
    with sqlite3.connect(server.database) as connection:
        ((private,),) = connection.execute("select private_key from signing_keys").fetchall()
    connection.close()
    told = "".join([*record, json.dumps(published(server)), json.dumps(command(server, "show")), server.log])
    assert private.hex() not in told
    assert str(private) not in told


@pytest.mark.parametrize("how", ["server", "file", "hex"])
def test_verify_takes_a_server_a_file_or_a_key(server, new_table, tmp_path, how):
    record, keys = tmp_path / "game.jsonl", tmp_path / "keys.json"
    record.write_text("".join(f"{line}\n" for line in play(new_table())), encoding="utf-8")
    keys.write_text(server.request("GET", "/v1/keys").text, encoding="utf-8")
    given = {"server": server.url, "file": str(keys), "hex": published(server)[0]["public_key"]}[how]
    arguments = [sys.executable, "-m", "client.cli", "replay", "verify", str(record), "--key", given, "--json"]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert (found["ok"], found["signature"]["state"]) == (True, "valid")
    other = [*arguments[:-2], "00" * 31 + "01", "--json"]
    done = subprocess.run(other, capture_output=True, text=True, timeout=60)
    assert (done.returncode, json.loads(done.stdout)["verdict"]) == (1, "bad_signature")


@pytest.mark.parametrize("given", ["nonsense", "00" * 31, "http://127.0.0.1:9/"])
def test_keys_that_are_none_are_said_in_words(tmp_path, given):
    record = tmp_path / "game.jsonl"
    record.write_text("", encoding="utf-8")
    arguments = [sys.executable, "-m", "client.cli", "replay", "verify", str(record), "--key", given]
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=60)
    assert done.returncode != 0
    assert done.stderr.startswith(f"pooliad: --key {given}")
    assert "Traceback" not in done.stderr
