"""Results put together: by pair, by meeting."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from tournament.pairings import LEGS, Pair
from tournament.results import GameResult

Key = tuple[str, int]
"""Pair id and leg."""


def counting(results: Iterable[GameResult]) -> dict[Key, GameResult]:
    """The result that counts for each game."""
    return {(one.pair, one.leg): one for one in results if one.counts}


@dataclass(slots=True)
class Meeting:
    """Two entrants in one round.

    Attributes:
        round, number: which meeting.
        players: names, in the order of the first pair.
        points: by name. games: played so far. complete: whether all pairs planned have been played.
    """

    round: int
    number: int
    players: tuple[str, str]
    points: dict[str, float] = field(default_factory=dict)
    games: int = 0
    complete: bool = True

    @property
    def winner(self) -> str | None:
        """Who has more points; None while they have equally many."""
        first, second = (self.points[name] for name in self.players)
        return None if first == second else self.players[0 if first > second else 1]

    def match_points(self, name: str) -> float:
        """1 for a meeting won, a half for a drawn one, 0 for one lost."""
        return 0.5 if self.winner is None else float(self.winner == name)


def meetings(pairs: Iterable[Pair], games: Mapping[Key, GameResult]) -> list[Meeting]:
    """The meetings these pairs make up, in order, with what has been played of them."""
    found: dict[tuple[int, int], Meeting] = {}
    for pair in pairs:
        place = pair.round, pair.meeting
        meeting = found.setdefault(place, Meeting(*place, pair.players, dict.fromkeys(pair.players, 0.0)))
        _add(meeting, pair, games)
    return list(found.values())


def _add(meeting: Meeting, pair: Pair, games: Mapping[Key, GameResult]) -> None:
    for leg in LEGS:
        game = games.get((pair.id, leg))
        if game is None:
            meeting.complete = False
            continue
        meeting.games += 1
        for name in game.players:
            meeting.points[name] += game.points_of(name)
