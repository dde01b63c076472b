"""How many games an event has, from its terms alone."""

from tournament.spec import Format, Spec


def games_of(spec: Spec) -> tuple[int, int]:
    """At least and at most so many: a sequential test may stop an event early, drawn meetings of a knockout get more.

    Withdrawals are not foreseen.
    """
    entrants, in_meeting = len(spec.entrants), spec.games_in_meeting
    if spec.format is Format.SWISS:
        meetings = (spec.rounds or 0) * (entrants // 2)
    elif spec.format is Format.KNOCKOUT:
        meetings = entrants - 1
        return meetings * in_meeting, meetings * (in_meeting + 2 * spec.extra_pairs)
    elif spec.format is Format.GAUNTLET:
        meetings = spec.challengers * (entrants - spec.challengers)
    else:
        meetings = entrants * (entrants - 1) // 2
    games = meetings * in_meeting
    return (min(games, 2) if spec.sprt is not None else games), games
