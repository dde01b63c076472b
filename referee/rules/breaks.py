"""R8 to R17: the break. What it was, and what follows."""

from collections.abc import Mapping
from typing import Final, NamedTuple

from physics.facts import NEVER
from referee.game import EIGHT, Decision, Evidence, RuleId
from referee.rules.fouls import no_ball_struck, worst
from referee.rules.stroke_facts import Finding, StrokeFacts

BALLS_TO_CUSHION = 4
"""R9: different object balls a legal break without a pocketed ball drives to cushions."""

_RERACKS = (Decision.RERACK_AND_BREAK, Decision.OPPONENT_RERACKS)
_AFTER_FOUL = (Decision.ACCEPT_TABLE, Decision.BALL_IN_HAND)
_ABOUT_EIGHT = (Decision.SPOT_EIGHT, Decision.RERACK_AND_BREAK)

OFFERED: Final[Mapping[str, tuple[Decision, ...]]] = {
    RuleId.R12: (Decision.ACCEPT_TABLE, *_RERACKS),
    RuleId.R12a: (*_AFTER_FOUL, *_RERACKS),
    RuleId.R13: _ABOUT_EIGHT,
    RuleId.R14: _ABOUT_EIGHT,
    RuleId.R16: _AFTER_FOUL,
    RuleId.R17: _AFTER_FOUL,
}
"""What each rule that grants a choice offers; R12a without `accept_table` when the cue ball is off the table."""


class Choice(NamedTuple):
    """What a rule lets a player choose: the rule, the seat that decides, the decisions."""

    rule: str
    decider: int
    decisions: tuple[Decision, ...]


def must_strike_a_ball(stroke: StrokeFacts) -> Finding:
    """R8: any ball may be struck first on the break, but one must be."""
    return tuple(Evidence(RuleId.R8, searched=one.searched) for one in no_ball_struck(stroke))


def balls_driven(stroke: StrokeFacts) -> tuple[int, ...]:
    """R9: the different object balls driven to a cushion; one pocketed or off the table counts, the cue ball never."""
    return tuple(ball for ball in range(1, 16) if driven_by(stroke, ball) != NEVER)


def driven_by(stroke: StrokeFacts, ball: int) -> int:
    """R9: the event by which a ball counts as driven to a cushion, or NEVER (WPA 8.4)."""
    facts = stroke.facts
    events = (facts.cushion[ball], facts.pocketed[ball], facts.off_table[ball])
    return min((event for event in events if event != NEVER), default=NEVER)


def legal_break(stroke: StrokeFacts) -> bool:
    """R9: an object ball is pocketed, or at least four object balls are driven to a cushion."""
    return bool(stroke.pocketed) or len(balls_driven(stroke)) >= BALLS_TO_CUSHION


def break_evidence(stroke: StrokeFacts) -> Evidence:
    """R9: the events that make the break legal, or those found and the range searched when it is not."""
    facts = stroke.facts
    if stroke.pocketed:
        return Evidence(RuleId.R9, tuple(facts.pocketed[ball] for ball in stroke.pocketed))
    events = tuple(sorted(driven_by(stroke, ball) for ball in balls_driven(stroke)))
    return Evidence(RuleId.R9, events, None if legal_break(stroke) else stroke.searched())


def illegal_break(stroke: StrokeFacts, found: Finding) -> Choice | None:
    """R12: illegal without a foul, the opponent takes the table as it lies or asks for a new rack."""
    if legal_break(stroke) or found:
        return None
    return Choice(RuleId.R12, stroke.opponent, OFFERED[RuleId.R12])


def illegal_break_with_foul(stroke: StrokeFacts, found: Finding) -> Choice | None:
    """R12a: the new racks of R12, or what the foul gives: no position to accept after a scratch."""
    if legal_break(stroke) or not found:
        return None
    offered = OFFERED[RuleId.R12a]
    return Choice(RuleId.R12a, stroke.opponent, offered[1:] if worst(found) == RuleId.R32 else offered)


def eight_on_break(stroke: StrokeFacts, found: Finding) -> Choice | None:
    """R13: the 8 pocketed without a foul, the breaker has it spotted or breaks again."""
    if not stroke.eight_pocketed or found:
        return None
    return Choice(RuleId.R13, stroke.shooter, OFFERED[RuleId.R13])


def eight_and_scratch_on_break(stroke: StrokeFacts, found: Finding) -> Choice | None:
    """R14: the 8 pocketed with a scratch, the opponent has it spotted or breaks himself."""
    if not stroke.eight_pocketed or worst(found) != RuleId.R32:
        return None
    return Choice(RuleId.R14, stroke.opponent, OFFERED[RuleId.R14])


def scratch_on_break(stroke: StrokeFacts, found: Finding) -> bool:
    """R15: a scratch on a legal break gives the opponent ball in hand behind the head string."""
    return legal_break(stroke) and worst(found) == RuleId.R32


def ball_off_on_break(stroke: StrokeFacts, found: Finding) -> Choice | None:
    """R16: after a legal break with an object ball off the table, accept the position or ball in hand."""
    if not legal_break(stroke) or worst(found) != RuleId.R36:
        return None
    return Choice(RuleId.R16, stroke.opponent, OFFERED[RuleId.R16])


def other_foul_on_break(stroke: StrokeFacts, found: Finding) -> Choice | None:
    """R17: the same choice after a legal break with any other foul."""
    if not legal_break(stroke) or not found or worst(found) in (RuleId.R32, RuleId.R36):
        return None
    return Choice(RuleId.R17, stroke.opponent, OFFERED[RuleId.R17])


def breaker_continues(stroke: StrokeFacts) -> Finding:
    """R10: after a legal break without a foul the breaker goes on if a ball fell."""
    facts = stroke.facts
    return tuple(
        Evidence(RuleId.R10, (facts.pocketed[ball],), ball=ball, pocket=facts.pocket[ball]) for ball in stroke.pocketed
    )


def breaker_passes(stroke: StrokeFacts) -> Finding:
    """R11: after a legal break without a foul the turn passes if no ball fell."""
    return () if stroke.pocketed else (Evidence(RuleId.R11, searched=stroke.searched()),)


def eight_evidence(stroke: StrokeFacts, rule: str) -> Finding:
    """Where and when the 8 was pocketed, cited under R13 or R14."""
    facts = stroke.facts
    return (Evidence(rule, (facts.pocketed[EIGHT],), ball=EIGHT, pocket=facts.pocket[EIGHT]),)
