"""The noise of an event: one level, several in turn, or a range that each pair's level is drawn from."""

from typing import Annotated, Any, Self

from pydantic import GetJsonSchemaHandler, PlainValidator, model_serializer, model_validator
from pydantic_core import CoreSchema

from referee.play.noise import LEVEL_MAX, OLYMPIAD_SIGMAS, NoiseModel, Sigmas
from tournament.errors import InvalidSpec
from tournament.validation import Flag, Value, items, number, value

MOST_LEVELS = 1000

Level = Annotated[float, number(0.0, LEVEL_MAX)]


def _sigmas(given: Any) -> Sigmas | None:
    return given if given is None or isinstance(given, Sigmas) else Sigmas.from_dict(given)


@value(InvalidSpec, "noise")
class NoisePlan(Value):
    """Which level each pair of games is played at; both games of a pair have the same.

    Attributes:
        levels: used in turn: the first pair of a meeting has the first level, and so on round. Factors on the
            Olympiad's standard deviations, in [0, 5].
        range: lowest and highest; each pair's level is drawn uniformly from it. Then ``levels`` is empty.
        told: whether the players are told the level of their game.
        sigmas: standard deviations at level 1, as ``referee.play.noise.Sigmas``; None for the Olympiad's.

    Raises:
        InvalidSpec: no levels, both levels and a range, a level outside [0, 5], or sigmas that cannot be.
    """

    levels: Annotated[tuple[Level, ...], items(0, MOST_LEVELS)] = (1.0,)
    range: Annotated[tuple[Level, Level], items(2, 2)] | None = None
    told: Flag = True
    sigmas: Annotated[Sigmas | None, PlainValidator(_sigmas)] = None

    @model_validator(mode="before")
    @classmethod
    def _short(cls, data: Any) -> Any:
        """A number alone is one level, told; a range takes the place of the levels."""
        if isinstance(data, int | float) and not isinstance(data, bool):
            return {"levels": (data,)}
        return {"levels": (), **data} if isinstance(data, dict) and "range" in data else data

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """An object, or the short form."""
        return {"anyOf": [{"type": "number", "minimum": 0, "maximum": LEVEL_MAX}, handler(schema)]}

    def __post_init__(self) -> None:
        if self.range is not None and self.range[0] > self.range[1]:
            raise InvalidSpec("range", self.range, "must be the lowest level, then the highest")
        if bool(self.levels) == (self.range is not None):
            raise InvalidSpec("", self.to_dict(), "must be either levels or a range")

    @classmethod
    def variable(cls, low: float = 0.0, high: float = LEVEL_MAX, *, told: bool = True) -> Self:
        """A level drawn for each pair."""
        return cls(levels=(), range=(low, high), told=told)

    @model_serializer
    def _either(self) -> dict[str, Any]:
        """``{"levels": [1.0], "told": true}`` or ``{"range": [0.0, 5.0], "told": true}``."""
        which: dict[str, Any] = {"levels": list(self.levels)} if self.range is None else {"range": list(self.range)}
        others = {} if self.sigmas is None else {"sigmas": self.sigmas.to_dict()}
        return which | {"told": self.told} | others

    def model(self, level: float) -> NoiseModel:
        """The noise of a game at one of the levels."""
        return NoiseModel(level, self.told, self.sigmas or OLYMPIAD_SIGMAS)

    def published(self) -> dict[str, Any]:
        """The same without levels that the players are not told."""
        return self.to_dict() if self.told else {"told": False}
