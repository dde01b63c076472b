"""A game as it stands: in a list, and as a spectator or a player sees it."""

from datetime import datetime
from typing import Literal

from protocol.outcomes import OutcomeView
from protocol.values import Digest, Identifier, Integer, Message, Seat
from protocol.view import View

GameStatus = Literal["running", "finished", "aborted"]


class GameSummary(Message):
    """A game in a list.

    Attributes:
        breaker: the seat that broke, or will.
        commitment: of the match (docs/protocol.md, Commitment).
        noise_seed: from which the game's noise came, once the game is over; where noise is not told, once the match is
            over and the tournament that it belongs to.
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
    """``GET /v1/games/{id}``: the game as its player sees it when a player asks, else as a spectator sees it."""

    view: View
