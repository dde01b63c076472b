"""Knockout: who loses a meeting is out. Seeded so that the best meet late; byes go to the best."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from tournament.choices import Drawn
from tournament.formats.order import Meet, pair_of, seeded
from tournament.pairings import LEGS, Bye, Pair, Plan
from tournament.results import GameResult
from tournament.scores import Key, meetings
from tournament.seeds import lot
from tournament.spec import Spec


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
        staying = [name for name in there if around < draw.withdrawn.get(name, around + 1)]
        if len(staying) == 2:
            yield _meet(draw, (around, number, there[0], there[1])) or ""
        elif len(there) == 2 and _begun(draw, _pair(draw, (around, number, there[0], there[1]), 0)):
            draw.pairs += _broken_off(draw, (around, number, there[0], there[1]))
            yield staying[0] if staying else None
        else:
            draw.byes += [Bye(around, name) for name in staying]
            yield staying[0] if staying else None


def _meet(draw: _Draw, meet: Meet) -> str | None:
    """Plan a meeting, extra pairs while it is drawn; its winner once that is known."""
    spec, (around, number, one, other) = draw.spec, meet
    pairs: list[Pair] = []
    for index in range(spec.pairs + spec.extra_pairs):
        if index >= spec.pairs:
            (meeting,) = meetings(pairs, draw.games)
            if not meeting.complete or meeting.winner is not None:
                break
        pairs.append(_pair(draw, meet, index))
    draw.pairs += pairs
    (meeting,) = meetings(pairs, draw.games)
    if not meeting.complete:
        return None
    if meeting.winner is not None:
        return meeting.winner
    if spec.drawn is Drawn.LOT:
        return (one, other)[lot(spec, f"meeting {around} {number}").below(2)]
    order = seeded(spec)
    return min((one, other), key=order.index)


def _broken_off(draw: _Draw, meet: Meet) -> Iterator[Pair]:
    """The pairs of a meeting that somebody left undecided: what was planned by then, all with results."""
    for index in range(draw.spec.pairs + draw.spec.extra_pairs):
        pair = _pair(draw, meet, index)
        if index < draw.spec.pairs or _begun(draw, pair):
            yield pair


def _begun(draw: _Draw, pair: Pair) -> bool:
    """Whether a game of a pair counts already."""
    return any((pair.id, leg) in draw.games for leg in LEGS)


def _pair(draw: _Draw, meet: Meet, index: int) -> Pair:
    """The ``index``-th pair of a meeting, extra pairs counted on."""
    spec, (around, number, _, _) = draw.spec, meet
    start = _meetings_before(len(spec.entrants), around, number) * (spec.pairs + spec.extra_pairs)
    return pair_of(spec, meet, index, start + index)


def _meetings_before(entrants: int, around: int, number: int) -> int:
    """Meetings of the bracket before this one, byes counted: the numbers of pairs never shift."""
    size = 1 << (entrants - 1).bit_length()
    return sum(size >> (earlier + 1) for earlier in range(around)) + number
