"""What the referee rules on a stroke (R8 to R49), compiled; what is rare is left to the referee."""

from client.learn.compiled import layout as to
from client.learn.compiled.compiling import compiled, inner
from client.learn.compiled.decisions import await_rack
from client.learn.compiled.groups import EIGHT, group_of, in_group, is_on_eight
from physics.kernels import layout as at

NEVER = -1
BALLS_TO_CUSHION = 4
"""R9."""


@inner
def went(facts, first):
    """Whether anything befell an object ball, by the facts from column `first` on."""
    for ball in range(1, at.LANES):  # noqa: SIM110 - kernels have no generators
        if facts[first + ball] != NEVER:
            return True
    return False


@inner
def is_miscue(facts):
    """R39."""
    return facts[at.F_STATUS] == at.CUE_OBSTRUCTED or facts[at.F_STATUS] == at.TIP_OFF_BALL


@inner
def is_bad_from_kitchen(facts, before, head):
    """R38."""
    struck = False
    for ball in range(1, at.LANES):
        if facts[at.F_FIRST + ball] != NEVER:
            struck = True
            if before[ball, 1] <= head:
                return False
    if struck:
        return facts[at.F_CROSSED_BEFORE] == NEVER
    return facts[at.F_CROSSED] == NEVER


@inner
def is_foul(facts, before, group, eight, kitchen, head):
    """R32 to R39."""
    scratched = facts[at.F_POCKETED] != NEVER or facts[at.F_OFF_TABLE] != NEVER
    if is_miscue(facts) or scratched or went(facts, at.F_OFF_TABLE):
        return True
    struck = legal = False
    for ball in range(1, at.LANES):
        if facts[at.F_FIRST + ball] != NEVER:
            struck = True
            if ball == EIGHT if eight else in_group(ball, group):
                legal = True
    if not struck or not legal:
        return True
    driven = facts[at.F_CUSHION_AFTER] != NEVER or went(facts, at.F_CUSHION_AFTER)
    if not driven and not went(facts, at.F_POCKETED):
        return True
    return kitchen and is_bad_from_kitchen(facts, before, head)


@inner
def go_on(game, turn, fell):
    """The counters after one more stroke; `fell`: an object ball was pocketed."""
    game[to.STROKE] += 1
    if fell:
        game[to.DRY_VISITS] = 0
    elif game[to.VISIT_STROKES] == 0 and turn != game[to.TURN]:
        game[to.DRY_VISITS] += 1
    game[to.VISIT_STROKES] = game[to.VISIT_STROKES] + 1 if turn == game[to.TURN] else 0
    game[to.TURN] = turn
    game[to.PHASE], game[to.AREA], game[to.CHOICE] = to.PLAY, to.NOT_IN_HAND, to.NO_CHOICE


@inner
def end(game, winner, reason):
    """The game is over."""
    game[to.PHASE], game[to.AREA], game[to.CHOICE] = to.OVER, to.NOT_IN_HAND, to.NO_CHOICE
    game[to.WINNER], game[to.REASON], game[to.DECIDED_BY] = winner, reason, reason


@inner
def rule_break(game, facts, before, head):
    """R8 to R17, the 8 still in play."""
    shooter = game[to.TURN]
    fell = went(facts, at.F_POCKETED)
    driven = 0
    for ball in range(1, at.LANES):
        gone = facts[at.F_POCKETED + ball] != NEVER or facts[at.F_OFF_TABLE + ball] != NEVER
        driven += int(gone or facts[at.F_CUSHION + ball] != NEVER)
    legal = fell or driven >= BALLS_TO_CUSHION
    missed = is_miscue(facts)
    scratched = not missed and (facts[at.F_POCKETED] != NEVER or facts[at.F_OFF_TABLE] != NEVER)
    off = not missed and went(facts, at.F_OFF_TABLE)
    other = missed or not went(facts, at.F_FIRST) or is_bad_from_kitchen(facts, before, head)
    choice = to.NO_CHOICE
    if not legal:
        choice = to.R12A if scratched or off or other else to.R12
    elif off and not scratched:
        choice = to.R16
    elif other and not scratched:
        choice = to.R17
    go_on(game, shooter if choice == to.NO_CHOICE and fell and not scratched else 1 - shooter, fell)
    game[to.GROUP] = to.OPEN
    if choice != to.NO_CHOICE:
        game[to.PHASE], game[to.CHOICE] = to.DECISION, choice
    elif scratched:
        game[to.AREA] = to.KITCHEN


@inner
def rule_play(game, facts, before, ball, pocket, head):
    """R18 to R47."""
    shooter = game[to.TURN]
    group, kitchen = group_of(game, shooter), game[to.AREA] == to.KITCHEN
    eight = is_on_eight(before, group)
    fouled = is_foul(facts, before, group, eight, kitchen, head)
    fell = went(facts, at.F_POCKETED)
    made = ball != to.SAFETY and facts[at.F_POCKETED + ball] != NEVER and facts[at.F_POCKET + ball] == pocket
    down, off = facts[at.F_POCKETED + EIGHT] != NEVER, facts[at.F_OFF_TABLE + EIGHT] != NEVER
    if down or off:
        go_on(game, shooter, fell)
        as_called = eight and made and ball == EIGHT
        if as_called and not fouled:
            end(game, shooter, to.EIGHT_MADE)
        elif down and fouled:
            end(game, 1 - shooter, to.EIGHT_WITH_FOUL)
        elif down and not eight:
            end(game, 1 - shooter, to.EIGHT_TOO_EARLY)
        elif down:
            end(game, 1 - shooter, to.EIGHT_NOT_AS_CALLED)
        else:
            end(game, 1 - shooter, to.EIGHT_OFF_TABLE)
        return
    continues = made and not fouled
    go_on(game, shooter if continues else 1 - shooter, fell)
    if fouled:
        game[to.AREA] = to.ANYWHERE
    elif continues and group == to.OPEN:
        solids = ball < EIGHT
        game[to.GROUP] = 0 if solids == (shooter == 0) else 1


@inner
def limit(game, limits):
    """R49."""
    if game[to.PHASE] == to.OVER:
        return
    if game[to.STROKE] >= limits[2]:
        end(game, to.NOBODY, to.STROKE_LIMIT)
    elif game[to.DRY_VISITS] >= limits[0]:
        if game[to.REPLAYS] >= limits[1]:
            end(game, to.NOBODY, to.STALEMATE)
        else:
            await_rack(game, game[to.BREAKER])
            game[to.DRY_VISITS] = 0
            game[to.REPLAYS] += 1


@compiled
def rule(head, limits, places, games, rows, before, calls, final, facts, became):
    """`EightBall.apply` of a stroke in each row, and where the balls lie then.

    Args:
        head: y of the head string, m. limits: (3,) int64: dry visits, replays, strokes.
        before, calls: see `aim_straight`. final: (m, 16, 2), facts: (m, FACTS_WIDTH) int32, of the physics.
        became: (m,); rows that stay as they are because the 8 left play on the break are marked TO_REFEREE.
    """
    for k in range(rows.shape[0]):
        game, found = games[rows[k]], facts[k]
        if game[to.PHASE] == to.BREAK:
            if found[at.F_POCKETED + EIGHT] != NEVER or found[at.F_OFF_TABLE + EIGHT] != NEVER:
                became[k] = to.TO_REFEREE
                continue
            rule_break(game, found, before[k], head)
        else:
            rule_play(game, found, before[k], calls[k, 0], calls[k, 1], head)
        limit(game, limits)
        places[rows[k]] = final[k]
