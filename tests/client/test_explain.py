"""`pooliad agent explain` (docs/how_search_thinks.md): what is considered, what kind it is, and what goes wrong."""

import json

import pytest
from typer.testing import CliRunner

import client
import physics
from client.agents.search.explaining import kind_of
from client.cli import application
from protocol import Position
from referee import Call, EightBall, Phase

TABLE = physics.Table.olympiad()
BALLS = {"0": [0.5, 1.0], "1": [0.09, 0.09], "9": [0.7, 1.7], "8": [0.2, 1.8]}
QUICK = ("--name", "search:shots=600")


def run(*arguments):
    return CliRunner().invoke(application(), ["agent", "explain", *(str(argument) for argument in arguments)])


@pytest.fixture
def position(tmp_path):
    file = tmp_path / "position.json"
    file.write_text(json.dumps({"balls": BALLS, "groups": ["solids", "stripes"]}))
    return file


def test_a_position_is_explained(position, tmp_path):
    """The choice is the considered stroke of the greatest worth, and does without noise what is said of it."""
    picture = tmp_path / "choice.svg"
    told = json.loads(run(position, *QUICK, "--json").stdout)
    best, *others = told["considered"]
    assert best["action"] == told["chosen"]
    assert all(best["worth"] >= other["worth"] for other in others)
    assert (best["action"]["call"]["ball"], best["kind"], best["made_as_meant"]) == (1, "straight pot", True)
    text = run(position, *QUICK, "--picture", picture)
    assert text.exit_code == 0
    assert "1 is chosen" in text.stdout
    assert "1 into SW" in text.stdout
    assert picture.read_text().startswith("<svg")


def test_the_same_seed_explains_the_same(position):
    assert run(position, *QUICK, "--json").stdout == run(position, *QUICK, "--json").stdout
    assert run(position, *QUICK, "--json").stdout != run(position, *QUICK, "--json", "--seed", 1).stdout


def test_a_stroke_of_a_record_is_explained(tmp_path):
    (game,) = client.play("search:shots=150", "random", seed=5, noise=2.0).games
    file = tmp_path / "game.jsonl"
    file.write_text("".join(f"{line}\n" for line in game.record()))
    numbers = [
        stroke.game.stroke
        for before, stroke in zip(game.strokes, game.strokes[1:], strict=False)
        if stroke.shot is not None and before.game.phase is Phase.PLAY
    ]
    told = run(file, "--shot", numbers[0], *QUICK)
    assert told.exit_code == 0
    assert "played in the game" in told.stdout
    first = run(file, "--shot", 1, *QUICK)
    assert (first.exit_code, "phase = 'break'" in first.stderr) == (2, True)
    beyond = run(file, "--shot", 999)
    assert (beyond.exit_code, "--shot is 999" in beyond.stderr) == (2, True)


@pytest.mark.parametrize(
    ("name", "named"),
    [("greedy", "must be search"), ("search:speed=1", "speed"), ("search:shots=-1", "shots")],
)
def test_another_agent_is_named(position, name, named):
    done = run(position, "--name", name)
    assert done.exit_code == 2
    assert named in done.stderr
    assert "Traceback" not in done.output


def test_a_file_that_is_no_position_is_named(tmp_path):
    file = tmp_path / "text.json"
    file.write_text("hello")
    done = run(file)
    assert (done.exit_code, "text.json" in done.stderr) == (2, True)
    done = run(file, "--shot", 1)
    assert (done.exit_code, "text.json" in done.stderr) == (2, True)


@pytest.mark.parametrize(
    ("balls", "phi", "v", "call", "kind"),
    [
        ({0: (0.5, 0.5), 3: (0.3, 0.3)}, 225.0, 2.0, Call(3, 0), "straight pot"),
        ({0: (0.5, 0.5), 3: (0.3, 0.3), 4: (0.15, 0.15)}, 225.0, 2.0, Call(4, 0), "combination"),
        ({0: (0.5, 0.5), 3: (0.3, 0.5)}, 180.0, 2.0, Call(3, 4), "bank"),
        ({0: (0.5, 0.5), 3: (0.9, 0.5)}, 180.0, 3.0, Call(3, 4), "kick + bank"),
        ({0: (0.5, 0.5), 3: (0.3, 0.3)}, 225.0, 2.0, None, "safety"),
    ],
)
def test_kinds_of_strokes(balls, phi, v, call, kind):
    state = physics.TableState.from_positions(balls)
    theta = physics.min_elevation(TABLE, state, phi) + 0.5
    assert kind_of(physics.simulate(TABLE, state, physics.Shot(v, phi, theta)), call) == kind


def test_a_position_as_messages_have_it():
    """The file is a `Position`: what `agent spar --start` reads."""
    game = Position.model_validate({"balls": BALLS, "groups": ["solids", "stripes"]}).to_game()
    assert EightBall(TABLE).begin_from(game).phase is Phase.PLAY
