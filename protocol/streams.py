"""What spectators are told as server-sent events: how a game stands, its clocks, who is there, the result.

Strokes and decisions travel as the record's lines (`referee.record`), word for word.
"""

from protocol.games import GameStatus
from protocol.outcomes import OutcomeView
from protocol.terms import ClockView
from protocol.values import Digest, Flag, Identifier, Integer, Message, Number, Seat


class StreamClocks(Message):
    """Event ``clocks``: told whenever a clock starts or stops.

    Attributes:
        version: of the game. turn: the seat in turn; null when the game is over.
        clocks: by seat, as they stood when the event was sent.
    """

    version: Integer
    turn: Seat | None
    clocks: tuple[ClockView, ClockView]


class StreamConnections(Message):
    """Event ``connections``: who is there, by seat.

    An agent is there while it waits for its turn, while it thinks about a turn it has fetched, and for a few
    seconds after it was last heard of.
    """

    connected: tuple[Flag, Flag]


class StreamResult(Message):
    """Event ``result``: the game is over, and so is the stream.

    Attributes:
        score: of the match, by seat. noise_seed: revealed; null as in ``GameOver``. record: path of the record.
    """

    status: GameStatus
    outcome: OutcomeView
    score: tuple[Number, Number]
    noise_seed: Digest | None
    record: str


class ManyEvent(Message):
    """The data of an event in a stream of several games.

    Attributes:
        game: whose event it is. data: what the game's own stream would carry.
    """

    game: Identifier
    data: object


def of_many(game: str, data: str) -> str:
    """The JSON of a ``ManyEvent``, whose data is JSON already."""
    return f'{{"game":"{game}","data":{data}}}'
