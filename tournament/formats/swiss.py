"""Swiss: a fixed number of rounds; whoever stands equal meets, nobody twice while that can be avoided.

Like the Dutch system (FIDE Handbook C.04.3) in its aims, not in its procedure: each round is the cheapest perfect
matching of the entrants, found exactly (Edmonds 1965, Galil 1986, networkx), where one rematch costs more than
everything below it, then differences in match points, then the distance from the fold of a score group (top
half against bottom half). With an odd number the bye is one more place in the matching, which nobody takes twice
while that can be avoided and which goes to the lowest standing otherwise. The break needs no balancing: every
pair of games has both.
"""

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import combinations

from tournament.formats.order import Meet, numbered, seeded
from tournament.pairings import Bye, Pair, Plan
from tournament.results import GameResult
from tournament.scores import Key, meetings
from tournament.spec import Spec

_BYE = -1
"""The place of the bye in a matching."""


@dataclass(slots=True)
class _ScoreGroups:
    """How the entrants stand before a round."""

    names: list[str]
    points: dict[str, float] = field(default_factory=dict)
    met: Counter[frozenset[str]] = field(default_factory=Counter)
    rested: Counter[str] = field(default_factory=Counter)


def plan_swiss(spec: Spec, games: Mapping[Key, GameResult], withdrawn: Mapping[str, int]) -> Plan:
    """The rounds that follow from complete ones; a round is paired when the one before it is complete."""
    table = _ScoreGroups(seeded(spec), dict.fromkeys(spec.names, 0.0))
    pairs: list[Pair] = []
    byes: list[Bye] = []
    for around in range(spec.rounds or 0):
        couples, resting = pair_round(table, [name for name in table.names if around < withdrawn.get(name, around + 1)])
        drawn = _pairs(spec, around, couples, len(pairs))
        pairs += drawn
        byes += [Bye(around, name) for name in resting]
        if not _score(table, drawn, resting, games):
            return Plan(tuple(pairs), tuple(byes), complete=around == (spec.rounds or 0) - 1)
    return Plan(tuple(pairs), tuple(byes))


def _pairs(spec: Spec, around: int, couples: Sequence[tuple[str, str]], start: int) -> list[Pair]:
    meets: list[Meet] = [(around, number, one, other) for number, (one, other) in enumerate(couples)]
    return list(numbered(spec, meets, start))


def _score(table: _ScoreGroups, drawn: list[Pair], resting: Sequence[str], games: Mapping[Key, GameResult]) -> bool:
    """Put a round into the table; False if it is not complete, and then nothing is counted."""
    played = meetings(drawn, games)
    if not all(meeting.complete for meeting in played):
        return False
    for meeting in played:
        table.met[frozenset(meeting.players)] += 1
        for name in meeting.players:
            table.points[name] += meeting.match_points(name)
    for name in resting:
        table.points[name] += 1.0
        table.rested[name] += 1
    return True


def pair_round(table: _ScoreGroups, names: Sequence[str]) -> tuple[list[tuple[str, str]], list[str]]:
    """The couples of a round, the best placed first, and who rests (one, if the number is odd)."""
    ranked = sorted(names, key=lambda name: -table.points[name])  # stable: equal points keep the order of seeds
    partner = _matching(table, ranked)
    couples = [(ranked[i], ranked[j]) for i, j in sorted(partner.items()) if _BYE < i < j]
    return couples, [ranked[i] for i, j in partner.items() if j == _BYE]


def _matching(table: _ScoreGroups, ranked: Sequence[str]) -> dict[int, int]:
    """The cheapest perfect matching of the places in ``ranked``, and the bye if their number is odd."""
    places = [*range(len(ranked)), *([_BYE] if len(ranked) % 2 else [])]
    folds = _folds(table, ranked)
    edges = tuple(
        (one, other, _bye_cost(table, ranked, one) if other == _BYE else _cost(table, ranked, folds, one, other))
        for one, other in combinations(places, 2)
    )
    return {place: mate for one, other in _cheapest(edges) for place, mate in ((one, other), (other, one))}


@lru_cache(maxsize=64)
def _cheapest(edges: tuple[tuple[int, int, int], ...]) -> frozenset[tuple[int, int]]:
    """The perfect matching of least cost; kept, because rounds that are over are asked for again and again."""
    import networkx  # half a second that only a Swiss pays

    graph = networkx.Graph()
    most = max((cost for _, _, cost in edges), default=0) + 1
    for one, other, cost in edges:
        graph.add_edge(one, other, weight=most - cost)
    return frozenset(networkx.max_weight_matching(graph, maxcardinality=True))


def _folds(table: _ScoreGroups, ranked: Sequence[str]) -> list[int]:
    """For each place, how far down its opponent should be: half of its score group."""
    sizes = Counter(table.points[name] for name in ranked)
    return [max(1, sizes[table.points[name]] // 2) for name in ranked]


def _cost(table: _ScoreGroups, ranked: Sequence[str], folds: list[int], i: int, j: int) -> int:
    """What pairing the places i < j costs, in integers, so that nothing is lost to rounding."""
    one, other = ranked[i], ranked[j]
    apart = round(2 * abs(table.points[one] - table.points[other])) ** 2
    return _weigh(len(ranked), table.met[frozenset((one, other))], apart, abs(j - i - folds[i]))


def _bye_cost(table: _ScoreGroups, ranked: Sequence[str], i: int) -> int:
    """What it costs to let place i rest."""
    apart = round(2 * (table.points[ranked[i]] - table.points[ranked[-1]])) ** 2
    return _weigh(len(ranked), table.rested[ranked[i]], apart, len(ranked) - 1 - i)


def _weigh(n: int, again: int, apart: int, fold: int) -> int:
    """One number in which each part outweighs all that follows, summed over a whole round."""
    again, apart = min(again, _OFTEN), min(apart, _FAR)
    return (again * (_FAR + 1) * n + apart) * (n + 1) ** 2 + fold


_OFTEN, _FAR = 1000, (2 * 1000) ** 2
"""Bounds: as many rounds as a spec can have."""
