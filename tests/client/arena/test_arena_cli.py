"""`pooliad tournament`: docs/running-tournaments.md."""

import json
import re
import sys

import pytest
from typer.testing import CliRunner

from client.arena.directory import EventError
from client.arena.estimate import estimate
from client.arena.terms import Terms
from client.cli import application
from referee.record import verify_record
from tournament import RECOMMENDED, Spec

CUP = """
name = "Cup"
seconds = 100
seed = 4
entrants = ["random", {name = "other", agent = "random"}]
"""


@pytest.fixture
def cli(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cup.toml").write_text(CUP)

    def call(*arguments, code=0):
        done = CliRunner().invoke(application(), ["tournament", *map(str, arguments)])
        assert done.exit_code == code, done.output
        return done

    return call


def test_an_event_from_its_file_to_its_report(cli, tmp_path):
    estimate = json.loads(cli("run", "cup.toml", "--dry-run", "--json").stdout)
    assert estimate["games"] == [2, 2]
    assert estimate["longest_seconds"] == 400.0, "both games are of one pair: one worker plays them"
    assert not (tmp_path / "cup").exists()
    played = json.loads(cli("run", "cup.toml", "--executor", "inline", "--json").stdout)
    assert (played["state"], played["games"], played["due"]) == ("finished", 2, 0)
    assert json.loads(cli("status", "cup", "--json").stdout)["standings"] == played["standings"]
    report = json.loads(cli("report", "cup", "--json").stdout)
    assert report["standings"] == played["standings"]
    assert report["luck"] == []
    assert [one["record"] for one in report["moments"]], "turning points of games that were played"
    for game in report["games"]:
        assert (tmp_path / "cup" / game["replay"]).read_text().startswith("<!doctype html>"), game
    (tmp_path / "cup" / "games" / "r0-m0-p0-g1.jsonl").unlink()  # one game is enough here
    again = json.loads(cli("report", "cup", "--luck", "--replays", "0", "--json").stdout)
    lucky = again["luck"]
    assert [game["replay"] for game in again["games"]] == [None, None]
    assert [row["games"] for row in lucky] == [1, 1]
    assert sum(row["games"] * row["luck"] for row in lucky) == pytest.approx(0.0, abs=1e-9)
    assert "<html" in (tmp_path / "cup" / "report.html").read_text()
    assert len((tmp_path / "cup" / "results.jsonl").read_text().splitlines()) == 2
    assert "Cup" in cli("status", "cup").stdout


def test_an_estimate_counts_pairs_and_the_rounds_that_wait_for_each_other():
    """Seen: games divided by workers, so that three rounds of 7 pairs were to take 8 workers less than a pair."""
    entrants = [{"name": name, "agent": "remote"} for name in "abcdefgh"]
    terms = {"name": "cup", "entrants": entrants, "format": "knockout", "pairs": 1, "extra_pairs": 1, "seconds": 50}
    found = estimate(Terms.from_dict(terms), workers=3)
    assert found.games == (14, 28)
    turns = (2 + 2) + (1 + 1) + (1 + 1)  # pairs that follow each other: of the round, and extra ones
    assert found.longest_seconds == turns * 2 * 2 * 50.0


def test_decisions_are_noted_with_who_and_why(cli, tmp_path):
    cli("run", "cup.toml", "--executor", "inline")
    cli("void", "cup", "r0-m0-p0", "1", "--reason", "wrong cloth")
    line = json.loads((tmp_path / "cup" / "journal.jsonl").read_text().splitlines()[-1])
    assert (line["kind"], line["reason"], line["leg"]) == ("void", "wrong cloth", 1)
    assert line["by"]
    assert json.loads(cli("status", "cup", "--json").stdout)["due"] == 1
    assert json.loads(cli("resume", "cup", "--executor", "inline", "--json").stdout)["state"] == "finished"
    assert "game with a result" in cli("void", "cup", "r7-m0-p0", "0", code=2).stderr
    assert "entrant" in cli("disqualify", "cup", "nobody", code=2).stderr
    cli("abort", "cup")
    assert "aborted" in cli("pause", "cup", code=2).stderr


def test_an_event_at_a_server_takes_a_token(cli, monkeypatch):
    monkeypatch.delenv("POOLIAD_ORGANISER_TOKEN", raising=False)
    assert "token" in cli("run", "cup.toml", "--server", "http://127.0.0.1:9", code=2).stderr


UNSTARTABLE = """
import client


class Fine(client.Agent):
    def choose(self, view):
        return client.Action(decision="concede")


class NoModel(Fine):
    def __init__(self):
        raise FileNotFoundError("model.bin")


class NoStart(Fine):
    def game_started(self, view):
        raise LookupError("no table for this game")
"""


BAD = {
    "bots:Nobody": "has no attribute 'Nobody'",
    "nowhere:Agent": "No module named 'nowhere'",
    "bots:NoModel": "FileNotFoundError: model.bin",
    "bots:NoStart": "LookupError: no table for this game",
    "stdio:./no-such-program": "'./no-such-program' is no program that can be run here",
    f"stdio:{sys.executable} missing.py": "missing.py",
    "search:seconds=none": "seconds",
}
"""Entrants that cannot be imported, made or started, and why."""


@pytest.mark.parametrize("dry", [pytest.param(True, marks=pytest.mark.slow), False], ids=["dry run", "run"])
def test_entrants_that_cannot_be_started_are_named_before_the_first_game(cli, tmp_path, monkeypatch, dry):
    """Seen: the dry run said how long it would take, and the event went on to its end with every game of them lost."""
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    (tmp_path / "bots.py").write_text(UNSTARTABLE)
    entrants = [f'{{name = "bad{n}", agent = "{agent}"}}' for n, agent in enumerate(BAD)]
    entrants.append('{name = "good", agent = "bots:Fine"}')
    (tmp_path / "cup.toml").write_text(CUP.replace('"random", {', f'"random", {", ".join(entrants)}, {{'))
    done = CliRunner().invoke(application(), ["tournament", "run", "cup.toml", *(["--dry-run"] if dry else [])])
    assert isinstance(done.exception, EventError), done.output
    complaints = [text for text in re.split(r"^entrant ", str(done.exception), flags=re.MULTILINE) if text]
    assert len(complaints) == len(BAD)
    for n, (complaint, (agent, words)) in enumerate(zip(complaints, BAD.items(), strict=True)):
        assert complaint.startswith(f"'bad{n}': agent = {agent!r}: cannot be started: ")
        assert words in complaint
    if not dry:
        assert list((tmp_path / "cup" / "games").iterdir()) == []
        assert '"kind": "game"' not in (tmp_path / "cup" / "journal.jsonl").read_text()


def test_an_event_goes_on_without_an_entrant_that_was_taken_out_because_it_cannot_be_started(
    cli, tmp_path, monkeypatch
):
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    entrants = '"random", {name = "bad", agent = "nowhere:Agent"}, {'
    (tmp_path / "cup.toml").write_text(CUP.replace('"random", {', entrants))
    assert isinstance(CliRunner().invoke(application(), ["tournament", "run", "cup.toml"]).exception, EventError)
    cli("disqualify", "cup", "bad", "--reason", "cannot be started")
    assert json.loads(cli("resume", "cup", "--executor", "inline", "--json").stdout)["state"] == "finished"


def test_an_event_with_a_players_own_standard_deviations(cli, tmp_path):
    """`noise.sigmas` names a file beside the event file, as `pooliad calibrate --noise-out` writes it."""
    (tmp_path / "mine.toml").write_text("phi = 0.4\nv = 0.01\n")
    noise = 'noise = {levels = [0.5], sigmas = "mine.toml"}\n'
    (tmp_path / "cup.toml").write_text(CUP.replace("seed = 4\n", f"seed = 4\n{noise}"))
    assert json.loads(cli("run", "cup.toml", "--executor", "inline", "--json").stdout)["state"] == "finished"
    lines = (tmp_path / "cup" / "games" / "r0-m0-p0-g1.jsonl").read_text().splitlines()
    sigmas = {"v": 0.01, "phi": 0.4, "theta": 0.1, "a": 0.5, "b": 0.5}
    assert json.loads(lines[0])["noise"] == {"level": 0.5, "told": True, "sigmas": sigmas}
    assert verify_record(lines).ok
    assert json.loads(cli("status", "cup", "--json").stdout)["state"] == "finished"
    (tmp_path / "mine.toml").write_text("phi = 40\n")
    with pytest.raises(EventError, match="phi = 40: must be a number from 0 to 10"):
        Terms.read(tmp_path / "cup.toml")


def test_a_file_that_names_neither_table_nor_noise_is_played_in_the_recommended_contest(tmp_path):
    """docs/tournaments.md: the preset that tells players apart. What a file says of either is played as before."""
    file = tmp_path / "cup.toml"
    file.write_text(CUP)
    recommended = Spec.from_dict({"name": "x", "entrants": ["a", "b"], "preset": RECOMMENDED})
    spec = Terms.read(file).spec
    assert (spec.table, spec.noise, spec.seconds) == (recommended.table, recommended.noise, 100.0)
    for said in ("noise = 1.0", 'table = "olympiad"', 'preset = "olympiad-noise-1"'):
        file.write_text(f"{said}\n{CUP}")
        spec = Terms.read(file).spec
        assert (spec.table, spec.noise.levels) == ("olympiad", (1.0,)), said
    stored = Terms.from_dict({"name": "x", "entrants": ["random", "greedy"]}).spec
    assert stored.table == "olympiad", "terms that were stored, or sent to a server, mean what they meant"
