"""The best strokes of the games that ended last."""

from protocol.values import Identifier, Integer, Message, Number, Seat


class BestStroke(Message):
    """The stroke of a game that raised the chance of its player to win the most.

    Attributes:
        game: its id. match: that of its match.
        players: names, by seat.
        number: of the stroke, from 0, as in the game's history.
        seat: whose stroke it was.
        before, after: that player's chance to win, by the value function of the luck report (docs/tournaments.md).
        words: the referee's sentence, in which players are seats.
    """

    game: Identifier
    match: Identifier
    players: tuple[str, str]
    number: Integer
    seat: Seat
    before: Number
    after: Number
    words: str


class BestStrokes(Message):
    """One stroke of each of the newest games that has one, the best first.

    Attributes:
        strokes: that made the called ball; none that ended its game, and no break.
    """

    strokes: tuple[BestStroke, ...]
