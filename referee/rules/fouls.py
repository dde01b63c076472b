"""R32 to R41: fouls, each found by one predicate over the facts of a stroke."""

from collections.abc import Callable

from physics.facts import NEVER
from physics.status import Status
from referee.game import EIGHT, CueBallArea, Evidence, Phase, RuleId
from referee.rules.stroke_facts import CUE_BALL, Finding, StrokeFacts

MISCUES = (Status.CUE_OBSTRUCTED, Status.TIP_OFF_BALL)
"""The ways in which noise can spoil a stroke that was possible as intended."""


def scratch(stroke: StrokeFacts) -> Finding:
    """R32: the cue ball is pocketed or leaves the table."""
    facts = stroke.facts
    if (event := facts.pocketed[CUE_BALL]) != NEVER:
        return (Evidence(RuleId.R32, (event,), ball=CUE_BALL, pocket=facts.pocket[CUE_BALL]),)
    if (event := facts.off_table[CUE_BALL]) != NEVER:
        return (Evidence(RuleId.R32, (event,), ball=CUE_BALL),)
    return ()


def wrong_ball_first(stroke: StrokeFacts) -> Finding:
    """R33: none of the balls struck first is one the shooter may strike first.

    Of simultaneous first contacts the shooter is given the better one.
    """
    struck = stroke.struck
    if not struck or any(ball in stroke.targets for ball in struck):
        return ()
    return tuple(_first_contact(stroke, RuleId.R33, ball) for ball in struck)


def eight_first_on_open_table(stroke: StrokeFacts) -> Finding:
    """R20: on an open table every ball but the 8 may be struck first."""
    if stroke.game.groups is not None or stroke.struck != (EIGHT,):
        return ()
    return (_first_contact(stroke, RuleId.R20, EIGHT),)


def no_ball_struck(stroke: StrokeFacts) -> Finding:
    """R34: the cue ball strikes nothing."""
    return () if stroke.struck else (Evidence(RuleId.R34, searched=stroke.searched()),)


def no_cushion_after_contact(stroke: StrokeFacts) -> Finding:
    """R35: no ball at all is pocketed, and after first contact no ball is driven to a cushion or off the table."""
    facts = stroke.facts
    if not stroke.struck or stroke.pocketed or facts.pocketed[CUE_BALL] != NEVER:
        return ()
    if max(facts.cushion_after_contact) != NEVER:
        return ()
    contact = min(facts.first_contact[ball] for ball in stroke.struck)
    if max(facts.off_table) > contact:
        return ()
    return (Evidence(RuleId.R35, searched=stroke.searched(contact)),)


def ball_off_table(stroke: StrokeFacts) -> Finding:
    """R36 (R16 on the break): an object ball leaves the table."""
    off = stroke.facts.off_table
    if max(off) == NEVER:
        return ()
    return tuple(Evidence(RuleId.R36, (off[ball],), ball=ball) for ball in range(1, 16) if off[ball] != NEVER)


def bad_play_from_kitchen(stroke: StrokeFacts) -> Finding:
    """R38: with ball in hand behind the head string, the cue ball has to cross it or reach a ball beyond it.

    A foul if the first ball struck lay behind the string and the cue ball had not crossed by then, or if the
    cue ball neither crosses nor strikes anything.
    """
    facts = stroke.facts
    if stroke.game.cue_ball_in_hand is not CueBallArea.KITCHEN:
        return ()
    if not stroke.struck:
        never_crossed = facts.crossed_head_string == NEVER
        return (Evidence(RuleId.R38, searched=stroke.searched()),) if never_crossed else ()
    if facts.crossed_before_contact != NEVER or any(_lies_beyond(stroke, ball) for ball in stroke.struck):
        return ()
    return tuple(_first_contact(stroke, RuleId.R38, ball) for ball in stroke.struck)


def miscue(stroke: StrokeFacts) -> Finding:
    """R39: noise made the stroke impossible (tip off the ball, cue blocked); nothing moved."""
    if stroke.facts.status not in MISCUES:
        return ()
    return (Evidence(RuleId.R39, status=Status(stroke.facts.status).name),)


BY_SEVERITY: tuple[Callable[[StrokeFacts], Finding], ...] = (
    scratch,
    ball_off_table,
    bad_play_from_kitchen,
    wrong_ball_first,
    no_ball_struck,
    no_cushion_after_contact,
)
"""The worst first: on the break a scratch leaves the opponent no position to accept."""

_ON_THE_BREAK = (scratch, ball_off_table, bad_play_from_kitchen, no_ball_struck)


def find_fouls(stroke: StrokeFacts) -> Finding:
    """R41: the evidence of every foul committed, the worst first.

    On the break any ball may be struck first (R8), and whether enough balls met cushions is R9's question.
    """
    if missed := miscue(stroke):
        return missed
    predicates = _ON_THE_BREAK if stroke.game.phase is Phase.BREAK else BY_SEVERITY
    return tuple([evidence for predicate in predicates for evidence in predicate(stroke)])


def worst(found: Finding) -> str | None:
    """R41: one penalty a stroke, that of the worst foul; None for a fair stroke."""
    return found[0].rule if found else None


def _first_contact(stroke: StrokeFacts, rule: RuleId, ball: int) -> Evidence:
    return Evidence(rule, (stroke.facts.first_contact[ball],), ball=ball)


def _lies_beyond(stroke: StrokeFacts, ball: int) -> bool:
    """The ball lay on the head string or on its foot side, that is not behind it."""
    position = stroke.game.state.position(ball)
    return position is not None and position[1] <= stroke.table.head_string
