"""How many games an event has, and how many of them can be played at once, from its terms alone."""

from collections.abc import Iterator

from tournament.choices import Format
from tournament.pairings import LEGS
from tournament.spec import Spec

Phases = tuple[int, ...]
"""Pairs that can be played at the same time, phase after phase: a round that is drawn from results waits for them."""


def games_of(spec: Spec) -> tuple[int, int]:
    """At least and at most so many: a sequential test may stop an event early, drawn meetings of a knockout get more.

    Withdrawals are not foreseen.
    """
    least, most = phases_of(spec)
    return len(LEGS) * sum(least), len(LEGS) * sum(most)


def phases_of(spec: Spec) -> tuple[Phases, Phases]:
    """The phases of the shortest and of the longest course that the event can take."""
    least = tuple(meetings * spec.pairs for meetings in _meetings(spec))
    if spec.format is Format.KNOCKOUT:
        extra = ((meetings * spec.pairs, *(meetings,) * spec.extra_pairs) for meetings in _meetings(spec))
        return least, tuple(pairs for phase in extra for pairs in phase)
    return ((1,) if spec.sprt is not None else least), least


def _meetings(spec: Spec) -> Iterator[int]:
    """How many entrants meet at the same time, phase after phase, extra pairs aside."""
    entrants = len(spec.entrants)
    if spec.format is Format.SWISS:
        yield from [entrants // 2] * (spec.rounds or 0)
    elif spec.format is Format.KNOCKOUT:
        while entrants > 1:
            places = 1 << (entrants - 1).bit_length()  # of the bracket; byes fill what is missing
            yield entrants - places // 2
            entrants = places // 2
    elif spec.format is Format.GAUNTLET:
        yield spec.challengers * (entrants - spec.challengers)
    else:
        yield entrants * (entrants - 1) // 2
