"""R8 to R17: the break. What it was, and what follows."""

from physics.facts import NEVER
from referee.game import EIGHT, Decision, Evidence
from referee.rules.fouls import no_ball_struck, worst
from referee.rules.stroke import Finding, Stroke

BALLS_TO_CUSHION = 4
"""R9: different object balls a legal break without a pocketed ball drives to cushions."""

_RERACKS = (Decision.RERACK_AND_BREAK, Decision.OPPONENT_RERACKS)


def must_strike_a_ball(stroke: Stroke) -> Finding:
    """R8: any ball may be struck first on the break, but one must be."""
    return tuple(Evidence("R8", searched=one.searched) for one in no_ball_struck(stroke))


def balls_driven(stroke: Stroke) -> tuple[int, ...]:
    """R9: the different object balls driven to a cushion; a pocketed ball counts, the cue ball never."""
    facts = stroke.facts
    return tuple(
        ball for ball in range(1, 16) if facts.cushion[ball] != NEVER or facts.pocketed[ball] != NEVER
    )


def legal_break(stroke: Stroke) -> bool:
    """R9: an object ball is pocketed, or at least four object balls are driven to a cushion."""
    return bool(stroke.pocketed) or len(balls_driven(stroke)) >= BALLS_TO_CUSHION


def break_evidence(stroke: Stroke) -> Evidence:
    """R9: the events that make the break legal, or those found and the range searched when it is not."""
    facts = stroke.facts
    if stroke.pocketed:
        return Evidence("R9", tuple(facts.pocketed[ball] for ball in stroke.pocketed))
    events = tuple(sorted(facts.cushion[ball] for ball in balls_driven(stroke)))
    return Evidence("R9", events, None if legal_break(stroke) else stroke.searched())


def choice_after_illegal_break(found: Finding) -> tuple[str, tuple[Decision, ...]]:
    """R12 and R12a: what the opponent may choose after an illegal break, without and with a foul."""
    if not found:
        return "R12", (Decision.ACCEPT_TABLE, *_RERACKS)
    if worst(found) == "R32":
        return "R12a", (Decision.BALL_IN_HAND, *_RERACKS)
    return "R12a", (Decision.ACCEPT_TABLE, Decision.BALL_IN_HAND, *_RERACKS)


def choice_after_eight(found: Finding) -> tuple[str, tuple[Decision, ...]] | None:
    """R13 (no foul, the breaker chooses) and R14 (a scratch, the opponent does); None after another foul."""
    if not found:
        return "R13", (Decision.SPOT_EIGHT, Decision.RERACK_AND_BREAK)
    if worst(found) == "R32":
        return "R14", (Decision.SPOT_EIGHT, Decision.RERACK_AND_BREAK)
    return None


def scratch_on_break(found: Finding) -> bool:
    """R15: a scratch on a legal break gives the opponent ball in hand behind the head string."""
    return worst(found) == "R32"


def choice_after_foul(found: Finding) -> tuple[str, tuple[Decision, ...]]:
    """R16 (an object ball off the table) and R17 (any other foul): accept the position, or ball in hand."""
    rule = "R16" if any(one.rule == "R36" for one in found) else "R17"
    return rule, (Decision.ACCEPT_TABLE, Decision.BALL_IN_HAND)


def breaker_continues(stroke: Stroke) -> Finding:
    """R10: after a legal break without a foul the breaker goes on if a ball fell."""
    facts = stroke.facts
    return tuple(
        Evidence("R10", (facts.pocketed[ball],), ball=ball, pocket=facts.pocket[ball])
        for ball in stroke.pocketed
    )


def breaker_passes(stroke: Stroke) -> Finding:
    """R11: after a legal break without a foul the turn passes if no ball fell."""
    return () if stroke.pocketed else (Evidence("R11", searched=stroke.searched()),)


def eight_on_break(stroke: Stroke, rule: str) -> Finding:
    """Where and when the 8 was pocketed, cited under R13 or R14."""
    facts = stroke.facts
    return (Evidence(rule, (facts.pocketed[EIGHT],), ball=EIGHT, pocket=facts.pocket[EIGHT]),)
