"""Putting the rules together: from a stroke and its fouls to the game that follows."""

from typing import NamedTuple

from physics.state import TableState
from referee.game import CueBallArea, Evidence, Game, Group, Outcome, Phase, RuleId
from referee.rules import breaks, calls
from referee.rules.ending import end_by_eight, foul_on_eight
from referee.rules.fouls import eight_first_on_open_table
from referee.rules.spotting import spot, spotted_balls
from referee.rules.stalemate import dry_visits_after
from referee.rules.stroke_facts import Finding, StrokeFacts


class Judgement(NamedTuple):
    """The rules that decided, what proves them, and the game that follows."""

    rules: tuple[str, ...]
    evidence: Finding
    game: Game
    made: bool = False


def judge(stroke: StrokeFacts, found: Finding) -> Judgement:
    """What follows from a stroke with the fouls ``found``."""
    return judge_break(stroke, found) if stroke.game.phase is Phase.BREAK else judge_play(stroke, found)


def judge_break(stroke: StrokeFacts, found: Finding) -> Judgement:
    """R8 to R17."""
    evidence = (*found, *breaks.must_strike_a_ball(stroke), breaks.break_evidence(stroke))
    if choice := breaks.eight_on_break(stroke, found) or breaks.eight_and_scratch_on_break(stroke, found):
        proof = breaks.eight_evidence(stroke, choice.rule)
        return Judgement((choice.rule,), evidence + proof, _ask(stroke, choice, stroke.final))
    state, spotting = _spotted(stroke)
    if choice := _choice(stroke, found):
        return Judgement((choice.rule, *spotting), evidence, _ask(stroke, choice, state))
    if breaks.scratch_on_break(stroke, found):
        game = _go_on(stroke, stroke.opponent, state, area=CueBallArea.KITCHEN)
        return Judgement((RuleId.R15, *spotting), evidence, game)
    continues = breaks.breaker_continues(stroke)
    turn = stroke.shooter if continues else stroke.opponent
    rules = (RuleId.R10 if continues else RuleId.R11, RuleId.R18)
    evidence += continues or breaks.breaker_passes(stroke)
    return Judgement(rules, evidence, _go_on(stroke, turn, state))


def _choice(stroke: StrokeFacts, found: Finding) -> breaks.Choice | None:
    """What the break leaves to the opponent's choice, the 8 apart."""
    return (
        breaks.illegal_break(stroke, found)
        or breaks.illegal_break_with_foul(stroke, found)
        or breaks.ball_off_on_break(stroke, found)
        or breaks.other_foul_on_break(stroke, found)
    )


def judge_play(stroke: StrokeFacts, found: Finding) -> Judgement:
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
        *_other_balls(stroke),
    )
    turn = stroke.shooter if continues else stroke.opponent
    game = _go_on(stroke, turn, stroke.final, groups=calls.groups_after(stroke, found))
    return Judgement((), evidence, game, bool(continues))


def _foul(stroke: StrokeFacts, found: Finding) -> Judgement:
    """A foul that does not end the game: ball in hand anywhere, an open table stays open (R22)."""
    rules = (RuleId.R41, *((RuleId.R22,) if calls.table_stays_open(stroke, found) else ()))
    rules += (RuleId.R47,) if foul_on_eight(stroke, found) else ()
    evidence = (*found, *eight_first_on_open_table(stroke), *_other_balls(stroke))
    game = _go_on(stroke, stroke.opponent, stroke.final, groups=stroke.game.groups, area=CueBallArea.ANYWHERE)
    return Judgement((found[0].rule, *rules), evidence, game)


def _other_balls(stroke: StrokeFacts) -> Finding:
    return calls.other_balls_on_open_table(stroke) or calls.other_balls_stay_down(stroke)


def _spotted(stroke: StrokeFacts) -> tuple[TableState, tuple[str, ...]]:
    """The table after the break with the 8 back on it, and the rules that put it there."""
    state = stroke.final
    balls = spotted_balls(stroke)
    for ball in balls:
        state = spot(stroke.table, state, ball)
    return state, (*((RuleId.R14,) if stroke.eight_pocketed else ()), RuleId.R30, RuleId.R31) if balls else ()


def _go_on(
    stroke: StrokeFacts,
    turn: int,
    state: TableState,
    *,
    groups: tuple[Group, Group] | None = None,
    area: CueBallArea | None = None,
) -> Game:
    """Play goes on: ``turn`` shoots next."""
    return next_game(stroke.game, turn, state, Phase.PLAY, bool(stroke.pocketed), groups=groups, area=area)


def _ask(stroke: StrokeFacts, choice: breaks.Choice, state: TableState) -> Game:
    """The break leaves a choice."""
    return next_game(stroke.game, choice.decider, state, Phase.DECISION, bool(stroke.pocketed), choice=choice)


def _end(stroke: StrokeFacts, outcome: Outcome) -> Game:
    """The stroke decided the game."""
    game, pocketed = stroke.game, bool(stroke.pocketed)
    return next_game(game, game.turn, stroke.final, Phase.OVER, pocketed, groups=game.groups, outcome=outcome)


def next_game(
    game: Game,
    turn: int,
    state: TableState,
    phase: Phase,
    pocketed: bool,
    *,
    groups: tuple[Group, Group] | None = None,
    area: CueBallArea | None = None,
    choice: breaks.Choice | None = None,
    outcome: Outcome | None = None,
) -> Game:
    """The game after one more stroke; ``pocketed`` says whether it pocketed an object ball."""
    return Game(
        state=state,
        phase=phase,
        turn=turn,
        breaker=game.breaker,
        groups=groups,
        cue_ball_in_hand=area,
        decisions=choice.decisions if choice else (),
        choice=choice.rule if choice else None,
        stroke=game.stroke + 1,
        rack=game.rack,
        visit_strokes=game.visit_strokes + 1 if turn == game.turn else 0,
        dry_visits=dry_visits_after(game, turn, pocketed),
        replays=game.replays,
        outcome=outcome,
    )


def rules_cited(rules: tuple[str, ...], evidence: tuple[Evidence, ...]) -> tuple[str, ...]:
    """Every rule id once: those that decided first, then those only proved."""
    return tuple(dict.fromkeys((*rules, *(one.rule for one in evidence))))
