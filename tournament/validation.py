"""Values that check themselves: pydantic dataclasses, whose refusals name field, value and what is allowed.

``tournament.errors`` has the errors. The words follow one grammar: ``pairs = 0: must be an integer from 1 to 100000``.
"""

from collections.abc import Callable, Mapping
from dataclasses import field, fields
from enum import StrEnum
from typing import Annotated, Any, ClassVar, Self, TypeVar, dataclass_transform

from pydantic import BeforeValidator, ConfigDict, GetCoreSchemaHandler, ValidationError, model_validator
from pydantic.dataclasses import dataclass
from pydantic_core import ArgsKwargs, CoreSchema, core_schema

from physics.errors import FieldError

NAME_LENGTH = 64
"""Letters in the name of an entrant or an event: more would break every table it stands in."""

Refusal = Callable[[str, Any, str], Exception]
"""Makes the error for a field, its value and what is allowed."""

_V = TypeVar("_V", bound="Value")


class Must:
    """In ``Annotated``: whatever is wrong with a field, its error says what the field must be."""

    def __init__(self, be: str, schema: CoreSchema | None = None) -> None:
        self._words, self._schema = f"must be {be}", schema

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """The schema of the annotated type, or the one given, with one message for everything."""
        schema = self._schema or handler(source)
        return core_schema.custom_error_schema(schema, "must", custom_error_message=self._words.replace("{", "{{"))


def integer(low: int, high: int) -> Must:
    """An integer from ``low`` to ``high``; true is none."""
    return Must(f"an integer from {low} to {high}", core_schema.int_schema(strict=True, ge=low, le=high))


def number(low: float, high: float) -> Must:
    """A finite number from ``low`` to ``high``."""
    schema = core_schema.float_schema(strict=True, allow_inf_nan=False, ge=low, le=high)
    return Must(f"a number from {low:g} to {high:g}", schema)


def above(low: float, high: float) -> Must:
    """A finite number above ``low``, at most ``high``."""
    schema = core_schema.float_schema(strict=True, allow_inf_nan=False, gt=low, le=high)
    return Must(f"a number above {low:g}, at most {high:g}", schema)


def one_of(kind: type[StrEnum]) -> Must:
    """A member of an enumeration, or its value."""
    return Must(f"one of {', '.join(kind)}")


def text(longest: int) -> Must:
    """Any text of at most ``longest`` letters."""
    return Must(f"a text of at most {longest} letters", core_schema.str_schema(strict=True, max_length=longest))


def items(low: int, high: int) -> BeforeValidator:
    """A list or tuple of so many things."""
    count = str(low) if low == high else f"{low} to {high}"

    def listed(value: Any) -> Any:
        if not isinstance(value, list | tuple) or not low <= len(value) <= high:
            raise FieldError("", value, f"must be a list of {count}")
        return value

    return BeforeValidator(listed)


def _visible(value: str) -> str:
    if not value.isprintable() or value != value.strip():
        raise ValueError
    return value


Flag = Annotated[bool, Must("true or false", core_schema.bool_schema(strict=True))]
Name = Annotated[
    str,
    Must(
        f"1 to {NAME_LENGTH} printable letters, no space at the ends",
        core_schema.no_info_after_validator_function(
            _visible, core_schema.str_schema(strict=True, min_length=1, max_length=NAME_LENGTH)
        ),
    ),
]


@dataclass(frozen=True, slots=True, config=ConfigDict(extra="forbid"))
class Value:
    """Base of the classes that ``value`` makes."""

    _refusal: ClassVar[Refusal]
    _name: ClassVar[str]
    _is_part: ClassVar[bool]

    def to_dict(self) -> dict[str, Any]:
        """JSON form."""
        found: dict[str, Any] = self.__pydantic_serializer__.to_python(self, mode="json")  # type: ignore[attr-defined]
        return found

    @classmethod
    def from_dict(cls, data: Any) -> Self:
        """Read what ``to_dict`` wrote, a JSON object or a TOML table; what has a default may be missing."""
        try:
            return cls.__pydantic_validator__.validate_python(data)  # type: ignore[attr-defined, no-any-return]
        except ValidationError as error:
            raise _refused(cls, error) from None

    @model_validator(mode="before")
    @classmethod
    def _known_fields(cls, data: Any) -> Any:
        known = [one.name for one in fields(cls)]
        given: Any = data.kwargs if isinstance(data, ArgsKwargs) else data
        for key in given if isinstance(given, Mapping) else ():
            if key not in known:
                raise FieldError(_named(key), given[key], f"must be left out; the fields are {', '.join(known)}")
        return data


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def value(refusal: Refusal, name: str, *, is_part: bool = True) -> Callable[[type[_V]], type[_V]]:
    """A decorator: an immutable pydantic dataclass.

    Args:
        refusal: makes the error for what cannot be.
        name: what an instance is called in errors.
        is_part: its fields are named after it, ``noise.levels``; else by themselves, ``pairs``.
    """

    def made(cls: type[_V]) -> type[_V]:
        new: Any = dataclass(frozen=True, slots=True, config=ConfigDict(extra="forbid"))(cls)
        new._refusal, new._name, new._is_part, check = staticmethod(refusal), name, is_part, new.__init__

        def __init__(self: Any, *args: Any, **values: Any) -> None:  # noqa: N807
            try:
                check(self, *args, **values)
            except ValidationError as error:
                raise _refused(new, error) from None

        new.__init__ = __init__
        found: type[_V] = new
        return found

    return made


def _refused(cls: type[Value], error: ValidationError) -> Exception:
    """The first finding as the error of the class."""
    found = error.errors(include_url=False)[0]
    place, given, allowed = list(found["loc"]), found["input"], found["msg"].replace("Input should be", "must be")
    if place and isinstance(place[0], int) and place[0] < len(fields(cls)):  # an argument without its name
        place[0] = fields(cls)[place[0]].name
    cause = found.get("ctx", {}).get("error")
    if isinstance(cause, FieldError):
        place, given, allowed = [*place, *([cause.field] if cause.field else [])], cause.value, cause.allowed
    elif found["type"] == "missing":
        given, allowed = None, "must be given"
    elif found["type"] in ("dataclass_type", "dict_type", "mapping_type"):
        allowed = "must be an object (a table)"
    elif found["type"] == "unexpected_positional_argument":
        allowed = "must be left out"
    parts = [f"[{part}]" if isinstance(part, int) else f".{_named(part)}" for part in place if part != "[key]"]
    whole = cls._name if cls._is_part or not parts else ""
    return cls._refusal(f"{whole}{''.join(parts)}".removeprefix("."), given, allowed)


def _named(key: Any) -> str:
    """A field's name as errors show it, also one that somebody made up."""
    name = str(key)[:NAME_LENGTH]
    return name if name.isprintable() else repr(name)
