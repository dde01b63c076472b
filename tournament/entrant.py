"""Who takes part in an event."""

from typing import Annotated, Any

from pydantic import GetJsonSchemaHandler, model_validator
from pydantic_core import CoreSchema

from tournament.errors import InvalidSpec
from tournament.validation import Name, Value, text, value

LONGEST_AGENT = 4096
"""Letters of what plays under a name."""


@value(InvalidSpec, "entrant")
class Entrant(Value):
    """Who takes part; a text alone is name and agent in one.

    Attributes:
        name: unique in the event.
        agent: what plays under that name, for whoever runs the event: a shipped agent's name, an import path, a
            command. Left empty, it is the name.
    """

    name: Name
    agent: Annotated[str, text(LONGEST_AGENT)] = ""

    @model_validator(mode="before")
    @classmethod
    def _short(cls, data: Any) -> Any:
        return {"name": data} if isinstance(data, str) else data

    @classmethod
    def __get_pydantic_json_schema__(cls, schema: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        """An object, or the short form."""
        return {"anyOf": [{"type": "string"}, handler(schema)]}

    def __post_init__(self) -> None:
        object.__setattr__(self, "agent", self.agent or self.name)
