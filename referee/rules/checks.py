"""Everything that can be wrong with an action before it is played: refusals, never fouls."""

from physics.cue import check as check_cue
from physics.errors import InvalidShot
from physics.state import TableState
from physics.table import Table
from referee.game import EIGHT, SAFETY, Action, Call, Decision, Game, Phase, Refusal, RuleId, callable_balls
from referee.rules.placement import refuse_placement
from referee.rules.stroke_facts import CUE_BALL


def check_action(table: Table, game: Game, action: Action) -> tuple[Refusal, ...]:
    """All refusals; none means that the action may be played."""
    if refusals := refuse_phase(game, action):
        return refusals
    if action.shot is None:
        return ()
    placement = refuse_placement(table, game, action.cue_ball)
    cue = () if placement else refuse_stroke(table, game, action)
    return (*refuse_call(game, action), *placement, *cue)


def refuse_phase(game: Game, action: Action) -> tuple[Refusal, ...]:
    """A stroke where a decision is due, a decision that is not on offer, anything in a game that is over."""
    if game.outcome is not None:
        return (Refusal(game.outcome.rule, "action", action.to_dict(), "nothing: the game is over"),)
    if action.decision is Decision.CONCEDE and game.phase is not Phase.RERACK:
        return ()
    if game.phase is Phase.RERACK:
        return (Refusal(RuleId.R49, "action", action.to_dict(), "nothing before the balls are racked again"),)
    if game.phase is Phase.DECISION:
        return _refuse_choice(game, action)
    if action.decision is not None:
        return (Refusal(RuleId.R12, "decision", action.decision.value, "a stroke: no choice is open"),)
    return ()


def refuse_call(game: Game, action: Action) -> tuple[Refusal, ...]:
    """R8: no call on the break. R23: every other stroke calls a ball that may be called, or a safety."""
    call = action.call
    if game.phase is Phase.BREAK:
        return () if call is None else (Refusal(RuleId.R8, "call", _shown(call), "null: the break is not called"),)
    if call == SAFETY:
        return ()
    if not isinstance(call, Call):
        return (Refusal(RuleId.R23, "call", None, 'a ball and a pocket, or "safety"'),)
    refusals = []
    allowed = callable_balls(game)
    if call.ball not in allowed:
        rule = RuleId.R27 if call.ball == EIGHT else RuleId.R23
        refusals.append(Refusal(rule, "call.ball", call.ball, f"one of {list(allowed)}, or a safety"))
    if not 0 <= call.pocket < 6:
        refusals.append(Refusal(RuleId.R23, "call.pocket", call.pocket, "a pocket 0..5 (SW W NW NE E SE)"))
    return tuple(refusals)


def refuse_stroke(table: Table, game: Game, action: Action) -> tuple[Refusal, ...]:
    """R39: an intended stroke that cannot be played is refused; only noise makes a miscue."""
    assert action.shot is not None
    try:
        action.shot.refuse_beyond(table)
    except InvalidShot as beyond:
        allowed = beyond.allowed.removeprefix("must be ")
        return (Refusal(RuleId.R39, f"shot.{beyond.field}", beyond.value, allowed),)
    unplayable = check_cue(table, start_state(game, action), action.shot)
    if unplayable is None:
        return ()
    return (Refusal(RuleId.R39, "shot", action.shot.to_dict(), f"a playable stroke: {unplayable.reason}"),)


def start_state(game: Game, action: Action) -> TableState:
    """The table the stroke starts from: the cue ball placed if it is in hand."""
    return game.state if action.cue_ball is None else game.state.moved(CUE_BALL, action.cue_ball)


def _refuse_choice(game: Game, action: Action) -> tuple[Refusal, ...]:
    if action.decision in game.decisions:
        return ()
    rule = game.choice or RuleId.R12
    allowed = f"one of the decisions {[decision.value for decision in game.decisions]}"
    if action.decision is None:
        return (Refusal(rule, "action", action.to_dict(), allowed),)
    return (Refusal(rule, "decision", action.decision.value, allowed),)


def _shown(call: Call | str) -> object:
    return call.to_dict() if isinstance(call, Call) else call
