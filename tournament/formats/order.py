"""The order of the entrants, and the pairs of a meeting: what all formats share."""

from collections.abc import Iterable, Iterator, Mapping

from tournament.choices import Seeding
from tournament.pairings import Pair
from tournament.seeds import level, lot
from tournament.spec import Spec

Meet = tuple[int, int, str, str]
"""Round, number of the meeting in it, and the two who meet."""


def seeded(spec: Spec) -> list[str]:
    """The names, the first seed first."""
    names = list(spec.names)
    if spec.seeding is Seeding.DRAWN:
        lot(spec, "order").shuffle(names)
    return names


def numbered(spec: Spec, meets: Iterable[Meet], start: int = 0) -> Iterator[Pair]:
    """The pairs of these meetings, numbered from ``start``."""
    number = start
    for each in meets:
        for index in range(spec.pairs):
            yield pair_of(spec, each, index, number)
            number += 1


def pair_of(spec: Spec, meet: Meet, index: int, number: int) -> Pair:
    """The ``index``-th pair of a meeting; who breaks its first game changes from pair to pair."""
    around, meeting, one, other = meet
    id_ = f"r{around}-m{meeting}-p{index}"
    players = (one, other) if index % 2 == 0 else (other, one)
    return Pair(id_, number, around, meeting, index, players, level(spec, id_, index))


def present(meet: Meet, withdrawn: Mapping[str, int]) -> bool:
    """Neither of the two has withdrawn before this round."""
    around, _, one, other = meet
    return all(around < withdrawn.get(name, around + 1) for name in (one, other))
