"""The scalar types of the wire: finite numbers, true integers, ball and pocket numbers, points.

JSON has one number type; Python's readers also let NaN, text and booleans through. These types do not.
"""

import functools
from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints, WithJsonSchema

from physics.constants import N_BALLS, N_POCKETS
from physics.errors import InvalidState, InvalidTable
from physics.table import NAMED, Table


class Message(BaseModel):
    """Base of everything on the wire: immutable, no NaN, fields that are not known ignored when read.

    Answers grow by new fields; a client of today keeps reading them.
    """

    model_config = ConfigDict(frozen=True, allow_inf_nan=False, extra="ignore")


class Request(BaseModel):
    """Base of what clients send: as ``Message``, but a field that is not known is an error."""

    model_config = ConfigDict(frozen=True, allow_inf_nan=False, extra="forbid")


AnyMessage = TypeVar("AnyMessage", bound=BaseModel)


def trusted(kind: type[AnyMessage], **values: Any) -> AnyMessage:
    """A message of values known to be valid, every field among them: what ``model_construct`` makes, at a tenth."""
    message = kind.__new__(kind)
    _set(message, "__dict__", values)
    _set(message, "__pydantic_fields_set__", set(_names(kind)))
    _set(message, "__pydantic_extra__", None)
    _set(message, "__pydantic_private__", None)
    return message


_set = object.__setattr__


@functools.cache
def _names(kind: type[BaseModel]) -> frozenset[str]:
    return frozenset(kind.model_fields)


Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Integer = Annotated[int, Field(strict=True)]
Flag = Annotated[bool, Field(strict=True)]
Seat = Annotated[int, Field(strict=True, ge=0, le=1)]
BallNumber = Annotated[int, Field(strict=True, ge=0, lt=N_BALLS)]
ObjectBall = Annotated[int, Field(strict=True, ge=1, lt=N_BALLS)]
PocketNumber = Annotated[int, Field(strict=True, ge=0, lt=N_POCKETS)]
Point = tuple[Number, Number]
Identifier = Annotated[str, StringConstraints(min_length=1, max_length=64, pattern=r"^[A-Za-z0-9_.:-]+$")]
Digest = Annotated[str, StringConstraints(pattern=r"^[0-9a-f]{64}$")]
"""256 bits as 64 lower-case hexadecimal digits."""

_BALL_KEYS = {str(ball): ball for ball in range(N_BALLS)}


def _numbered_balls(value: Any) -> Any:
    """Turn the keys "0".."15" of a JSON object into ball numbers, and nothing else that looks like them."""
    if not isinstance(value, Mapping):
        return value
    balls = {}
    for key, position in value.items():
        ball = _BALL_KEYS.get(key) if isinstance(key, str) else key
        if isinstance(ball, bool) or not isinstance(ball, int) or not 0 <= ball < N_BALLS:
            raise InvalidState(str(key), position, f"balls are numbered 0 to {N_BALLS - 1}")
        balls[ball] = position
    return balls


Balls = Annotated[
    dict[int, Point],
    BeforeValidator(_numbered_balls),
    Field(
        description="Ball number to [x, y] in metres, for the balls on the table.",
        examples=[{"0": [0.5, 1.7], "3": [0.4, 0.6]}],
        json_schema_extra={"propertyNames": {"pattern": "^([0-9]|1[0-5])$"}},
    ),
]


def _table_values(value: Any) -> Any:
    """Write a table's name, or its name with changed parameters, out in full."""
    if isinstance(value, str):
        value = {"name": value}
    if not isinstance(value, Mapping):
        raise InvalidTable("table", value, "must be a table's name or an object with a name and parameters")
    return Table.from_dict(value).to_dict()


TableValues = Annotated[
    dict[str, str | bool | float],
    BeforeValidator(_table_values),
    WithJsonSchema(
        {
            "description": "A table's name, or an object with its name and parameters; those left out have "
            "the named table's value. Answers always carry every parameter.",
            "anyOf": [
                {"type": "string", "enum": list(NAMED)},
                {
                    "type": "object",
                    "properties": {"name": {"type": "string", "enum": list(NAMED)}},
                    "required": ["name"],
                    "additionalProperties": {"type": ["number", "string", "boolean"]},
                },
            ],
            "examples": ["olympiad", {"name": "olympiad", "mu_slide": 0.25}, "nine_foot"],
        }
    ),
]

RulesName = Literal["eight_ball"]
