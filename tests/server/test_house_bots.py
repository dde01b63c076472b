"""House bots: real processes started by a real server, that accept challenges and play."""

import os
import signal
import time
from pathlib import Path

import pytest

from server.errors import SettingsError
from server.services.accounts.house_bots import HouseBot, parse

PATIENCE = 240.0
"""Seconds: after a change of the kernels a bot plays once they are compiled."""


def until(condition, seconds=PATIENCE):
    """Wait for something to become true; what it was then."""
    end = time.monotonic() + seconds
    while not (found := condition()) and time.monotonic() < end:
        time.sleep(0.1)
    assert found, "waited in vain"
    return found


@pytest.fixture
def house_server(own_server):
    """Makes a server with the shipped `random` in the house."""
    return lambda **more: own_server(**({"POOLIAD_HOUSE_BOTS": "random"} | more))


def bot_of(server):
    (bot,) = server.request("GET", "/v1/agents", params={"house": "true"}).json()["agents"]
    return bot


def challenge(player, bot, key=None, **terms):
    return player.post("/v1/matches", {"agents": [player.id, bot["id"]]} | terms, key=key)


def bot_processes(server):
    """The process ids of the agents that a server has started, by /proc."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            if parent == server.process.pid and "agent\0run" in (entry / "cmdline").read_text():
                found.append(int(entry.name))
        except (OSError, ValueError):
            continue
    return found


def gone(process):
    """Whether a process has left, reaped or not."""
    try:
        return (Path("/proc") / str(process) / "stat").read_text().rpartition(")")[2].split()[0] == "Z"
    except OSError:
        return True


def playing_alone(player, match):
    """Concede whenever it is our turn, until the match is over."""

    def step():
        message = player.get("/v1/turns", wait=1)
        if message.status_code == 200 and message.json()["type"] == "turn":
            view = message.json()["view"]
            player.post(f"/v1/games/{view['game']}/concede", version=view["version"])
        return player.get(f"/v1/matches/{match}").json()["status"] == "finished"

    until(step)


def test_a_bot_accepts_at_once_and_plays(house_server, player_at):
    server = house_server()
    bot = bot_of(server)
    assert (bot["name"], bot["house"]) == ("random", True)
    player = player_at(server)
    made = challenge(player, bot, start={"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4]}, "turn": 1})
    assert (made.status_code, made.json()["status"], made.json()["challenger"]) == (201, "running", 0)
    assert made.json()["rated"] is False
    game = made.json()["played"][0]["id"]
    until(lambda: player.get(f"/v1/games/{game}/shots").json()["shots"])
    playing_alone(player, made.json()["id"])
    assert player.get("/v1/agents", house="false").json()["agents"] == [player.get("/v1/agents/me").json()]


def test_a_game_with_a_bot_is_unrated_unless_an_organiser_makes_it(house_server, player_at, organiser):
    server = house_server()
    bot, player = bot_of(server), player_at(server)
    organiser = type(player)(server, organiser.id, organiser.token)
    assert challenge(player, bot, rated=True).json()["rated"] is False
    request = {"agents": [player.id, bot["id"]]}
    assert organiser.post("/v1/matches", request).json()["rated"] is True


def test_a_killed_bot_is_started_again_and_goes_on_with_its_turn(house_server, player_at):
    server = house_server()
    bot, player = bot_of(server), player_at(server)
    (first,) = until(lambda: bot_processes(server))
    os.kill(first, signal.SIGKILL)
    made = challenge(player, bot, start={"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4]}, "turn": 1})
    game = made.json()["played"][0]["id"]
    until(lambda: player.get(f"/v1/games/{game}/shots").json()["shots"])
    (second,) = bot_processes(server)
    assert second != first
    assert "house bot random left with exit code -9" in server.log


def test_bots_end_with_the_server_and_come_back_with_it(house_server):
    server = house_server()
    bot = bot_of(server)
    (before,) = until(lambda: bot_processes(server))
    assert server.stop() == 0
    with pytest.raises(ProcessLookupError):
        os.kill(before, 0)
    server.start()
    assert bot_of(server)["id"] == bot["id"]
    until(lambda: bot_processes(server))


@pytest.mark.slow
def test_a_bot_left_over_from_a_killed_server_is_sent_away(house_server, player_at):
    """Its token is void as soon as another process runs the bot."""
    server = house_server()
    (orphan,) = until(lambda: bot_processes(server))
    server.restart(signal.SIGKILL)
    until(lambda: gone(orphan))
    bot, player = bot_of(server), player_at(server)
    made = challenge(player, bot, start={"balls": {"0": [0.5, 1.7], "3": [0.4, 0.6], "8": [0.9, 0.4]}, "turn": 1})
    game = made.json()["played"][0]["id"]
    until(lambda: player.get(f"/v1/games/{game}/shots").json()["shots"])


def test_a_bot_without_a_place_accepts_when_one_is_free(house_server, player_at):
    server = house_server(POOLIAD_HOUSE_PLACES="1")
    bot, first, second = bot_of(server), player_at(server), player_at(server)
    playing = challenge(first, bot).json()
    waiting = challenge(second, bot).json()
    again = challenge(first, bot).json()
    assert [each["status"] for each in (playing, waiting, again)] == ["running", "challenged", "challenged"]
    playing_alone(first, playing["id"])
    until(lambda: second.get(f"/v1/matches/{waiting['id']}").json()["status"] == "running")
    assert first.get(f"/v1/matches/{again['id']}").json()["status"] == "challenged"


def test_one_challenge_of_an_agent_waits_for_a_bot(house_server, player_at):
    """An agent that plays a bot could lay so many challenges before it that nobody else's was looked at."""
    server = house_server(POOLIAD_HOUSE_PLACES="1")
    bot, player = bot_of(server), player_at(server)
    assert challenge(player, bot).json()["status"] == "running"
    waiting = challenge(player, bot, key="second").json()
    assert waiting["status"] == "challenged"
    refused = challenge(player, bot)
    assert (refused.status_code, refused.json()["code"]) == (409, "wrong_status")
    assert waiting["id"] in refused.json()["detail"]
    assert challenge(player, bot, key="second").json()["id"] == waiting["id"]
    assert player.post(f"/v1/matches/{waiting['id']}/abort").status_code == 200
    assert challenge(player, bot).status_code == 201


