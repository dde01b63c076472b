"""Putting the rules together: from a stroke and its fouls to the game that follows."""

from typing import NamedTuple

from physics.state import TableState
from referee.game import CueBallArea, Decision, Evidence, Game, Group, Outcome, Phase
from referee.rules import breaks, calls
from referee.rules.ending import end_by_eight
from referee.rules.fouls import eight_first_on_open_table
from referee.rules.spotting import spot, spotted_balls
from referee.rules.stalemate import dry_visits_after
from referee.rules.stroke import Finding, Stroke

Choice = tuple[str, tuple[Decision, ...]]


class Judgement(NamedTuple):
    """The rules that decided, what proves them, and the game that follows."""

    rules: tuple[str, ...]
    evidence: Finding
    game: Game
    made: bool = False


def judge(stroke: Stroke, found: Finding) -> Judgement:
    """What follows from a stroke with the fouls ``found``."""
    return judge_break(stroke, found) if stroke.game.phase is Phase.BREAK else judge_play(stroke, found)


def judge_break(stroke: Stroke, found: Finding) -> Judgement:
    """R8 to R17."""
    evidence = (*found, *breaks.must_strike_a_ball(stroke), breaks.break_evidence(stroke))
    if stroke.eight_pocketed and (choice := breaks.choice_after_eight(found)):
        decider = stroke.opponent if found else stroke.shooter
        proof = breaks.eight_on_break(stroke, choice[0])
        return Judgement((choice[0],), evidence + proof, _ask(stroke, decider, choice, stroke.final))
    state, spotting = _spotted(stroke)
    if not breaks.legal_break(stroke):
        choice = breaks.choice_after_illegal_break(found)
        return Judgement((choice[0], *spotting), evidence, _ask(stroke, stroke.opponent, choice, state))
    if breaks.scratch_on_break(found):
        game = _go_on(stroke, stroke.opponent, state, area=CueBallArea.KITCHEN)
        return Judgement(("R15", *spotting), evidence, game)
    if found:
        choice = breaks.choice_after_foul(found)
        return Judgement((choice[0], *spotting), evidence, _ask(stroke, stroke.opponent, choice, state))
    if proof := breaks.breaker_continues(stroke):
        return Judgement(("R10", "R18"), evidence + proof, _go_on(stroke, stroke.shooter, state))
    evidence += breaks.breaker_passes(stroke)
    return Judgement(("R11", "R18"), evidence, _go_on(stroke, stroke.opponent, state))


def judge_play(stroke: Stroke, found: Finding) -> Judgement:
    """R18 to R47, every stroke but the break."""
    if ending := end_by_eight(stroke, found):
        outcome, proof = ending
        made = outcome.winner == stroke.shooter
        return Judgement((outcome.rule,), (*proof, *found), _end(stroke, outcome), made)
    if found:
        return _foul(stroke, found)
    continues = calls.shooter_continues(stroke, found)
    evidence = (
        *continues,
        *calls.fixes_groups(stroke, found),
        *calls.safety_passes_turn(stroke),
        *calls.called_ball_elsewhere(stroke),
        *calls.called_ball_missed(stroke),
        *calls.other_balls_pocketed(stroke),
    )
    turn = stroke.shooter if continues else stroke.opponent
    game = _go_on(stroke, turn, stroke.final, groups=calls.groups_after(stroke, found))
    return Judgement((), evidence, game, bool(continues))


def _foul(stroke: Stroke, found: Finding) -> Judgement:
    """A foul that does not end the game: ball in hand anywhere, an open table stays open (R22)."""
    rules = ("R41", *(("R22",) if calls.table_stays_open(stroke, found) else ()))
    rules += ("R47",) if stroke.on_eight else ()
    evidence = (*found, *eight_first_on_open_table(stroke), *calls.other_balls_pocketed(stroke))
    game = _go_on(stroke, stroke.opponent, stroke.final, groups=stroke.game.groups, area=CueBallArea.ANYWHERE)
    return Judgement((found[0].rule, *rules), evidence, game)


def _spotted(stroke: Stroke) -> tuple[TableState, tuple[str, ...]]:
    """The table after the break with the 8 back on it, and the rules that put it there."""
    state = stroke.final
    balls = spotted_balls(stroke)
    for ball in balls:
        state = spot(stroke.table, state, ball)
    return state, (*(("R14",) if stroke.eight_pocketed else ()), "R30", "R31") if balls else ()


def _go_on(
    stroke: Stroke,
    turn: int,
    state: TableState,
    *,
    groups: tuple[Group, Group] | None = None,
    area: CueBallArea | None = None,
) -> Game:
    """Play goes on: ``turn`` shoots next."""
    return _next(stroke, turn, state, Phase.PLAY, groups=groups, area=area)


def _ask(stroke: Stroke, decider: int, choice: Choice, state: TableState) -> Game:
    """The break leaves a choice to ``decider``."""
    return _next(stroke, decider, state, Phase.DECISION, choice=choice)


def _end(stroke: Stroke, outcome: Outcome) -> Game:
    """The stroke decided the game."""
    groups = stroke.game.groups
    return _next(stroke, stroke.shooter, stroke.final, Phase.OVER, groups=groups, outcome=outcome)


def _next(
    stroke: Stroke,
    turn: int,
    state: TableState,
    phase: Phase,
    *,
    groups: tuple[Group, Group] | None = None,
    area: CueBallArea | None = None,
    choice: tuple[str | None, tuple[Decision, ...]] = (None, ()),
    outcome: Outcome | None = None,
) -> Game:
    game = stroke.game
    rule, decisions = choice
    return Game(
        state=state,
        phase=phase,
        turn=turn,
        breaker=game.breaker,
        groups=groups,
        cue_ball_in_hand=area,
        decisions=decisions,
        choice=rule,
        stroke=game.stroke + 1,
        rack=game.rack,
        visit_strokes=game.visit_strokes + 1 if turn == game.turn else 0,
        dry_visits=dry_visits_after(stroke, turn),
        replays=game.replays,
        outcome=outcome,
    )


def rules_cited(rules: tuple[str, ...], evidence: tuple[Evidence, ...]) -> tuple[str, ...]:
    """Every rule id once: those that decided first, then those only proved."""
    return tuple(dict.fromkeys((*rules, *(one.rule for one in evidence))))
