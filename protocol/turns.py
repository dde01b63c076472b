"""Messages of the long-poll ``GET /v1/turns``."""

from typing import Annotated, Literal

from pydantic import Field, TypeAdapter

from protocol.outcomes import OutcomeView
from protocol.values import Digest, Flag, Identifier, Integer, Message, Number, Seat
from protocol.view import View


class Turn(Message):
    """It is the caller's turn."""

    type: Literal["turn"] = "turn"
    game: Identifier
    view: View


class GameOver(Message):
    """A game of the caller has ended; the message is delivered once.

    Attributes:
        noise_seed: from which the game's noise came, revealed; the record leads from it to the commitment. Null while
            the match, or its tournament, is on with a level of noise that is not told.
        record: path of the record.
    """

    type: Literal["game_over"] = "game_over"
    game: Identifier
    match: Identifier
    number: Integer
    seat: Seat
    outcome: OutcomeView
    won: Flag | None
    score: tuple[Number, Number]
    noise_seed: Digest | None
    record: str
    view: View


class MatchOver(Message):
    """A match of the caller has ended; the message is delivered once.

    Attributes:
        score: by seat. winner: seat; null for a drawn or aborted match.
        status: ``finished`` or ``aborted``.
    """

    type: Literal["match_over"] = "match_over"
    match: Identifier
    seat: Seat
    status: Literal["finished", "aborted"]
    winner: Seat | None
    score: tuple[Number, Number]


class SeedWanted(Message):
    """A match of the caller is about to start, and its players may add to the draw; delivered once.

    Attributes:
        commitment: what the match is committed to already.
        seconds: how long the match waits for a seed.
    """

    type: Literal["seed_wanted"] = "seed_wanted"
    match: Identifier
    seat: Seat
    commitment: Digest
    seconds: Number


TurnMessage = Annotated[Turn | SeedWanted | GameOver | MatchOver, Field(discriminator="type")]

TURN_MESSAGE: TypeAdapter[Turn | SeedWanted | GameOver | MatchOver] = TypeAdapter(TurnMessage)
"""Reads any of them by its ``type``."""
