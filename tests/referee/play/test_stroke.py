"""The stroke, through real shots: check, place, noise, simulate, rule; and nothing before the check."""

import pickle
from dataclasses import replace
from typing import Any

import pytest

from physics import Shot, Status, Table, TableState, rack, simulate
from referee.game import Action, Call, CueBallArea, Decision, Group, Phase
from referee.play import GameSeeds, MatchSeed, NoiseModel, Refused, play_stroke, start_game
from referee.rules import EightBall

TABLE = Table.olympiad()
RULES = EightBall(TABLE)
SEEDS = MatchSeed.of(11).game(0)
EXACT, NOISY = NoiseModel(0.0), NoiseModel(1.0)
BREAK = Action(Shot(9.0, 270.0, 5.0), cue_ball=(0.558, 1.75))
SOFT_BREAK = Action(Shot(0.3, 270.0, 5.0), cue_ball=(0.558, 1.75))


def position(balls, **changes):
    """A game in play with these balls, player 0 to shoot."""
    in_play: dict[str, Any] = {"state": TableState.from_positions(balls), "phase": Phase.PLAY, "cue_ball_in_hand": None}
    return replace(start_game(RULES, SEEDS), **(in_play | changes))


def test_a_stroke_is_placed_made_noisy_simulated_and_ruled():
    game = start_game(RULES, SEEDS, breaker=1)
    stroke = play_stroke(RULES, game, BREAK, SEEDS, NOISY)
    assert (stroke.seat, stroke.index, stroke.action) == (1, 0, BREAK)
    assert stroke.before == game.state.moved(0, (0.558, 1.75))
    assert stroke.shot == NOISY.perturb(BREAK.shot, SEEDS.noise_seed, 0)
    assert stroke.result.final == simulate(TABLE, stroke.before, stroke.shot).final
    assert stroke.ruling == RULES.apply(game, BREAK, stroke.result.facts, stroke.result.final)
    assert stroke.game == stroke.ruling.game
    assert stroke.game.stroke == 1


def test_the_same_stroke_twice_is_the_same_stroke_with_and_without_trace():
    game = start_game(RULES, SEEDS)
    first = play_stroke(RULES, game, BREAK, SEEDS, NOISY)
    second = play_stroke(RULES, game, BREAK, SEEDS, NOISY, trace=False)
    assert (first.shot, first.ruling, first.game) == (second.shot, second.ruling, second.game)
    with pytest.raises(ValueError, match="no trace"):
        _ = second.result.events


def test_without_noise_the_shot_is_played_as_meant():
    stroke = play_stroke(RULES, start_game(RULES, SEEDS), BREAK, SEEDS, EXACT)
    assert stroke.shot == BREAK.shot


def test_all_refusals_come_at_once_and_no_noise_is_drawn(monkeypatch):
    """R37, R39: refused before the stroke, with every reason; the game is as it was."""
    game = start_game(RULES, SEEDS)
    monkeypatch.setattr(NoiseModel, "perturb", lambda *_: pytest.fail("noise was drawn"))
    bad = Action(Shot(9.0, 270.0, 5.0), call=Call(3, 0), cue_ball=(0.558, 0.3))
    with pytest.raises(Refused) as caught:
        play_stroke(RULES, game, bad, SEEDS, NOISY)
    fields = {refusal.field for refusal in caught.value.refusals}
    assert fields == {"call", "cue_ball"}
    assert (caught.value.field, caught.value.value) == (
        caught.value.refusals[0].field,
        caught.value.refusals[0].value,
    )
    assert all(refusal.words in str(caught.value) for refusal in caught.value.refusals)


def test_a_refusal_crosses_process_borders():
    game = start_game(RULES, SEEDS)
    with pytest.raises(Refused) as caught:
        play_stroke(RULES, game, Action(decision=Decision.BALL_IN_HAND), SEEDS, NOISY)
    assert pickle.loads(pickle.dumps(caught.value)).refusals == caught.value.refusals


def test_refused_strokes_do_not_buy_other_noise():
    """Known error of the historical server: an impossible shot resubmitted drew fresh noise."""
    game = start_game(RULES, SEEDS)
    expected = play_stroke(RULES, game, BREAK, SEEDS, NOISY).shot
    for _ in range(5):
        with pytest.raises(Refused):
            play_stroke(RULES, game, replace(BREAK, cue_ball=(0.558, 1.0)), SEEDS, NOISY)
    assert play_stroke(RULES, game, BREAK, SEEDS, NOISY).shot == expected


def test_noise_that_makes_a_stroke_impossible_is_a_miscue():
    """R39: a foul, the balls stay, the index is used up."""
    game = position({0: (0.558, 1.2), 3: (0.558, 0.6), 8: (0.2, 0.3), 12: (0.9, 0.3)})
    edge = Action(Shot(3.0, 270.0, 5.0, a=28.4), call=Call(3, 0))
    strokes = [play_stroke(RULES, replace(game, stroke=n), edge, SEEDS, NoiseModel(5.0)) for n in range(12)]
    miscues = [stroke for stroke in strokes if stroke.result.status == Status.TIP_OFF_BALL]
    assert 0 < len(miscues) < len(strokes)
    for stroke in miscues:
        assert stroke.ruling.fouls[0] == "R39"
        assert stroke.game.state.removed(0) == game.state.removed(0)
        assert stroke.game.turn == 1
        assert stroke.game.cue_ball_in_hand is CueBallArea.ANYWHERE
        assert stroke.game.stroke == stroke.index + 1


