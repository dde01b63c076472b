"""Luck of strokes and games (docs/tournaments.md, "Luck")."""

import math
from dataclasses import replace

import numpy as np
import pytest

import client
from physics import Shot, Table
from referee import Action, EightBall, MatchSeed, NoiseModel, play_stroke, start_game
from referee.game import Decision, EndReason, Game, Outcome, Phase
from tournament.luck import VALUE, ValueModel, game_luck, stroke_luck
from tournament.luck.value import FEATURES, features

RULES = EightBall(Table.olympiad())
BREAK = Action(Shot(8.0, 270.0, 6.0))
KEY = b"k" * 32


def broken(match: int, level: float = 1.0) -> tuple[Game, Game, NoiseModel]:
    """A game before and after its break."""
    seeds = MatchSeed.of(match).game(0)
    before = start_game(RULES, seeds)
    noise = NoiseModel(level)
    return before, play_stroke(RULES, before, BREAK, seeds, noise, trace=False).game, noise


def count_balls(game, seat, noise):
    """A crude value: the share of object balls pocketed, whoever asks."""
    return (16 - len(game.state.balls)) / 16


def test_without_noise_there_is_no_luck():
    before, after, noise = broken(1, level=0.0)
    found = stroke_luck(RULES, before, BREAK, after, noise, key=KEY, draws=5)
    assert found.luck == pytest.approx(0.0, abs=1e-12)
    assert found.value == pytest.approx(found.noiseless)
    assert found.error == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("value", [VALUE, count_balls])
def test_the_mean_luck_of_equal_strokes_is_zero(value):
    """The definition, on independent outcomes of one intended break, for two value functions."""
    lucks, errors = [], []
    for match in range(60):
        seeds = MatchSeed.of(match).game(0)
        before = start_game(RULES, MatchSeed.of(0).game(0))
        noise = NoiseModel(2.0)
        after = play_stroke(RULES, before, BREAK, seeds, noise, trace=False).ruling.game
        found = stroke_luck(RULES, before, BREAK, after, noise, key=seeds.racks, draws=20, value=value)
        lucks.append(found.luck)
        errors.append(found.error)
    assert np.std(lucks) > 0.0
    assert abs(np.mean(lucks)) < 4.0 * np.std(lucks) / math.sqrt(len(lucks))
    assert np.mean(errors) < np.std(lucks)


def test_a_decision_and_a_single_draw_are_refused():
    before, after, noise = broken(2)
    with pytest.raises(ValueError, match="a decision has no noise"):
        stroke_luck(RULES, before, Action(decision=Decision.CONCEDE), after, noise, key=KEY)
    with pytest.raises(ValueError, match="draws = 1"):
        stroke_luck(RULES, before, BREAK, after, noise, key=KEY, draws=1)


def test_a_recorded_game_adds_up():
    """Zero-sum over the two seats, once for each stroke, the same again from the same record."""
    (game,) = client.play("random", "random", seed=4).games
    record = list(game.record())
    luck = game_luck(record, draws=4)
    assert len(luck.strokes) == sum(stroke.index is not None for stroke in game.strokes)
    assert [one.stroke for one in luck.strokes] == list(range(len(luck.strokes)))
    assert luck.of(0) == pytest.approx(-luck.of(1))
    assert luck.of(0) == pytest.approx(luck.own(0) - luck.own(1))
    assert luck.corrected(0) + luck.corrected(1) == pytest.approx(sum(luck.points))
    assert luck.points[game.outcome.winner] == 1.0
    assert game_luck(record, draws=4) == luck


def test_values_are_chances_of_the_two_seats():
    before, after, _ = broken(3)
    for game in (before, after):
        assert 0.0 < VALUE(game, 0, 1.0) < 1.0
        assert VALUE(game, 0, 1.0) + VALUE(game, 1, 1.0) == pytest.approx(1.0)
        assert set(features(game, 1.0)) <= set(FEATURES)
    over = replace(after, phase=Phase.OVER, outcome=Outcome(1, EndReason.EIGHT_MADE, "R46"))
    assert (VALUE(over, 0, 1.0), VALUE(over, 1, 1.0)) == (0.0, 1.0)
    drawn = replace(over, outcome=Outcome(None, EndReason.STALEMATE, "R49"))
    assert VALUE(drawn, 0, 1.0) == 0.5


def test_the_weights_are_those_of_their_data_line():
    """Fixed before any event, from a line that documents cite."""
    from benchmarks import recording

    (line,) = [line for line in recording.lines("value") if line["id"] == VALUE.source]
    assert {row["feature"]: row["weight"] for row in line["tables"]["weights"]} == dict(VALUE.weights)
    assert isinstance(VALUE, ValueModel)
