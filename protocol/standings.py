"""How an event's entrants stand: points, ratings, the sequential test."""

from typing import Literal

from protocol.values import Flag, Identifier, Integer, Message, Number

TournamentStatus = Literal["created", "running", "paused", "finished", "aborted"]


class StandingView(Message):
    """An entrant's line: rank from 1, points, games counted, and the values of the tie-breaks in their order."""

    rank: Integer
    name: str
    agent: Identifier
    points: Number
    score: Number
    games: Integer
    wins: Integer
    draws: Integer
    losses: Integer
    byes: Integer
    tie_breaks: tuple[Number, ...]
    withdrawn: Flag


class SequentialTestView(Message):
    """A sequential test: its verdict (``open``, ``elo0``, ``elo1``), the log-likelihood ratio, pairs it has seen."""

    verdict: str
    llr: Number
    bounds: tuple[Number, Number]
    pairs: Integer


class RatingView(Message):
    """An entrant's rating (Bradley and Terry): Elo points above the mean, with its interval of 95 % confidence."""

    name: str
    elo: Number
    low: Number
    high: Number
    games: Integer


class StandingsView(Message):
    """``GET /v1/tournaments/{id}/standings``.

    Attributes:
        standings: the best first.
        ratings: likewise; nobody's while no game counts, nor in an event that can be foreseen.
    """

    tournament: Identifier
    status: TournamentStatus
    standings: tuple[StandingView, ...]
    ratings: tuple[RatingView, ...]
    test: SequentialTestView | None
