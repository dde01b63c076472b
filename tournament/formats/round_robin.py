"""Round robin: everybody meets everybody once."""

from collections.abc import Iterator, Mapping

from tournament.formats.order import Meet, numbered, present, seeded
from tournament.pairings import Bye, Plan
from tournament.results import GameResult
from tournament.scores import Key
from tournament.spec import Spec


def plan_round_robin(spec: Spec, games: Mapping[Key, GameResult], withdrawn: Mapping[str, int]) -> Plan:
    """All pairs at once, round by round; with an odd number of entrants one rests in each round."""
    names = seeded(spec)
    meets = [meet for meet in circle(names) if present(meet, withdrawn)]
    return Plan(tuple(numbered(spec, meets)), tuple(_rests(names)))


def circle(names: list[str]) -> Iterator[Meet]:
    """The circle method: the last one stays, the others move round by one place after each round.

    Kirkman 1847; the same schedule as the Berger tables up to the order of rounds. Whoever meets the empty place
    of an odd number rests.
    """
    seats: list[str | None] = [*names, *([None] if len(names) % 2 else [])]
    fixed, ring = seats[-1], seats[:-1]
    for around in range(len(ring)):
        line = ring[around:] + ring[:around]
        couples = [(line[0], fixed), *zip(line[1:], reversed(line[1:]), strict=True)][: len(seats) // 2]
        meeting = 0
        for index, (one, other) in enumerate(couples):
            if one is not None and other is not None:
                swap = (around + index) % 2 == 1
                yield (around, meeting, other, one) if swap else (around, meeting, one, other)
                meeting += 1


def _rests(names: list[str]) -> Iterator[Bye]:
    """Who rests in which round."""
    if len(names) % 2:
        for around in range(len(names)):
            yield Bye(around, names[around])
