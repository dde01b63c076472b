"""Pictures from the command line."""

import html
import json
import re

import pytest
from typer.testing import CliRunner, Result

from client import play
from client.cli import application

SHOT = ["simulate", "--v", "3", "--phi", "262", "--balls", "0:0.5,1.7 3:0.4,0.6"]


def run(*arguments: str) -> Result:
    return CliRunner().invoke(application(), list(arguments))


@pytest.mark.parametrize(("ending", "start"), [("svg", b"<svg"), ("png", b"\x89PNG"), ("html", b"<!doctype html>")])
def test_simulate_draws_what_it_tells(tmp_path, ending, start):
    file = tmp_path / f"shot.{ending}"
    done = run(*SHOT, "--picture", str(file))
    assert done.exit_code == 0, done.stderr
    assert file.read_bytes().startswith(start)
    assert "cue_strike" in done.stdout or "ball 3" in done.stdout, "the events are told too"


def test_an_ending_that_no_picture_has_is_refused(tmp_path):
    done = run(*SHOT, "--picture", str(tmp_path / "shot.gif"))
    assert done.exit_code == 2
    assert "shot.gif': must end in .svg, .png, .html" in done.stderr
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_not_there_is_told(tmp_path):
    done = run(*SHOT, "--picture", str(tmp_path / "missing" / "shot.svg"))
    assert done.exit_code == 2
    assert "cannot be written: No such file" in done.stderr


@pytest.fixture(scope="module")
def record(tmp_path_factory):
    file = tmp_path_factory.mktemp("records") / "game.jsonl"
    match = play("random", "random", games=1, seed=4)
    file.write_text("".join(f"{line}\n" for line in match.games[0].record()), encoding="utf-8")
    return file


def test_a_stroke_and_a_whole_game_are_drawn_from_their_record(record, tmp_path):
    strokes = [entry for entry in map(json.loads, record.read_text().splitlines()) if entry.get("shot")]
    picture, page = tmp_path / "first.svg", tmp_path / "game.html"
    assert run("replay", "picture", str(record), "--shot", "1", "--output", str(picture)).exit_code == 0
    assert picture.read_text().startswith("<svg")
    assert run("replay", "html", str(record), "-o", str(page)).exit_code == 0
    shown = re.search(r'id="scenes">(.*?)</script>', page.read_text(), re.DOTALL)
    assert len(json.loads(shown.group(1))) == len(strokes)


def test_a_stroke_that_was_not_played_is_told(record, tmp_path):
    done = run("replay", "picture", str(record), "--shot", "9999", "-o", str(tmp_path / "none.svg"))
    assert done.exit_code == 2
    assert "this game has strokes 1 to" in done.stderr


def test_a_match_shows_itself_in_a_line_and_as_a_replay():
    match = play("random", "random", games=2, seed=4)
    assert repr(match).startswith("<LocalMatch random")
    assert len(repr(match)) < 100
    assert f", {len(match.games[0].strokes)} strokes>" in repr(match.games[0])
    page = html.unescape(match._repr_html_().partition('srcdoc="')[2].partition('" title=')[0])
    shown = re.search(r'id="scenes">(.*?)</script>', page, re.DOTALL)
    strokes = [stroke for game in match.games for stroke in game.strokes if stroke.shot is not None]
    assert len(json.loads(shown.group(1))) == len(strokes)
