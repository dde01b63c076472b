"""The calibration guide (docs/calibration.md) to its end: a game on the table that was fitted, against a house bot."""

import json
import os
import random
import subprocess
import sys
import time

import pytest
from support.require import ROOT

from physics import RealTable, Table
from physics.table_file import write_table
from referee.record import verify_record

PATIENCE = 240.0
"""Seconds: a bot plays once the kernels are compiled."""


@pytest.fixture
def my_table(tmp_path):
    """As ``pooliad calibrate --out`` writes it."""
    fitted = Table.nine_foot().replace(mu_slide=0.2151, mu_roll=0.01149, e_ball=0.9404, e_cushion=0.8106)
    assert isinstance(fitted, RealTable)
    write_table(tmp_path / "my_table.toml", fitted, ("Fitted by pooliad calibrate.",))
    return fitted, tmp_path / "my_table.toml"


def make_match(server, organiser, *words):
    """Run the script of the guide."""
    environment = os.environ | {"POOLIAD_URL": server.url, "POOLIAD_ORGANISER_TOKEN": organiser.token}
    command = [sys.executable, str(ROOT / "examples" / "calibration" / "play.py"), *map(str, words)]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False, timeout=240)


def turn_of(player):
    """The next turn; other messages are news."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        message = player.get("/v1/turns", wait=5)
        if message.status_code == 200 and message.json()["type"] == "turn":
            return message.json()["view"]
    raise AssertionError("no turn came")


def test_a_match_on_a_table_file_is_played_by_hand_against_a_house_bot(
    own_server, player_at, organiser_at, my_table, script
):
    """Both shoot, by hand and by the bot; the record that is left verifies, on the table of the file."""
    fitted, file = my_table
    server, chance = own_server(POOLIAD_HOUSE_BOTS="random"), random.Random(1)
    player, organiser = player_at(server), organiser_at(server)
    name = player.get("/v1/agents/me").json()["name"]
    made = make_match(server, organiser, file, name, "random")
    assert made.returncode == 0, made.stderr
    (match,) = player.get("/v1/matches", agent=player.id, status="running").json()["matches"]
    assert Table.from_dict(match["table"]) == fitted
    game = match["played"][0]["id"]
    shot_by: set[int] = set()
    while shot_by != {0, 1}:
        view = turn_of(player)
        answer = player.act(view, script(view, chance))
        assert answer.status_code in (200, 422), answer.text
        shot_by = {shot["seat"] for shot in player.get(f"/v1/games/{game}/shots").json()["shots"] if shot["shot"]}
    view = turn_of(player)
    assert player.post(f"/v1/games/{game}/concede", version=view["version"]).status_code == 200
    record = player.get(f"/v1/games/{game}/record").text
    assert Table.from_dict(json.loads(record.splitlines()[0])["table"]) == fitted
    assert verify_record(record.splitlines()).ok


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("my_table.toml", "Nobody", "random"), "Nobody: must be the name of an agent"),
        (("lost.toml", "Nobody", "random"), "lost.toml"),
    ],
)
def test_what_is_wrong_is_one_sentence(server, organiser, my_table, words, said):
    file = my_table[1].parent / words[0]
    refused = make_match(server, organiser, file, *words[1:])
    assert refused.returncode == 1
    assert said in refused.stderr
    assert "Traceback" not in refused.stderr
