"""What the columns of a report's tables mean."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

STANDINGS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "Points": "what the format counts: by games, or by meetings in a knockout",
        "Score": "points in games: a win 1, a draw a half",
        "Byes": "rounds without an opponent",
        "direct": "tie-break: points in the games of the tied among themselves",
        "sonneborn berger": "tie-break: points of the opponents, each times the share of the points taken from them",
        "buchholz": "tie-break: points of the opponents",
        "wins": "tie-break: games won",
    }
)

RATINGS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "Elo": "above the mean of all; 100 points more mean 64 % of the points",
        "from": "from … to, behind a value: its interval of 95 % confidence; of many such intervals some miss",
        "all: from": "wider intervals, every one of which holds, with 95 % confidence",
        "Rank": "the ranks that those leave open",
        "Pairs": "of games, with the same racks; intervals are over pairs",
    }
)

MEETINGS: Final[Mapping[str, str]] = MappingProxyType(
    {
        "Share": "of the points, a win 1 and a draw a half",
        "from": "from … to, behind a value: its interval of 95 % confidence, from pairs",
        "Elo": "the difference in rating that such a share means",
        "Superiority": "likelihood that the player named first is the better one",
    }
)

TIME: Final[Mapping[str, str]] = MappingProxyType(
    {
        "Seconds": "of thinking, in all games",
        "a game": "mean of the games",
        "a stroke": "mean of the strokes",
        "Simulated shots a game": "shots an agent looked at before it played, mean of the games",
    }
)

LUCKY: Final[Mapping[str, str]] = MappingProxyType(
    {
        "Share of points": "as played",
        "of it luck": "what noise gave, less what it gave the opponent",
        "without luck": "the share less luck",
        "from": "from … to, behind a value: its interval of 95 % confidence",
    }
)
