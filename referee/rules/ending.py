"""R42 to R48: how a game ends."""

from referee.game import EIGHT, Call, EndReason, Evidence, Outcome, RuleId
from referee.rules.calls import called_ball_made
from referee.rules.stroke_facts import Finding, StrokeFacts


def eight_with_foul(stroke: StrokeFacts, found: Finding) -> Finding:
    """R42: the 8 pocketed on a stroke with a foul loses."""
    return _eight(stroke, RuleId.R42) if found and stroke.eight_pocketed else ()


def eight_too_early(stroke: StrokeFacts) -> Finding:
    """R43: the 8 pocketed before the group was cleared loses; so does the clearing stroke."""
    return _eight(stroke, RuleId.R43) if stroke.eight_pocketed and not stroke.on_eight else ()


def eight_not_as_called(stroke: StrokeFacts) -> Finding:
    """R44: the 8 in a pocket that was not called, or on a safety, loses."""
    uncalled = stroke.on_eight and not _made_as_called(stroke)
    return _eight(stroke, RuleId.R44) if stroke.eight_pocketed and (stroke.action.is_safety or uncalled) else ()


def eight_off_table(stroke: StrokeFacts) -> Finding:
    """R45: the 8 off the table loses."""
    if not stroke.eight_off_table:
        return ()
    return (Evidence(RuleId.R45, (stroke.facts.off_table[EIGHT],), ball=EIGHT),)


def eight_made(stroke: StrokeFacts, found: Finding) -> Finding:
    """R46: the 8 legally in the called pocket, the group cleared before the stroke, wins."""
    return _eight(stroke, RuleId.R46) if stroke.on_eight and _made_as_called(stroke) and not found else ()


def foul_on_eight(stroke: StrokeFacts, found: Finding) -> bool:
    """R47: a foul while on the 8, which stays up, is a foul like any other: ball in hand."""
    return bool(found) and stroke.on_eight and not stroke.eight_pocketed


def end_by_eight(stroke: StrokeFacts, found: Finding) -> tuple[Outcome, Finding] | None:
    """The outcome of a stroke that took the 8 out of play (not the break), with every rule that says so.

    The outcome's reason is the first loss that applies, in the order of the rules.
    """
    if not (stroke.eight_pocketed or stroke.eight_off_table):
        return None
    if proof := eight_made(stroke, found):
        return Outcome(stroke.shooter, EndReason.EIGHT_MADE, RuleId.R46), proof
    losses = (
        (EndReason.EIGHT_WITH_FOUL, eight_with_foul(stroke, found)),
        (EndReason.EIGHT_TOO_EARLY, eight_too_early(stroke)),
        (EndReason.EIGHT_NOT_AS_CALLED, eight_not_as_called(stroke)),
        (EndReason.EIGHT_OFF_TABLE, eight_off_table(stroke)),
    )
    reason, first = next((reason, proof) for reason, proof in losses if proof)
    proofs = tuple(one for _, proof in losses for one in proof)
    return Outcome(stroke.opponent, reason, first[0].rule), proofs


FROM_OUTSIDE = (
    EndReason.CONCESSION,
    EndReason.TIME_OUT,
    EndReason.FORFEIT,
    EndReason.NO_SHOW,
    EndReason.CRASH,
    EndReason.STALL,
)
"""R48: the ends that a player brings about away from the table; each loses the game."""


def _made_as_called(stroke: StrokeFacts) -> bool:
    call = stroke.action.call
    return isinstance(call, Call) and call.ball == EIGHT and bool(called_ball_made(stroke))


def _eight(stroke: StrokeFacts, rule: str) -> Finding:
    facts = stroke.facts
    return (Evidence(rule, (facts.pocketed[EIGHT],), ball=EIGHT, pocket=facts.pocket[EIGHT]),)
