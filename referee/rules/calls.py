"""R18 to R29: what a stroke with a call is worth, fouls and the 8 aside."""

from physics.facts import NEVER
from referee.game import Call, Evidence, Group, Phase, RuleId
from referee.rules.stroke_facts import Finding, StrokeFacts, group_of_ball


def called_ball_made(stroke: StrokeFacts) -> Finding:
    """R24: the called ball fell in the called pocket, by whatever kisses, banks and combinations."""
    call, facts = stroke.action.call, stroke.facts
    if not isinstance(call, Call) or facts.pocketed[call.ball] == NEVER:
        return ()
    if facts.pocket[call.ball] != call.pocket:
        return ()
    return (Evidence(RuleId.R24, (facts.pocketed[call.ball],), ball=call.ball, pocket=call.pocket),)


def called_ball_elsewhere(stroke: StrokeFacts) -> Finding:
    """R25: the called ball fell, but in another pocket: not made, no foul, and it stays down."""
    call, facts = stroke.action.call, stroke.facts
    if not isinstance(call, Call) or facts.pocketed[call.ball] == NEVER or called_ball_made(stroke):
        return ()
    return (Evidence(RuleId.R25, (facts.pocketed[call.ball],), ball=call.ball, pocket=facts.pocket[call.ball]),)


def shooter_continues(stroke: StrokeFacts, found: Finding) -> Finding:
    """R28: the called ball legally in the called pocket, and nothing else, lets the shooter go on."""
    return () if found else _cite(RuleId.R28, called_ball_made(stroke))


def called_ball_missed(stroke: StrokeFacts) -> Finding:
    """R28, the other way: the called ball was not pocketed, so the turn passes."""
    call = stroke.action.call
    if not isinstance(call, Call) or stroke.facts.pocketed[call.ball] != NEVER:
        return ()
    return (Evidence(RuleId.R28, searched=stroke.searched(), ball=call.ball, pocket=call.pocket),)


def safety_passes_turn(stroke: StrokeFacts) -> Finding:
    """R26: after a safety the turn passes, whatever was pocketed."""
    if not stroke.action.is_safety:
        return ()
    return (Evidence(RuleId.R26, tuple(stroke.facts.pocketed[ball] for ball in stroke.pocketed)),)


def other_balls_on_open_table(stroke: StrokeFacts) -> Finding:
    """R21: further balls pocketed on an open table do not decide the groups."""
    return _other_balls(stroke, RuleId.R21) if stroke.game.groups is None else ()


def other_balls_stay_down(stroke: StrokeFacts) -> Finding:
    """R29: further balls pocketed stay down, the opponent's included."""
    return _other_balls(stroke, RuleId.R29) if stroke.game.groups is not None else ()


def table_stays_open(stroke: StrokeFacts, found: Finding) -> bool:
    """R22: a foul leaves an open table open (and so does a called ball that was not made)."""
    return stroke.game.groups is None and not shooter_continues(stroke, found)


def table_opens(stroke: StrokeFacts) -> bool:
    """R18: whatever the break pocketed, the table is open after it."""
    return stroke.game.phase is Phase.BREAK


def fixes_groups(stroke: StrokeFacts, found: Finding) -> Finding:
    """R19: on an open table, legally pocketing the called ball gives the shooter that ball's group."""
    if stroke.game.groups is not None:
        return ()
    return _cite(RuleId.R19, shooter_continues(stroke, found))


def groups_after(stroke: StrokeFacts, found: Finding) -> tuple[Group, Group] | None:
    """The groups when the stroke is over."""
    call = stroke.action.call
    if table_opens(stroke) or not fixes_groups(stroke, found) or not isinstance(call, Call):
        return stroke.game.groups
    return assign(stroke.shooter, group_of_ball(call.ball))


def assign(seat: int, group: Group) -> tuple[Group, Group]:
    """Seat 0's and seat 1's group when ``seat`` has ``group``."""
    other = Group.STRIPES if group is Group.SOLIDS else Group.SOLIDS
    return (group, other) if seat == 0 else (other, group)


def _cite(rule: str, found: Finding) -> Finding:
    return tuple(Evidence(rule, one.events, one.searched, one.ball, one.pocket) for one in found)


def _other_balls(stroke: StrokeFacts, rule: str) -> Finding:
    call, facts = stroke.action.call, stroke.facts
    called = call.ball if isinstance(call, Call) else None
    others = (ball for ball in stroke.pocketed if ball != called)
    return tuple(Evidence(rule, (facts.pocketed[ball],), ball=ball, pocket=facts.pocket[ball]) for ball in others)
