"""Knockout: who loses a meeting is out. Seeded so that the best meet late; byes go to the best."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from tournament.formats.order import Meet, pair_of, seeded
from tournament.pairings import Bye, Pair, Plan
from tournament.results import GameResult
from tournament.scores import Key, meetings
from tournament.seeds import lot
from tournament.spec import Drawn, Spec


@dataclass(slots=True)
class _Draw:
    """What has been planned so far."""

    spec: Spec
    games: Mapping[Key, GameResult]
    withdrawn: Mapping[str, int]
    pairs: list[Pair] = field(default_factory=list)
    byes: list[Bye] = field(default_factory=list)
    advanced: dict[str, int] = field(default_factory=dict)

    def plan(self, *, complete: bool) -> Plan:
        """The finished plan."""
        return Plan(tuple(self.pairs), tuple(self.byes), complete, self.advanced)


def plan_knockout(spec: Spec, games: Mapping[Key, GameResult], withdrawn: Mapping[str, int]) -> Plan:
    """Round after round while it is known who goes on."""
    draw = _Draw(spec, games, withdrawn)
    line = bracket(seeded(spec))
    around = 0
    while len(line) > 1:
        winners = list(_play_round(draw, line, around))
        draw.advanced |= {name: around + 1 for name in winners if name}
        if "" in winners:
            return draw.plan(complete=False)
        line, around = winners, around + 1
    return draw.plan(complete=True)


def bracket(names: Sequence[str]) -> list[str | None]:
    """Who stands on which line: seeds 1 and 2 can meet in the final only, 1 to 4 in the semifinals, and so on.

    Lines 2k and 2k + 1 meet. Places beyond the number of entrants are None: a bye for whoever meets them, and
    those are the best seeds.
    """
    order = [0]
    while len(order) < len(names):
        size = 2 * len(order)
        order = [place for seed in order for place in (seed, size - 1 - seed)]
    return [names[seed] if seed < len(names) else None for seed in order]


def _play_round(draw: _Draw, line: Sequence[str | None], around: int) -> Iterator[str | None]:
    """The winner of each meeting: None if nobody came, an empty name while it is open."""
    for number in range(len(line) // 2):
        there = [name for name in line[2 * number : 2 * number + 2] if name is not None]
        left = [name for name in there if around < draw.withdrawn.get(name, around + 1)]
        if len(left) == 2:
            yield _meet(draw, (around, number, left[0], left[1])) or ""
            continue
        draw.byes += [Bye(around, name) for name in left]
        yield left[0] if left else None


def _meet(draw: _Draw, meet: Meet) -> str | None:
    """Plan a meeting, extra pairs while it is drawn; its winner once that is known."""
    spec, (around, number, one, other) = draw.spec, meet
    pairs: list[Pair] = []
    start = _meetings_before(len(spec.entrants), around, number) * (spec.pairs + spec.extra_pairs)
    for index in range(spec.pairs + spec.extra_pairs):
        if index >= spec.pairs:
            (meeting,) = meetings(pairs, draw.games)
            if not meeting.complete or meeting.winner is not None:
                break
        pairs.append(pair_of(spec, meet, index, start + index))
        draw.pairs.append(pairs[-1])
    (meeting,) = meetings(pairs, draw.games)
    if not meeting.complete:
        return None
    if meeting.winner is not None:
        return meeting.winner
    if spec.drawn is Drawn.LOT:
        return (one, other)[lot(spec, f"meeting {around} {number}").below(2)]
    order = seeded(spec)
    return min((one, other), key=order.index)


def _meetings_before(entrants: int, around: int, number: int) -> int:
    """Meetings of the bracket before this one, byes counted: the numbers of pairs never shift."""
    size = 1 << (entrants - 1).bit_length()
    return sum(size >> (earlier + 1) for earlier in range(around)) + number
