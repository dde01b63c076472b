"""Rulings in words."""

from physics.constants import POCKET_NAMES
from physics.status import Status
from referee.game import EIGHT, Call, CueBallArea, Decision, EndReason, Game, Phase, RuleId
from referee.rules.calls import called_ball_made
from referee.rules.stroke_facts import CUE_BALL, Finding, StrokeFacts, group_of_ball

DECISION_WORDS = {
    Decision.ACCEPT_TABLE: "accept the table",
    Decision.BALL_IN_HAND: "take ball in hand behind the head string",
    Decision.SPOT_EIGHT: "have the 8 spotted and play on",
    Decision.RERACK_AND_BREAK: "re-rack and break",
    Decision.OPPONENT_RERACKS: "have the opponent re-rack and break again",
    Decision.CONCEDE: "concede",
}
END_WORDS = {
    EndReason.EIGHT_MADE: "the 8 is made as called",
    EndReason.EIGHT_WITH_FOUL: "the 8 was pocketed with a foul",
    EndReason.EIGHT_TOO_EARLY: "the 8 was pocketed before the group was cleared",
    EndReason.EIGHT_NOT_AS_CALLED: "the 8 was pocketed other than called",
    EndReason.EIGHT_OFF_TABLE: "the 8 left the table",
    EndReason.STALEMATE: "stalemate: too many visits without a pocketed ball, and no replay left",
    EndReason.STROKE_LIMIT: "the game used up its strokes",
    EndReason.CONCESSION: "the opponent conceded",
    EndReason.TIME_OUT: "the opponent ran out of time",
    EndReason.FORFEIT: "the opponent forfeited",
    EndReason.NO_SHOW: "the opponent never came to the table",
    EndReason.CRASH: "the opponent crashed",
    EndReason.STALL: "the opponent stopped answering",
    EndReason.ABORTED: "the organiser aborted the game",
}


def describe_stroke(stroke: StrokeFacts, found: Finding, game: Game) -> str:
    """A stroke, its fouls and what follows, in a sentence."""
    parts = [_attempt(stroke)]
    if others := _others(stroke):
        parts.append(f"pocketed {', '.join(others)}")
    if found:
        parts.append("foul: " + ", ".join(dict.fromkeys(_foul(stroke, one.rule) for one in found)))
    if stroke.game.groups is None and (group := game.group_of(stroke.shooter)) is not None:
        parts.append(f"player {stroke.shooter} has {group}")
    parts.append(describe_next(game))
    return "; ".join(parts) + "."


def describe_decision(game: Game, decision: Decision, after: Game) -> str:
    """A decision and what follows, in a sentence."""
    return f"Player {game.turn} chooses to {DECISION_WORDS[decision]}; {describe_next(after)}."


def describe_next(game: Game) -> str:
    """What happens next, in a clause."""
    player = f"player {game.turn}"
    match game.phase:
        case Phase.OVER:
            return describe_end(game)
        case Phase.RERACK:
            return f"the balls are racked again and {player} breaks"
        case Phase.DECISION:
            return f"{player} may {' or '.join(DECISION_WORDS[decision] for decision in game.decisions)}"
        case Phase.BREAK:
            return f"{player} breaks"
        case Phase.PLAY:
            return f"{player} {_continues(game)}"


def describe_end(game: Game) -> str:
    """The result, in a clause."""
    assert game.outcome is not None
    winner, why = game.outcome.winner, END_WORDS[game.outcome.reason]
    return f"nobody wins: {why}" if winner is None else f"player {winner} wins: {why}"


def ball_name(ball: int) -> str:
    """``solid 3``, ``stripe 12``, ``the 8``, ``the cue ball``."""
    if ball == CUE_BALL:
        return "the cue ball"
    return "the 8" if ball == EIGHT else f"{group_of_ball(ball).value[:-1]} {ball}"


def pocket_name(pocket: int) -> str:
    """``pocket NE``."""
    return f"pocket {POCKET_NAMES[pocket]}"


def _attempt(stroke: StrokeFacts) -> str:
    player, call = f"Player {stroke.shooter}", stroke.action.call
    if stroke.game.phase is Phase.BREAK:
        return f"{player} breaks"
    if not isinstance(call, Call):
        return f"{player} plays safe"
    made = "makes" if called_ball_made(stroke) else "misses"
    return f"{player} {made} {ball_name(call.ball)} in {pocket_name(call.pocket)}"


def _others(stroke: StrokeFacts) -> list[str]:
    made = {one.ball for one in called_ball_made(stroke)}
    pocket = stroke.facts.pocket
    return [f"{ball_name(ball)} in {pocket_name(pocket[ball])}" for ball in stroke.pocketed if ball not in made]


def _foul(stroke: StrokeFacts, rule: str) -> str:
    facts = stroke.facts
    match rule:
        case RuleId.R32 if facts.pocket[CUE_BALL] >= 0:
            return f"the cue ball went into {pocket_name(facts.pocket[CUE_BALL])}"
        case RuleId.R32:
            return "the cue ball left the table"
        case RuleId.R33:
            return " and ".join(map(ball_name, stroke.struck)) + " struck first"
        case RuleId.R34:
            return "no ball struck"
        case RuleId.R35:
            return "no ball driven to a cushion after contact"
        case RuleId.R36:
            return "an object ball left the table"
        case RuleId.R38:
            return "the cue ball was not played out of the kitchen"
        case _:
            return f"miscue, {Status(facts.status).explain()}"


def _continues(game: Game) -> str:
    if game.cue_ball_in_hand is CueBallArea.KITCHEN:
        return "has ball in hand behind the head string"
    if game.cue_ball_in_hand is CueBallArea.ANYWHERE:
        return "has ball in hand"
    return "goes on" if game.visit_strokes else "is at the table"
