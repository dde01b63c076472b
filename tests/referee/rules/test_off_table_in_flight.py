"""R16, R32, R36, R45 and WPA 8.1, 8.4, 8.5 by strokes really played: on a table that flies, balls leave it."""

from typing import Any

from support.situations import SOLIDS, situation

import physics
from physics.shot import Shot
from referee.game import Action, Call, Decision, EndReason, Game, Phase, Ruling
from referee.rules import EightBall

FLYING = physics.Table.nine_foot().replace(flight=True)
RULES = EightBall(FLYING)

OFF = {0: (0.333, 0.721), 3: (0.159, 0.83), 8: (0.9, 0.5), 11: (0.9, 0.9)}
OVER_THE_RAIL = Shot(9.5, 146.9, 10.0, 0.0, -4.0)
"""Ball 3 is pressed onto the cloth and hops over the west rail; the cue ball bounces on that rail and comes back."""


def play(game: Game, shot: Shot, call: Call | None = None) -> tuple[physics.Result, Ruling]:
    """One stroke, simulated, and the ruling on it."""
    result = physics.simulate(FLYING, game.state, shot)
    assert result.status is physics.Status.AT_REST
    if call is None and game.phase is not Phase.BREAK:
        call = Call(3, 1)
    return result, RULES.apply(game, Action(shot=shot, call=call), result.facts, result.final)


def kinds(result: physics.Result, ball: int) -> list[str]:
    return [event.kind.value for event in result.events if ball in (event.ball, event.other)]


def named(ball: int) -> dict[int, Any]:
    """The same scene with another object ball in the place of ball 3."""
    others = {number: place for number, place in OFF.items() if number not in (3, ball)}
    return others | {ball: OFF[3], (3 if ball != 3 else 12): (0.4, 2.0)}


def test_object_ball_off_the_table():
    """R36: a foul, with the event that proves it; the ball stays out."""
    result, ruling = play(situation(named(3), groups=SOLIDS), OVER_THE_RAIL)
    event = result.events[result.facts.off_table[3]]
    assert (event.kind, event.ball) == ("off_table", 3)
    assert ruling.fouls == ("R36",)
    assert ruling.evidence[0].events == (event.index,)
    assert 3 not in ruling.game.state.balls


BREAK = {
    0: (0.425, 0.779),
    1: (0.18, 0.727),
    3: (0.936, 0.317),
    4: (1.138, 1.703),
    5: (0.122, 2.102),
    6: (1.168, 2.102),
    7: (0.061, 1.209),
    8: (0.728, 2.226),
}


def test_object_ball_off_the_table_on_a_legal_break():
    """R16: ball 6 is pocketed, ball 1 leaves the table: a foul, the opponent accepts or has ball in hand."""
    game = situation(BREAK, Phase.BREAK)
    result, ruling = play(game, Shot(4.2, -167.5, 11.0, 0.0, 4.0))
    assert result.facts.pocketed[6] >= 0
    assert result.facts.off_table[1] >= 0
    assert ruling.rules[0] == "R16"
    assert ruling.fouls == ("R36",)
    assert ruling.game.decisions == (Decision.ACCEPT_TABLE, Decision.BALL_IN_HAND)
    assert 1 not in ruling.game.state.balls


def test_eight_off_the_table_loses():
    """R45."""
    _, ruling = play(situation(named(8), groups=SOLIDS), OVER_THE_RAIL)
    outcome = ruling.game.outcome
    assert outcome is not None
    assert (outcome.winner, outcome.reason) == (1, EndReason.EIGHT_OFF_TABLE)


def test_the_cue_ball_bounces_on_the_rail_and_back():
    """WPA 8.5: no foul of the cue ball; it came to rest on the cloth. 8.1: the top of the rail is part of the rail."""
    result, ruling = play(situation(named(3), groups=SOLIDS), OVER_THE_RAIL)
    assert "rail_top" in kinds(result, 0)
    assert "R32" not in ruling.fouls
    assert result.final.position(0) is not None
    assert result.facts.cushion_after_contact[0] == next(
        event.index for event in result.events if event.kind in ("rail_top", "rail_collision") and event.ball == 0
    )


def test_cue_ball_off_the_table():
    """R32: as good as pocketed."""
    result, ruling = play(
        situation({0: (0.3, 1.0), 3: (0.9, 1.2), 8: (0.9, 0.5)}, groups=SOLIDS), Shot(6.0, 180.0, 40.0)
    )
    assert kinds(result, 0)[-1] == "off_table"
    assert ruling.fouls[0] == "R32"
    assert "left the table" in ruling.words
    assert ruling.allowed.must_place


def test_a_ball_driven_off_counts_as_driven_to_a_rail():
    """WPA 8.4: with ball 3 off the table and no cushion reached by any other, R35 is not cited besides R36."""
    game = situation(named(3), groups=SOLIDS)
    result, _ = play(game, OVER_THE_RAIL)
    never = (-1,) * 16
    facts = physics.Facts.none()
    bare = type(facts)(
        **{name: getattr(result.facts, name) for name in facts.__slots__}
        | {"cushion": never, "cushion_after_contact": never}
    )
    ruling = RULES.apply(game, Action(shot=OVER_THE_RAIL, call=Call(3, 1)), bare, result.final)
    assert ruling.fouls == ("R36",)


def test_a_jump_over_a_ball_is_legal():
    """The cue ball clears ball 11 by a jump, hits ball 3 first, and drives it to a cushion: no foul at all."""
    balls = {0: (0.6, 0.9), 11: (0.6, 1.1), 3: (0.6, 1.9), 8: (0.2, 0.5)}
    shot = Shot(3.2, 90.0, 45.0, 0.0, 20.0)
    result, ruling = play(situation(balls, groups=SOLIDS), shot, Call(3, 3))
    assert result.facts.struck_first == (3,)
    assert "landing" in kinds(result, 0)
    assert kinds(result, 11) == []
    assert ruling.fouls == ()
