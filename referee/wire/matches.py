"""Matches: their terms, how they stand, and the games in them."""

from datetime import datetime
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from referee.wire.outcomes import OutcomeView
from referee.wire.positions import Position
from referee.wire.terms import ClockTerms, NoiseTerms, NoiseView
from referee.wire.values import (
    Digest,
    Flag,
    Identifier,
    Integer,
    Message,
    Number,
    Request,
    RulesName,
    Seat,
    TableValues,
)
from referee.wire.view import View

_OLYMPIAD = "olympiad"


class MatchRequest(Request):
    """``POST /v1/matches``: two agents and the terms.

    From an organiser the match starts at once. From one of the two agents it is a challenge, which the other
    accepts.

    Attributes:
        agents: ids, by seat.
        games: how many.
        seed: the secret match seed, 64 hexadecimal digits, from which racks, noise and the first breaker
            come. Only an organiser may give one, to repeat a match; otherwise the server draws it.
        start: where every game begins instead of a break; such a match is unrated.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {
                    "agents": ["a1", "a2"],
                    "games": 1,
                    "rules": "eight_ball",
                    "table": "olympiad",
                    "noise": {"level": 1.0, "told": True},
                    "clock": {"seconds": 300.0},
                }
            ]
        }
    )

    agents: tuple[Identifier, Identifier]
    games: Annotated[Integer, Field(ge=1, le=1000)] = 1
    rules: RulesName = "eight_ball"
    table: Annotated[TableValues, Field(validate_default=True)] = _OLYMPIAD  # type: ignore[assignment]
    noise: NoiseTerms = NoiseTerms()
    clock: ClockTerms = ClockTerms()
    seed: Digest | None = None
    start: Position | None = None


MatchStatus = Literal["challenged", "running", "finished", "aborted"]
GameStatus = Literal["running", "finished", "aborted"]


class GameSummary(Message):
    """A game in a list.

    Attributes:
        breaker: the seat that broke, or will.
        commitment: SHA-256 of the noise seed; noise_seed: the seed itself, once the game is over.
    """

    id: Identifier
    match: Identifier
    number: Integer
    status: GameStatus
    breaker: Seat
    commitment: Digest
    noise_seed: Digest | None
    strokes: Integer
    outcome: OutcomeView | None
    started_at: datetime
    finished_at: datetime | None


class GameAnswer(GameSummary):
    """``GET /v1/games/{id}``: the game as a spectator sees it, or as the caller does who plays in it."""

    view: View


class MatchView(Message):
    """A match.

    Attributes:
        agents: ids, by seat; players: their names.
        first_breaker: the seat that breaks the first game; the break then alternates.
        score: games won by seat, half a point for a draw.
        winner: seat, when finished and not drawn.
        challenger: seat of the agent who challenged; null for a match by an organiser.
        start: the position the games begin from; null when they begin with a break.
        rated: whether the match counts for ratings; from a given position none does.
    """

    id: Identifier
    status: MatchStatus
    agents: tuple[Identifier, Identifier]
    players: tuple[str, str]
    games: Integer
    rules: RulesName
    table: TableValues
    noise: NoiseView
    clock: ClockTerms
    challenger: Seat | None
    first_breaker: Seat | None
    score: tuple[Number, Number]
    winner: Seat | None
    played: tuple[GameSummary, ...]
    start: Position | None
    rated: Flag
    created_at: datetime


class MatchList(Message):
    """Matches, the newest first."""

    matches: tuple[MatchView, ...]
    next_cursor: str | None = None
