"""The ledger of a game's clocks, and the ends that a supervisor decides."""

from datetime import datetime
from typing import Annotated, Literal

from pydantic import ConfigDict, Field

from protocol.terms import ClockView
from protocol.values import Identifier, Integer, Message, Number, Request, Seat


class ChargeView(Message):
    """One turn that is over: ``charged_ns`` is ``measured_ns`` less ``lag_ns`` and ``grace_ns``.

    Attributes:
        move: the number of the stroke or decision that ended it; null when it ended from outside.
        measured_ns: how long it took, by the server's clock, from the moment it was available.
        lag_ns: what of it was given back for the way to the server and back.
        grace_ns: what of it was given back for the wait until its player fetched it.
    """

    seat: Seat
    move: Integer | None
    measured_ns: Integer
    lag_ns: Integer
    grace_ns: Integer = 0
    charged_ns: Integer
    at: datetime


class SeatLedger(Message):
    """What a player was charged in all turns that are over, and how many shots it simulated."""

    charged_ns: Integer
    lag_ns: Integer
    grace_ns: Integer = 0
    simulated: Integer


class ClockLedger(Message):
    """``GET /v1/games/{id}/clock``: everything that was charged, and the terms of it.

    Attributes:
        seconds, simulations: of each player; null simulations: any number.
        lag_turn_seconds, lag_game_seconds: given back at most for a turn, and to one player in a game.
        grace_seconds, grace_game_seconds: likewise for the wait until a turn is fetched.
        no_show_seconds: a player's first turn may lie unfetched for so long.
        clocks: as they stand now. players, charges: as charged so far, the running turn not counted.
    """

    game: Identifier
    seconds: Number
    simulations: Integer | None
    lag_turn_seconds: Number
    lag_game_seconds: Number
    grace_seconds: Number
    grace_game_seconds: Number = 0.0
    no_show_seconds: Number
    clocks: tuple[ClockView, ClockView]
    players: tuple[SeatLedger, SeatLedger]
    charges: tuple[ChargeView, ...]


SupervisorsReason = Literal["crash", "stall", "no_show", "forfeit"]


class ForfeitRequest(Request):
    """``POST /v1/games/{id}/forfeit``: the organiser ends a game against one of its players.

    Attributes:
        reason: what whoever supervises the players saw: ``crash`` (the program ended), ``stall`` (it runs and does
            nothing), ``no_show`` (it never started), ``forfeit`` (anything else: it broke the terms, it was withdrawn).
    """

    model_config = ConfigDict(json_schema_extra={"examples": [{"seat": 0, "reason": "crash"}]})

    seat: Annotated[Seat, Field(description="Of the player who loses.")]
    reason: SupervisorsReason = "forfeit"
