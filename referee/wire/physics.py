"""The physics alone, for any language: simulate, simulate a batch, least elevation."""

from typing import Annotated, Any

from pydantic import ConfigDict, Field
from pydantic.config import JsonDict

from referee.wire.outcomes import EventView
from referee.wire.shots import ShotParameters
from referee.wire.values import Balls, Flag, Identifier, Integer, Message, Number, Request, TableValues

BATCH_LIMIT = 10_000
"""Shots in one batch request: about a tenth of a second of one core."""

_SHOT: JsonDict = {"v": 2.0, "phi": 260.0, "theta": 8.0, "a": 0.0, "b": 3.0}
_BALLS: JsonDict = {"0": [0.5, 1.7], "3": [0.4, 0.6]}


GameOfCaller = Annotated[
    Identifier | None,
    Field(description="A running game of the caller's, whose budget of simulated shots this counts against."),
]


class SimulateRequest(Request):
    """``POST /v1/simulate``: one shot.

    Attributes:
        trace: whether to answer with the events.
    """

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"table": "olympiad", "balls": _BALLS, "shot": _SHOT, "trace": True}]}
    )

    table: Annotated[TableValues, Field(validate_default=True)] = "olympiad"  # type: ignore[assignment]
    balls: Balls
    shot: ShotParameters
    trace: Flag = True
    game: GameOfCaller = None


class SimulateAnswer(Message):
    """What the shot did.

    Attributes:
        status: by name; ``at_rest`` is the regular end.
        reason: the status in words.
        duration: s. balls: at the end.
        facts: what rules need, each with the ordinal of the event that proves it (docs/physics.md).
    """

    status: str
    reason: str
    duration: Number
    n_events: Integer
    balls: Balls
    facts: dict[str, Any]
    events: tuple[EventView, ...] | None


class BatchRequest(Request):
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

    table: Annotated[TableValues, Field(validate_default=True)] = "olympiad"  # type: ignore[assignment]
    balls: Balls | None = None
    tables: Annotated[tuple[Balls, ...], Field(max_length=BATCH_LIMIT)] | None = None
    shots: Annotated[tuple[ShotParameters, ...], Field(min_length=1, max_length=BATCH_LIMIT)]
    game: GameOfCaller = None


class BatchRow(Message):
    """One shot of a batch: where the balls lie, and the pocket of each that went down."""

    status: str
    duration: Number
    n_events: Integer
    balls: Balls
    pocketed: dict[int, int]


class BatchAnswer(Message):
    """One row for each shot, in order."""

    results: tuple[BatchRow, ...]


class MinElevationRequest(Request):
    """``POST /v1/min-elevation``: the least elevation of the cue at which a shot can be played."""

    model_config = ConfigDict(
        json_schema_extra={"examples": [{"table": "olympiad", "balls": _BALLS, "phi": 260.0, "a": 0.0, "b": 3.0}]}
    )

    table: Annotated[TableValues, Field(validate_default=True)] = "olympiad"  # type: ignore[assignment]
    balls: Balls
    phi: Number
    a: Number = 0.0
    b: Number = 0.0


class MinElevationAnswer(Message):
    """The least elevation, deg; null when there is none up to the table's greatest."""

    theta: Number | None
