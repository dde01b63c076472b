"""Standings: who is where, and what separates equal points."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from tournament.choices import Format, TieBreak
from tournament.formats.order import seeded
from tournament.results import GameResult
from tournament.tournament import Tournament


@dataclass(frozen=True, slots=True)
class Standing:
    """An entrant's line.

    Attributes:
        rank: from 1; equal in everything that counts means equal rank.
        name: of the entrant.
        points: what the rank goes by: points in games; in a Swiss, points in meetings; in a knockout, rounds survived.
        score: points in games, a half for a draw.
        games, wins, draws, losses: counted games.
        byes: rounds without an opponent (in a round robin, rests).
        tie_breaks: values of the event's tie-breaks, in their order.
        withdrawn: whether the entrant left before the end.
    """

    rank: int
    name: str
    points: float
    score: float
    games: int
    wins: int
    draws: int
    losses: int
    byes: int
    tie_breaks: tuple[float, ...]
    withdrawn: bool = False

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        values = {name: getattr(self, name) for name in self.__slots__}
        return values | {"tie_breaks": list(self.tie_breaks)}


def standings(event: Tournament) -> tuple[Standing, ...]:
    """The entrants, the best first; those of equal rank in the order of seeds."""
    table = _Crosstable(event)
    keys = {name: (table.points[name], *table.tie_breaks(name)) for name in seeded(event.spec)}
    ordered = sorted(keys, key=lambda name: keys[name], reverse=True)
    rank_of = {key: 1 + sum(other > key for other in keys.values()) for key in set(keys.values())}
    return tuple(table.line(name, rank_of[keys[name]], keys[name][1:]) for name in ordered)


class _Crosstable:
    """What the lines are computed from."""

    def __init__(self, event: Tournament) -> None:
        self._event = event
        self._games: dict[str, list[GameResult]] = {name: [] for name in event.spec.names}
        for game in event.counted:
            for name in game.players:
                self._games[name].append(game)
        self._byes = [bye.player for bye in event.byes if self._reached(bye.round)]
        self.points = {name: self._points(name) for name in event.spec.names}

    def line(self, name: str, rank: int, tie_breaks: tuple[float, ...]) -> Standing:
        """The finished line."""
        outcomes = [game.points_of(name) for game in self._games[name]]
        return Standing(
            rank=rank,
            name=name,
            points=self.points[name],
            score=sum(outcomes),
            games=len(outcomes),
            wins=outcomes.count(1.0),
            draws=outcomes.count(0.5),
            losses=outcomes.count(0.0),
            byes=self._byes.count(name),
            tie_breaks=tie_breaks,
            withdrawn=name in self._event.withdrawn,
        )

    def tie_breaks(self, name: str) -> tuple[float, ...]:
        """Values of the event's tie-breaks, greater is better."""
        rules: Mapping[TieBreak, Callable[[str], float]] = {
            TieBreak.DIRECT: self._direct,
            TieBreak.SONNEBORN_BERGER: self._sonneborn_berger,
            TieBreak.BUCHHOLZ: self._buchholz,
            TieBreak.WINS: lambda one: float(sum(game.points_of(one) == 1.0 for game in self._games[one])),
            TieBreak.SEED: lambda one: -float(seeded(self._event.spec).index(one)),
        }
        return tuple(rules[one](name) for one in self._event.spec.tie_breaks)

    def _reached(self, around: int) -> bool:
        """Whether a round has begun: a bye counts with the first result of its round, or when no game is in it."""
        inside = [pair for pair in self._event.pairs if pair.round == around]
        return not inside or any(self._event.of_pair(pair) for pair in inside)

    def _points(self, name: str) -> float:
        kind = self._event.spec.format
        if kind in (Format.ROUND_ROBIN, Format.GAUNTLET):
            return float(sum(game.points_of(name) for game in self._games[name]))
        complete = [one for one in self._event.meetings if one.complete and name in one.players]
        if kind is Format.SWISS:
            return sum(one.match_points(name) for one in complete) + self._byes.count(name)
        return float(self._event.plan.advanced.get(name, 0))

    def _direct(self, name: str) -> float:
        equal = {other for other, points in self.points.items() if points == self.points[name]}
        return float(sum(game.points_of(name) for game in self._games[name] if equal.issuperset(game.players)))

    def _sonneborn_berger(self, name: str) -> float:
        return sum(self._share(name, other) * self.points[other] for other in self._opponents(name))

    def _buchholz(self, name: str) -> float:
        return float(sum(self.points[other] for other in self._opponents(name)))

    def _opponents(self, name: str) -> list[str]:
        """Whom a player has met, in order, once each."""
        return list(dict.fromkeys(_opponent(game, name) for game in self._games[name]))

    def _share(self, name: str, other: str) -> float:
        """Share of the points taken from an opponent."""
        return _mean(game.points_of(name) for game in self._games[name] if _opponent(game, name) == other)


def _opponent(game: GameResult, name: str) -> str:
    return game.players[1 - game.players.index(name)]


def _mean(values: Iterable[float]) -> float:
    found = list(values)
    return sum(found) / len(found)
