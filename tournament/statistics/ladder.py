"""A ladder for standing servers: ratings that move with every game, whoever plays whom and whenever.

The model is Weng & Lin's Plackett-Luce ("A Bayesian approximation method for online ranking", Journal of Machine
Learning Research 12, 2011, 267-300), by the library openskill, with its defaults.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from tournament.results import GameResult


@dataclass(frozen=True, slots=True)
class Rung:
    """A player's place.

    Attributes:
        name: of the player; mu, sigma: mean and standard deviation of the believed skill, which begin at 25 and 25/3.
        ordinal: mu - 3 sigma, what the ladder is sorted by: a skill the player almost surely has.
        games: counted.
    """

    name: str
    mu: float
    sigma: float
    ordinal: float
    games: int

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        return {name: getattr(self, name) for name in self.__slots__}


def ladder(games: Iterable[GameResult]) -> tuple[Rung, ...]:
    """The ladder after these games, in the order in which they ended; the highest first."""
    from openskill.models import PlackettLuce

    model = PlackettLuce()
    skills: dict[str, Any] = {}
    played: dict[str, int] = {}
    for game in games:
        if not game.counts:
            continue
        teams = [[skills.setdefault(name, model.rating(name=name))] for name in game.players]
        after = model.rate(teams, scores=list(game.points))
        for name, team in zip(game.players, after, strict=True):
            skills[name] = team[0]
            played[name] = played.get(name, 0) + 1
    rungs = [Rung(name, one.mu, one.sigma, one.ordinal(), played[name]) for name, one in skills.items()]
    return tuple(sorted(rungs, key=lambda rung: (-rung.ordinal, rung.name)))