def test_an_intended_impossible_stroke_is_refused_instead():
    """R39, the other half."""
    game = position({0: (0.558, 1.2), 3: (0.558, 0.6), 8: (0.2, 0.3)})
    off = Action(Shot(3.0, 270.0, 5.0, a=28.6), call=Call(3, 0))
    with pytest.raises(Refused) as caught:
        play_stroke(RULES, game, off, SEEDS, NoiseModel(5.0))
    assert [refusal.rule for refusal in caught.value.refusals] == ["R39"]


def test_a_decision_plays_nothing():
    soft = play_stroke(RULES, start_game(RULES, SEEDS), SOFT_BREAK, SEEDS, EXACT)
    assert soft.game.phase is Phase.DECISION
    chosen = play_stroke(RULES, soft.game, Action(decision=soft.game.decisions[0]), SEEDS, NOISY)
    assert (chosen.index, chosen.shot, chosen.result) == (None, None, None)
    assert chosen.before == soft.game.state
    assert chosen.game.stroke == soft.game.stroke


def test_every_rack_of_a_game_has_a_seed_of_its_own():
    """R12: an illegal break, racked again and again; the racks come from the rack seed in order."""
    game = start_game(RULES, SEEDS)
    assert game.state == rack(TABLE, seed=SEEDS.rack(0))
    for number in (1, 2, 3):
        game = play_stroke(RULES, game, SOFT_BREAK, SEEDS, EXACT).game
        stroke = play_stroke(RULES, game, Action(decision=Decision.RERACK_AND_BREAK), SEEDS, EXACT)
        assert stroke.ruling.rerack
        game = stroke.game
        assert game.phase is Phase.BREAK
        assert (game.rack, game.stroke) == (number, number)
        assert game.state == rack(TABLE, seed=SEEDS.rack(number))


def test_noise_goes_on_after_a_new_rack():
    """The index counts strokes of the whole game, so that no noise comes twice."""
    game, shots = start_game(RULES, SEEDS), []
    for _ in range(3):
        broken = play_stroke(RULES, game, SOFT_BREAK, SEEDS, NOISY)
        shots.append(broken.shot)
        if broken.game.phase is not Phase.DECISION:
            pytest.fail(f"a soft break was legal: {broken.ruling.words}")
        game = play_stroke(RULES, broken.game, Action(decision=Decision.RERACK_AND_BREAK), SEEDS, NOISY).game
    assert len(set(shots)) == 3
    assert shots == [NOISY.perturb(SOFT_BREAK.shot, SEEDS.noise_seed, n) for n in range(3)]


def test_ball_in_hand_is_placed_where_the_shooter_wants():
    game = position(
        {3: (0.3, 0.3), 8: (0.8, 0.3), 12: (0.9, 1.9)},
        cue_ball_in_hand=CueBallArea.ANYWHERE,
        groups=(Group.SOLIDS, Group.STRIPES),
    )
    action = Action(Shot(2.0, 225.0, 5.0), call=Call(3, 0), cue_ball=(0.5, 0.5))
    stroke = play_stroke(RULES, game, action, SEEDS, EXACT)
    assert stroke.before.position(0) == (0.5, 0.5)
    assert stroke.ruling.made
    assert stroke.result.facts.pocket[3] == 0


def test_negative_zeros_do_not_reach_the_record():
    """Canonical JSON writes -0 as 0; what is recorded must be what was played."""
    action = Action(Shot(9.0, 270.0, 5.0, -0.0, -0.0), cue_ball=(0.558, 1.75))
    stroke = play_stroke(RULES, start_game(RULES, SEEDS), action, SEEDS, EXACT)
    assert repr(stroke.action.shot) == repr(Shot(9.0, 270.0, 5.0, 0.0, 0.0))
    assert repr(stroke.shot) == repr(stroke.action.shot)


def test_conceding_ends_the_game():
    """R48."""
    stroke = play_stroke(RULES, start_game(RULES, SEEDS), Action(decision=Decision.CONCEDE), SEEDS, NOISY)
    assert stroke.game.is_over
    assert stroke.game.outcome.winner == 1


def test_nothing_that_yields_noise_is_in_the_game_or_the_stroke():
    stroke = play_stroke(RULES, start_game(RULES, SEEDS), BREAK, SEEDS, NOISY)
    text = f"{stroke!r} {stroke.game.to_dict()} {stroke.ruling.to_dict()}"
    raw = pickle.dumps((stroke.game, stroke.ruling, stroke.action, stroke.shot))
    for secret in (SEEDS.noise, SEEDS.noise_seed, SEEDS.racks, SEEDS.rack(0), MatchSeed.of(11).secret):
        assert secret not in raw
        assert secret.hex() not in text
        assert repr(secret) not in text


def test_whoever_searches_ahead_brings_seeds_of_their_own():
    own = GameSeeds(bytes(32), bytes(32))
    game = start_game(RULES, SEEDS)
    assert play_stroke(RULES, game, BREAK, own, NOISY).shot != play_stroke(RULES, game, BREAK, SEEDS, NOISY).shot
