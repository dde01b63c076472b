"""R49: visits without a pocketed ball, replays, the stroke limit; every stroke simulated."""

from collections.abc import Iterator

import pytest
from support.situations import RULES, SOLIDS, TABLE, Balls, play, pot, situation, stroke

from referee.errors import InvalidGame
from referee.game import EndReason, Game, Phase
from referee.rules import EightBall, Limits

BALLS = {0: (0.6, 1.118), 3: (0.9, 1.118), 5: (0.8, 0.4), 8: (0.3, 0.5), 11: (0.5, 0.4)}
E = 4


def nudge(game: Game, rules: EightBall = RULES) -> Game:
    """The weakest of strokes: no ball struck, a foul, a visit without a ball."""
    balls: Balls = {ball: tuple(game.state.positions[ball].tolist()) for ball in game.state.balls}
    call = None if game.phase is Phase.BREAK else "safety"
    return play(game, stroke(balls, 90.0, 0.001), call, rules=rules).game


def visits(game: Game, rules: EightBall = RULES) -> Iterator[Game]:
    while not game.is_over and game.phase is not Phase.RERACK:
        game = nudge(game, rules)
        yield game


def test_the_24th_dry_visit_replays_the_rack():
    """R49, fouls included; the original breaker breaks again."""
    games = list(visits(situation(BALLS, turn=1, breaker=1, groups=SOLIDS)))
    assert len(games) == 24
    assert [game.dry_visits for game in games[:3]] == [1, 2, 3]
    last = games[-1]
    assert (last.phase, last.turn, last.replays, last.dry_visits, last.groups) == (
        Phase.RERACK,
        1,
        1,
        0,
        None,
    )
    again = RULES.rerack(last, 5)
    assert (again.phase, again.turn, again.replays, again.stroke) == (Phase.BREAK, 1, 1, 24)


def test_after_two_replays_the_next_stalemate_draws():
    """R49."""
    game = situation(BALLS, groups=SOLIDS)
    for replays in (1, 2):
        *_, game = visits(game)
        assert (game.phase, game.replays) == (Phase.RERACK, replays)
        racked = RULES.rerack(game, replays)
        game = situation(BALLS, groups=SOLIDS, replays=racked.replays, rack=racked.rack, stroke=racked.stroke)
    *_, game = visits(game)
    assert game.outcome is not None
    assert (game.outcome.winner, game.outcome.reason, game.outcome.rule) == (None, EndReason.STALEMATE, "R49")


def test_ruling_says_so():
    """R49 leads the ruling and asks for a rack."""
    game = situation(BALLS, groups=SOLIDS, dry_visits=23)
    played = play(game, stroke(BALLS, 90.0, 0.001), "safety")
    assert played.ruling.rules[0] == "R49"
    assert played.ruling.rerack
    assert played.ruling.fouls == ("R34",)
    assert "racked again" in played.ruling.words


def test_a_pocketed_ball_starts_the_count_again():
    """R49: even pocketed on a foul, and also in a visit that ends with a miss."""
    game = situation(BALLS, groups=SOLIDS, dry_visits=20)
    scratched = play(game, pot(BALLS, 3, E, v=2.0, b=15.0), (3, E))
    assert scratched.ruling.fouls == ("R32",)
    assert scratched.game.dry_visits == 0
    made = play(game, pot(BALLS, 3, E, v=1.5), (3, E)).game
    assert (made.turn, made.dry_visits, made.visit_strokes) == (0, 0, 1)
    missed = nudge(made)
    assert (missed.turn, missed.dry_visits, missed.visit_strokes) == (1, 0, 0)
    assert nudge(missed).dry_visits == 1


def test_a_scratch_is_no_progress():
    """R49: the cue ball does not count as a ball pocketed."""
    balls = BALLS | {0: (0.9, 2.0)}
    played = play(situation(balls, groups=SOLIDS, dry_visits=3), stroke(balls, 45.0, 2.0), "safety")
    assert "R32" in played.ruling.fouls
    assert played.game.dry_visits == 4


def test_stroke_limit_draws():
    """R49: its own end reason, re-racks included in the count."""
    played = play(situation(BALLS, groups=SOLIDS, stroke=399), stroke(BALLS, 90.0, 0.001), "safety")
    assert played.game.outcome is not None
    assert (played.game.outcome.winner, played.game.outcome.reason) == (None, EndReason.STROKE_LIMIT)
    assert played.ruling.rules[0] == "R49"
    assert nudge(situation(BALLS, groups=SOLIDS, stroke=398)).outcome is None


def test_a_win_on_the_last_stroke_is_a_win():
    """R46 before R49."""
    balls = {0: (0.6, 1.118), 8: (0.9, 1.118), 11: (0.5, 0.4)}
    game = situation(balls, groups=SOLIDS, stroke=399, dry_visits=23)
    outcome = play(game, pot(balls, 8, E, v=1.5), (8, E)).game.outcome
    assert outcome is not None
    assert outcome.reason is EndReason.EIGHT_MADE


def test_limits_are_configurable():
    """R49."""
    rules = EightBall(TABLE, Limits(dry_visits=2, replays=0, strokes=50))
    *_, last = visits(situation(BALLS, groups=SOLIDS), rules)
    assert last.stroke == 2
    assert last.outcome is not None
    assert last.outcome.reason is EndReason.STALEMATE


@pytest.mark.parametrize(("field", "value"), [("dry_visits", 0), ("replays", -1), ("strokes", 1.5), ("strokes", True)])
def test_bad_limits(field, value):
    with pytest.raises(InvalidGame, match=field):
        Limits(**{field: value})