def test_those_who_wait_for_one_bot_hide_nobody_who_waits_for_another(house_server, player_at, organiser_at):
    """The oldest hundred challenges were looked at, whomever they were for."""
    server = house_server(POOLIAD_HOUSE_BOTS="random;other=random", POOLIAD_HOUSE_PLACES="1")
    listed = server.request("GET", "/v1/agents", params={"house": "true"}).json()["agents"]
    wanted, other = sorted(listed, key=lambda bot: bot["name"] == "other")
    for _ in range(102):
        challenge(player_at(server), wanted)
    playing, waiting = (challenge(player_at(server), other).json() for _ in range(2))
    organiser = organiser_at(server)
    assert (playing["status"], waiting["status"]) == ("running", "challenged")
    organiser.post(f"/v1/matches/{playing['id']}/abort")
    until(lambda: organiser.get(f"/v1/matches/{waiting['id']}").json()["status"] == "running", 30)


@pytest.mark.parametrize(
    ("terms", "field"), [({"games": 11}, "games"), ({"clock": {"seconds": 901.0}}, "clock.seconds")]
)
def test_a_challenge_that_would_keep_a_place_for_long_is_refused(house_server, player_at, terms, field):
    server = house_server()
    response = challenge(player_at(server), bot_of(server), **terms)
    assert (response.status_code, response.json()["field"]) == (422, field)


def test_a_name_that_somebody_else_has_keeps_the_server_from_starting(own_server, tmp_path):
    server = own_server()
    server.request("POST", "/v1/agents", json={"name": "random"})
    server.stop()
    server.environment |= {"POOLIAD_HOUSE_BOTS": "random"}
    with pytest.raises(pytest.fail.Exception, match="house-random=random"):
        server.start()


def test_how_bots_are_named():
    bots = parse("random; mine = stdio:perl my bot.pl ;\nother=module:Class")
    assert bots == (
        HouseBot("random", "random"),
        HouseBot("mine", "stdio:perl my bot.pl"),
        HouseBot("other", "module:Class"),
    )
    assert parse(" ; ") == ()


@pytest.mark.parametrize("text", ["=greedy", "greedy=", "a;a", "a/b", "ö"])
def test_settings_that_name_no_bots_are_refused(text):
    with pytest.raises(SettingsError, match="must be"):
        parse(text)
