"""R42 to R48: how games end, each stroke simulated."""

import pytest
from support.situations import RULES, SOLIDS, Played, play, pot, situation, stroke

from physics import Shot
from referee.errors import InvalidAction, InvalidGame
from referee.game import Action, Decision, EndReason, Game, Phase
from referee.rules.ending import FROM_OUTSIDE

E, W = 4, 1
ON_EIGHT = {0: (0.6, 1.118), 8: (0.9, 1.118), 11: (0.5, 0.4), 12: (0.3, 1.9)}
"""Seat 0's solids are gone; the 8 is straight into E."""
TOO_EARLY = ON_EIGHT | {3: (0.3, 0.3)}
IN_LINE = {0: (0.45, 1.118), 3: (0.7, 1.118), 8: (1.0, 1.118), 11: (0.5, 0.4)}
"""The last solid drives the 8 into E and rolls in after it."""


def on_eight() -> Game:
    return situation(ON_EIGHT, groups=SOLIDS)


def assert_over(played: Played, winner: int, reason: EndReason, rule: str) -> None:
    outcome = played.game.outcome
    assert outcome is not None
    assert (outcome.winner, outcome.reason, outcome.rule) == (winner, reason, rule)
    assert played.game.phase is Phase.OVER
    assert played.ruling.rules[0] == rule
    assert played.ruling.allowed.actions == ()
    assert 8 not in played.game.state.balls


def test_eight_made_wins():
    """R46."""
    played = play(on_eight(), pot(ON_EIGHT, 8, E, v=1.5), (8, E))
    assert_over(played, 0, EndReason.EIGHT_MADE, "R46")
    assert played.proof("R46")[0].ball == 8
    assert played.ruling.made


def test_eight_with_a_scratch_loses():
    """R42."""
    played = play(on_eight(), pot(ON_EIGHT, 8, E, v=2.0, b=15.0), (8, E))
    assert played.ruling.fouls == ("R32",)
    assert_over(played, 1, EndReason.EIGHT_WITH_FOUL, "R42")
    assert not played.ruling.made


def test_eight_before_the_group_is_cleared_loses():
    """R43 without another foul: the 3 struck first, then the 8 falls."""
    balls = IN_LINE | {5: (0.2, 0.2)}
    played = play(situation(balls, groups=SOLIDS), pot(balls, 3, E, v=1.2), (3, E))
    assert played.ruling.fouls == ()
    assert_over(played, 1, EndReason.EIGHT_TOO_EARLY, "R43")


def test_eight_on_the_clearing_stroke_loses():
    """R43: the last solid is made as called, and the 8 with it."""
    played = play(situation(IN_LINE, groups=SOLIDS), pot(IN_LINE, 3, E, v=1.4, b=-8.0), (3, E))
    assert [ball for ball, _, _ in played.facts.pocketed_in_order] == [8, 3]
    assert_over(played, 1, EndReason.EIGHT_TOO_EARLY, "R43")


def test_eight_on_an_open_table_loses():
    """R43."""
    played = play(situation(IN_LINE), pot(IN_LINE, 3, E, v=1.2), (3, E))
    assert played.ruling.fouls == ()
    assert_over(played, 1, EndReason.EIGHT_TOO_EARLY, "R43")


def test_eight_too_early_and_struck_first():
    """R42 leads, R43 is cited too."""
    played = play(situation(TOO_EARLY, groups=SOLIDS), pot(TOO_EARLY, 8, E, v=1.5), (3, E))
    assert played.ruling.fouls == ("R33",)
    assert_over(played, 1, EndReason.EIGHT_WITH_FOUL, "R42")
    assert "R43" in played.ruling.rules


def test_eight_in_an_uncalled_pocket_loses():
    """R44, known error: the historical referee gave the game to the shooter."""
    played = play(on_eight(), pot(ON_EIGHT, 8, E, v=1.5), (8, W))
    assert played.ruling.fouls == ()
    assert_over(played, 1, EndReason.EIGHT_NOT_AS_CALLED, "R44")


def test_eight_on_a_safety_loses():
    """R44, known error."""
    played = play(on_eight(), pot(ON_EIGHT, 8, E, v=1.5), "safety")
    assert_over(played, 1, EndReason.EIGHT_NOT_AS_CALLED, "R44")


def test_foul_on_the_eight_is_ball_in_hand():
    """R47: the 8 stays up."""
    played = play(on_eight(), stroke(ON_EIGHT, 90.0, 0.3), (8, E))
    assert played.ruling.fouls == ("R34",)
    assert "R47" in played.ruling.rules
    assert (played.game.outcome, played.game.turn, played.game.cue_ball_in_hand) == (None, 1, "anywhere")


def test_missing_the_eight_passes_the_turn():
    """R28 on the 8: no foul, no end."""
    played = play(on_eight(), stroke(ON_EIGHT, 6.0, 1.5), (8, E))
    assert played.ruling.fouls == ()
    assert (played.game.outcome, played.game.turn) == (None, 1)


def test_concession_is_always_allowed():
    """R48, in every phase in which a player is asked."""
    illegal = play(RULES.new_game(3), pot_nothing(), None).game
    for game in (RULES.new_game(3), on_eight(), illegal):
        action = Action(decision=Decision.CONCEDE)
        assert RULES.check(game, action) == ()
        outcome = RULES.apply(game, action).game.outcome
        assert outcome is not None
        assert (outcome.winner, outcome.reason) == (1 - game.turn, EndReason.CONCESSION)


def pot_nothing() -> Shot:
    game = RULES.new_game(3)
    balls = {ball: tuple(game.state.positions[ball].tolist()) for ball in game.state.balls}
    return stroke(balls, 270.0, 0.5)


@pytest.mark.parametrize("reason", FROM_OUTSIDE)
@pytest.mark.parametrize("loser", [0, 1])
def test_ends_from_outside(reason, loser):
    """R48: each with its own reason."""
    ruling = RULES.end(on_eight(), reason, loser)
    assert ruling.game.outcome is not None
    assert ruling.game.outcome.to_dict() == {"winner": 1 - loser, "reason": reason.value, "rule": "R48"}
    assert ruling.rules == ("R48",)
    assert str(1 - loser) in ruling.words


def test_aborted_game_has_no_winner():
    """R48."""
    outcome = RULES.end(on_eight(), EndReason.ABORTED).game.outcome
    assert outcome is not None
    assert outcome.winner is None


@pytest.mark.parametrize(
    ("reason", "loser", "field"),
    [
        (EndReason.EIGHT_MADE, 0, "reason"),
        (EndReason.STALEMATE, None, "reason"),
        (EndReason.TIME_OUT, None, "loser"),
        (EndReason.TIME_OUT, 2, "loser"),
        (EndReason.ABORTED, 1, "loser"),
    ],
)
def test_impossible_ends_are_misuse(reason, loser, field):
    with pytest.raises(InvalidGame) as caught:
        RULES.end(on_eight(), reason, loser)
    assert caught.value.field == field


def test_game_that_is_over_takes_nothing_more():
    """R46 decided; strokes, decisions and further ends are refused."""
    game = play(on_eight(), pot(ON_EIGHT, 8, E, v=1.5), (8, E)).game
    for action in (Action(shot=stroke(ON_EIGHT, 0.0, 1.0), call="safety"), Action(decision=Decision.CONCEDE)):
        assert [one.rule for one in RULES.check(game, action)] == ["R46"]
        with pytest.raises(InvalidAction):
            RULES.apply(game, action)
    with pytest.raises(InvalidGame):
        RULES.end(game, EndReason.FORFEIT, 0)
