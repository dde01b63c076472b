"""The decisions that a choice offers, and what follows from the one that is made."""

from client.learn.compiled import layout as to
from client.learn.compiled.compiling import inner


@inner
def count_decisions(game, here):
    """How many decisions a choice offers; `here`: whether the cue ball is on the table."""
    choice = game[to.CHOICE]
    if choice == to.R12:
        return 3
    if choice == to.R12A:
        return 4 if here else 3
    return 2


@inner
def decision_at(game, here, number):
    """The decision of this number among those that a choice offers."""
    choice = game[to.CHOICE]
    if choice == to.R12:
        return to.ACCEPT_TABLE if number == 0 else to.RERACK_AND_BREAK + number - 1
    if choice == to.R12A:
        number += 0 if here else 1
        return number if number < 2 else to.RERACK_AND_BREAK + number - 2
    if choice == to.R13 or choice == to.R14:
        return to.SPOT_EIGHT if number == 0 else to.RERACK_AND_BREAK
    return to.ACCEPT_TABLE if number == 0 else to.BALL_IN_HAND


@inner
def await_rack(game, turn):
    """As `referee.rules.stalemate.await_rack`."""
    if turn != game[to.TURN]:
        game[to.VISIT_STROKES] = 0
    game[to.PHASE], game[to.TURN], game[to.GROUP] = to.RERACK, turn, to.OPEN
    game[to.AREA], game[to.CHOICE] = to.NOT_IN_HAND, to.NO_CHOICE


@inner
def decide(game, here, share):
    """Make the decision that a number in [0, 1] chooses; what became of it."""
    count = count_decisions(game, here)
    decision = decision_at(game, here, min(int(share * count), count - 1))
    if decision == to.SPOT_EIGHT:
        return to.TO_REFEREE
    if decision >= to.RERACK_AND_BREAK:
        await_rack(game, game[to.TURN] if decision == to.RERACK_AND_BREAK else 1 - game[to.TURN])
        return to.PLAYED
    game[to.PHASE], game[to.CHOICE] = to.PLAY, to.NO_CHOICE
    game[to.AREA] = to.KITCHEN if decision == to.BALL_IN_HAND else to.NOT_IN_HAND
    return to.PLAYED
