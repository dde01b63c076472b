"""The ladder of a server: its agents by what their rated games prove."""

from pydantic import Field

from protocol.values import Flag, Identifier, Integer, Message, Number


class RungView(Message):
    """An agent's place.

    Attributes:
        agent: its id. name: its name. house: whether the server runs it.
        rank: from 1.
        mu, sigma: mean and standard deviation of the believed skill, which begin at 25 and 25/3 (Weng & Lin's
            Plackett-Luce, docs/tournaments.md).
        ordinal: mu - 3 sigma, what the ladder is sorted by.
        games: counted.
        present: whether it is connected.
    """

    agent: Identifier
    name: str
    house: Flag
    rank: Integer
    mu: Number
    sigma: Number
    ordinal: Number
    games: Integer
    present: Flag


class Ladder(Message):
    """The agents that have played a rated game, the highest first.

    Attributes:
        rungs: at most the first 200.
        games: how many are counted: the newest rated games, in the order in which they ended.
    """

    rungs: tuple[RungView, ...]
    games: Integer = Field(description="Rated games that are counted.")
