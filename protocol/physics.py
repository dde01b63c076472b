"""The physics alone, for any language: simulate, simulate a batch, least elevation."""

from functools import cached_property
from typing import (
    Annotated,
    NotRequired,  # pydantic wants these below Python 3.12
    Self,
)

from pydantic import ConfigDict, Field, model_validator
from pydantic.config import JsonDict
from typing_extensions import TypedDict

from physics.constants import N_BALLS
from physics.table import Table
from protocol.outcomes import EventView
from protocol.shots import ShotParameters
from protocol.values import Balls, Flag, Identifier, Integer, Message, Number, Request, TableValues

BATCH_LIMIT = 10_000
"""Shots in one batch request: about a tenth of a second of one core."""

_SHOT: JsonDict = {"v": 2.0, "phi": 260.0, "theta": 8.0, "a": 0.0, "b": 3.0}
_BALLS: JsonDict = {"0": [0.5, 1.7], "3": [0.4, 0.6]}


GameOfCaller = Annotated[
    Identifier | None,
    Field(description="A running game of the caller's, whose budget of simulated shots this counts against."),
]


class Scene(Request):
    """What every question to the physics is about: a table and, unless each shot has its own, the balls on it."""

    table: Annotated[TableValues, Field(validate_default=True)] = "olympiad"  # type: ignore[assignment]

    @cached_property
    def table_model(self) -> Table:
        """The table, as the physics takes it."""
        return Table.from_dict(self.table)


class SimulateRequest(Scene):
    """``POST /v1/simulate``: one shot.

    Attributes:
        trace: whether to answer with the events.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"table": "olympiad", "balls": _BALLS, "shot": _SHOT, "trace": True}]}
    )

    balls: Balls
    shot: ShotParameters
    trace: Flag = True
    game: GameOfCaller = None

    @model_validator(mode="after")
    def _shot_is_in_range(self) -> Self:
        self.shot.refuse_beyond(self.table_model, "shot")
        return self


Ordinal = Annotated[Integer, Field(description="An event's `index`; -1 when it did not happen.")]
PerBall = Annotated[
    tuple[Integer, ...], Field(min_length=N_BALLS, max_length=N_BALLS, description="16 numbers, ball 0 first.")
]


class FactsView(TypedDict):
    """What rules need to know about a shot (``physics.Facts``).

    Attributes:
        status: as in the answer. n_events, duration: likewise.
        crossed_head_string: the event from which on the cue ball's centre was first not behind the head string.
        crossed_before_contact: the same, but before the first contact.
        first_contact: the collision in which the cue ball struck this ball first.
        cushion: the first collision of each ball with a cushion. cushion_after_contact: after the first contact.
        pocketed: the event by which each ball went down. pocket: which pocket, 0 to 5, or -1.
        off_table: the event by which the ball left the table.
        frozen_to_cushion, frozen_to_cue_ball: 1 where the ball touched a cushion, the cue ball, at the start; else 0.
        miscue: 1 if the tip slipped off the cue ball, else 0; only of tables with jaws, whose cue has an end mass.
        first_contact_cue_ball: (x, y) m, the cue ball's centre at first contact; nulls if there was none.
    """

    status: str
    n_events: Integer
    crossed_head_string: Ordinal
    crossed_before_contact: Ordinal
    first_contact: PerBall
    cushion: PerBall
    cushion_after_contact: PerBall
    pocketed: PerBall
    pocket: PerBall
    off_table: PerBall
    frozen_to_cushion: PerBall
    frozen_to_cue_ball: PerBall
    miscue: NotRequired[Integer]
    duration: Number
    first_contact_cue_ball: tuple[Number | None, Number | None]


class SimulateAnswer(Message):
    """What the shot did.

    Attributes:
        status: by name; ``at_rest`` is the regular end.
        reason: the status in words.
        duration: s. n_events: the cue strike included. balls: those on the table at the end, m.
        facts: what rules need, each with the ordinal of the event that proves it (docs/physics.md).
        events: what happened, in order; null without a trace.
    """

    status: str
    reason: str
    duration: Number
    n_events: Integer
    balls: Balls
    facts: FactsView
    events: tuple[EventView, ...] | None


class BatchRequest(Scene):
    """``POST /v1/simulate/batch``: many shots at one table, or each at its own.

    Attributes:
        balls: one table for all shots; or else
        tables: one for each shot.
        shots: up to 10,000.
    """

    model_config = ConfigDict(
        json_schema_extra={
            "examples": [
                {"table": "olympiad", "balls": _BALLS, "shots": [_SHOT, _SHOT | {"phi": 261.0}]},
                {"table": "olympiad", "tables": [_BALLS], "shots": [_SHOT]},
            ]
        }
    )

    balls: Balls | None = None
    tables: Annotated[tuple[Balls, ...], Field(max_length=BATCH_LIMIT)] | None = None
    shots: Annotated[tuple[ShotParameters, ...], Field(min_length=1, max_length=BATCH_LIMIT)]
    game: GameOfCaller = None

    @model_validator(mode="after")
    def _shots_are_in_range(self) -> Self:
        for index, shot in enumerate(self.shots):
            shot.refuse_beyond(self.table_model, f"shots.{index}")
        return self


class BatchRow(Message):
    """One shot of a batch.

    Attributes:
        status: by name; ``at_rest`` is the regular end. duration: s. n_events: the cue strike included.
        balls: those on the table at the end, m. pocketed: the pocket, 0 to 5, of each ball that went down.
    """

    status: str
    duration: Number
    n_events: Integer
    balls: Balls
    pocketed: dict[int, int]


class BatchAnswer(Message):
    """One row for each shot, in order."""

    results: tuple[BatchRow, ...]


class MinElevationRequest(Scene):
    """``POST /v1/min-elevation``: the least elevation of the cue at which a shot can be played."""

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"table": "olympiad", "balls": _BALLS, "phi": 260.0, "a": 0.0, "b": 3.0}]}
    )

    balls: Balls
    phi: Number
    a: Number = 0.0
    b: Number = 0.0


class MinElevationAnswer(Message):
    """The least elevation, deg; null when there is none up to the table's greatest."""

    theta: Number | None
