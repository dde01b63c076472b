"""Answers to strokes, and the history of a game in pages."""

from typing import Annotated

from pydantic import Field

from protocol.strokes import StrokeDetail
from protocol.terms import ClockView
from protocol.values import Identifier, Integer, Message
from protocol.view import View


class StrokeAnswer(Message):
    """The answer to a shot, a decision or a concession.

    Attributes:
        stroke: what was asked for, what was played, its events and the ruling.
        view: the game as the caller sees it now.
        clocks: by seat, this stroke's time charged.
    """

    game: Identifier
    stroke: StrokeDetail
    view: View
    clocks: tuple[ClockView, ClockView]


class MinimalAnswer(Message):
    """The answer to an action that was sent with ``Prefer: return=minimal`` (RFC 7240).

    Attributes:
        view: the game as the caller sees it now, its strokes the last of the caller's and what followed.
    """

    game: Identifier
    view: View


class ShotsPage(Message):
    """``GET /v1/games/{id}/shots``: strokes in order.

    Attributes:
        next_cursor: send it as ``cursor`` for the next page; null when there is nothing more yet.
    """

    shots: tuple[StrokeDetail, ...]
    next_cursor: Annotated[Integer | None, Field(examples=[20])]
