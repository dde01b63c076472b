"""Gauntlet: a few challengers meet all others, who do not meet each other."""

from collections.abc import Mapping

from tournament.formats.order import Meet, numbered, present
from tournament.pairings import Plan
from tournament.results import GameResult
from tournament.scores import Key
from tournament.spec import Spec


def plan_gauntlet(spec: Spec, games: Mapping[Key, GameResult], withdrawn: Mapping[str, int]) -> Plan:
    """All pairs at once: in each round every challenger meets one of the others.

    Challengers are the first of the list, whatever the seeding. With more challengers than others some
    challengers rest in a round.
    """
    challengers, others = spec.names[: spec.challengers], spec.names[spec.challengers :]
    meets: list[Meet] = []
    for around in range(max(len(challengers), len(others))):
        rows = _round(challengers, others, around)
        meets += [(around, number, one, other) for number, (one, other) in enumerate(rows)]
    return Plan(tuple(numbered(spec, [meet for meet in meets if present(meet, withdrawn)])))


def _round(challengers: tuple[str, ...], others: tuple[str, ...], around: int) -> list[tuple[str, str]]:
    """One round: the shorter list against the longer one, shifted by a place each round."""
    if len(challengers) <= len(others):
        return [(one, others[(index + around) % len(others)]) for index, one in enumerate(challengers)]
    return [(challengers[(index + around) % len(challengers)], other) for index, other in enumerate(others)]
