"""`EightBall.begin_from`: games that begin in the middle (CONTRACT: a game from a position is unrated)."""

import json
from dataclasses import replace

import pytest
from support.situations import RULES, situation

from client.local_game import play_match
from physics import Facts, Shot, rack
from referee import Action, CueBallArea, Decision, EightBall, Game, Group, InvalidAction, InvalidGame, Phase
from referee.play import MatchSeed, NoiseModel
from referee.record import canonical, verify_record
from referee.rules.breaks import OFFERED

BALLS = {0: (0.5, 1.7), 3: (0.4, 0.6), 8: (0.9, 0.4)}
GROUPS = (Group.SOLIDS, Group.STRIPES)


def test_a_game_in_the_middle_begins_with_its_counters_at_zero():
    running = situation(BALLS, groups=GROUPS, stroke=17, rack=2, visit_strokes=3, dry_visits=5, replays=1)
    assert RULES.begin_from(running) == situation(BALLS, groups=GROUPS)


def test_beginning_again_changes_nothing():
    begun = RULES.begin_from(situation(BALLS, cue_ball_in_hand=CueBallArea.ANYWHERE))
    assert RULES.begin_from(begun) == begun


@pytest.mark.parametrize("rule", list(OFFERED))
def test_every_choice_after_a_break_can_be_the_beginning(rule):
    balls = {ball: place for ball, place in BALLS.items() if ball != 8 or rule not in ("R13", "R14")}
    balls = {ball: place for ball, place in balls.items() if ball != 0 or rule != "R14"}
    game = RULES.begin_from(situation(balls, Phase.DECISION, choice=rule))
    assert game.decisions == OFFERED[rule]
    for decision in game.decisions:
        assert RULES.check(game, Action(decision=decision)) == ()


def test_after_a_scratch_the_position_cannot_be_accepted():
    """R12a: after a scratch there is no position to accept."""
    game = RULES.begin_from(situation({3: (0.4, 0.6), 8: (0.9, 0.4)}, Phase.DECISION, choice="R12a"))
    assert Decision.ACCEPT_TABLE not in game.decisions


def test_a_rack_can_be_the_beginning():
    state = rack(RULES.table, "eight_ball", seed=3)
    game = Game(state, Phase.BREAK, 1, 1, cue_ball_in_hand=CueBallArea.KITCHEN)
    assert RULES.begin_from(game) == game


@pytest.mark.parametrize(
    ("game", "field"),
    [
        (None, "game"),
        (situation(BALLS, turn=2), "turn"),
        (situation(BALLS, turn=True), "turn"),
        (situation(BALLS, Phase.OVER), "phase"),
        (situation(BALLS, Phase.RERACK), "phase"),
        (situation(BALLS | {3: (-1.0, 0.6)}), "balls.3"),
        (situation({0: (0.5, 1.7), 3: (0.4, 0.6)}), "balls"),
        (situation({3: (0.4, 0.6), 8: (0.9, 0.4)}), "balls"),
        (situation(BALLS, Phase.BREAK, cue_ball_in_hand=CueBallArea.KITCHEN), "balls"),
        (situation(BALLS, choice="R13"), "choice"),
        (situation(BALLS, Phase.DECISION), "choice"),
        (situation(BALLS, Phase.DECISION, choice="R99"), "choice"),
        (situation(BALLS, Phase.DECISION, choice="R13"), "balls"),
        (situation({0: (0.5, 1.7), 3: (0.4, 0.6)}, Phase.DECISION, choice="R14"), "balls"),
        (situation({3: (0.4, 0.6), 8: (0.9, 0.4)}, Phase.DECISION, choice="R12"), "balls"),
        (situation(BALLS, Phase.DECISION, choice="R12", groups=GROUPS), "groups"),
        (situation(BALLS, Phase.DECISION, choice="R12", cue_ball_in_hand=CueBallArea.KITCHEN), "cue_ball_in_hand"),
        (situation(BALLS, groups=("solids", "solids")), "game"),
        (situation(BALLS, phase="play"), "game"),  # type: ignore[arg-type]
    ],
)
def test_what_cannot_be_played_on_from_is_named(game, field):
    with pytest.raises(InvalidGame) as caught:
        RULES.begin_from(game)
    assert caught.value.field == field


def concede(_view):
    return Action(decision=Decision.CONCEDE)


def test_every_second_game_exchanges_the_seats_and_every_record_verifies():
    position = RULES.begin_from(situation(BALLS, groups=GROUPS))
    chairs = lambda *_: (concede, concede)  # noqa: E731
    first, second = play_match(RULES, chairs, MatchSeed.of(1), 2, NoiseModel(), position=position)
    assert first.header.start == position
    assert second.header.start == replace(position, turn=1, breaker=1, groups=GROUPS[::-1])
    for game in (first, second):
        assert verify_record(game.record()).ok


def test_a_given_position_that_is_none_is_no_record():
    """The header of a given game is believed only as far as the referee would let it begin."""
    position = RULES.begin_from(situation(BALLS))
    chairs = lambda *_: (concede, concede)  # noqa: E731
    (game,) = play_match(RULES, chairs, MatchSeed.of(1), 1, NoiseModel(), position=position)
    header, *rest = game.record()
    forged = header.replace('"8":[0.9,0.4]', '"8":[9.9,0.4]')
    assert forged != header
    assert "balls.8" in str(verify_record([forged, *rest]))
    racked = json.loads(header) | {"position": None}
    assert verify_record([canonical(racked), *rest]).difference.field.startswith("commitment")


A_BREAK = Action(shot=Shot(9.0, 270.0, 10.0))


@pytest.mark.parametrize(
    ("make", "error", "field"),
    [
        (lambda: EightBall(None), InvalidGame, "table"),
        (lambda: EightBall(RULES.table, 3), InvalidGame, "limits"),  # type: ignore[arg-type]
        (lambda: RULES.new_game(7, breaker=True), InvalidGame, "breaker"),
        (lambda: RULES.check(None, Action(decision=Decision.CONCEDE)), InvalidGame, "game"),
        (lambda: RULES.apply(RULES.new_game(7), None, None, None), InvalidAction, "action"),
        (lambda: RULES.apply(None, Action(decision=Decision.CONCEDE)), InvalidGame, "game"),
        (lambda: RULES.apply(RULES.new_game(7), A_BREAK, None, None), InvalidAction, "facts"),
        (lambda: RULES.apply(RULES.new_game(7), A_BREAK, Facts.none(), {}), InvalidAction, "final"),  # type: ignore[arg-type]
    ],
)
def test_misuse_names_the_field(make, error, field):
    with pytest.raises(error) as caught:
        make()
    assert caught.value.field == field
