"""Matches: their terms, and how they stand."""

from datetime import datetime
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from protocol.games import GameSummary
from protocol.positions import Position
from protocol.terms import ClockTerms, NoiseTerms, NoiseView
from protocol.values import (
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

_OLYMPIAD = "olympiad"

LONGEST_OPENING = 60.0
"""Seconds that a match may wait for the players' seeds."""


class RackTerms(Request):
    """Which racks are to be equal.

    Attributes:
        seed: a secret, 64 hexadecimal digits, from which the racks come. Matches that share it have the same
            racks; their noise is each match's own, and whoever knows this seed knows nothing of it. Only an
            organiser may give one; otherwise the racks come from the match seed and the players' seeds.
        paired: games 0 and 1, 2 and 3, … of the match have the same racks, the break being swapped.
    """

    seed: Digest | None = None
    paired: Flag = False


class RackView(Message):
    """The same as everybody may know it.

    Attributes:
        shared: the racks come from a secret that other matches may share.
    """

    shared: Flag
    paired: Flag


class MatchRequest(Request):
    """``POST /v1/matches``: two agents and the terms.

    From an organiser the match starts at once. From one of the two agents it is a challenge, which the other
    accepts.

    Attributes:
        agents: ids, by seat.
        games: how many.
        seed: left out, so that the server draws 256 bits. Only an organiser may choose one (64 hexadecimal digits), to
            repeat a match in a test: racks, noise and the first breaker follow from it, the match is marked
            ``foreseeable`` and counts for no rating.
        start: where every game begins instead of a break; such a match is unrated.
        rated: whether the match is to count for ratings; one from a position, with a chosen seed or with a house bot
            does not, whatever is asked for (an organiser's with a house bot does).
        racks: which are to be equal.
        first_breaker: seat; drawn unless an organiser gives it.
        client_seed_seconds: how long the players may add seeds of their own before the first rack; 0 starts the
            match without waiting. It starts at once when both have.
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
    rated: Flag = True
    racks: RackTerms = RackTerms()
    first_breaker: Seat | None = None
    client_seed_seconds: Annotated[Number, Field(ge=0, le=LONGEST_OPENING)] = 0.0


class ClientSeedRequest(Request):
    """``POST /v1/matches/{id}/seed``: what a player adds to the draw.

    Attributes:
        seed: 256 random bits, drawn after the commitment was read.
    """

    model_config = ConfigDict(json_schema_extra={"examples": [{"seed": "5f" * 32}]})

    seed: Digest


class AcceptRequest(Request):
    """``POST /v1/matches/{id}/accept``; the body may be left out.

    Attributes:
        client_seed: what the accepting player adds to the draw.
    """

    model_config = ConfigDict(json_schema_extra={"examples": [{"client_seed": "5f" * 32}, {}]})

    client_seed: Digest | None = None


MatchStatus = Literal["challenged", "opening", "running", "finished", "aborted"]


class MatchView(Message):
    """A match.

    Attributes:
        agents: ids, by seat; players: their names.
        commitment: to the secrets of the match and its terms, fixed before any seed of the players.
        client_seeds: what the players added to the draw, by seat; client_seed_seconds: how long they may.
        racks: which are equal.
        first_breaker: the seat that breaks the first game, once it has begun; the break then alternates.
        score: games won by seat, half a point for a draw.
        winner: seat, when finished and not drawn.
        challenger: seat of the agent who challenged; null for a match by an organiser.
        start: the position the games begin from; null when they begin with a break.
        rated: whether the match counts for ratings.
        foreseeable: somebody chose its seed, and knew its racks and noise in advance; then it is not rated.
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
    commitment: Digest
    client_seeds: tuple[Digest | None, Digest | None]
    client_seed_seconds: Number
    racks: RackView
    first_breaker: Seat | None
    score: tuple[Number, Number]
    winner: Seat | None
    played: tuple[GameSummary, ...]
    start: Position | None
    rated: Flag
    foreseeable: Flag = False
    created_at: datetime


class MatchList(Message):
    """Matches, the newest first."""

    matches: tuple[MatchView, ...]
    next_cursor: str | None = None
