"""What `search` can be told: `search:seconds=0.3,safeties=off`."""

from typing import Annotated, Any, Final

from pydantic import BeforeValidator
from pydantic_core import core_schema

from physics.errors import FieldError
from tournament.validation import Must, Value, integer, number, value

LEAST_SECONDS, MOST_SECONDS, MOST_SHOTS = 0.001, 3600.0, 10**9


def _whole(given: Any) -> Any:
    """A whole number that was written as another one: `shots=1e4`."""
    return int(given) if isinstance(given, float) and given.is_integer() else given


Switch = Annotated[bool, Must("on or off", core_schema.bool_schema(strict=True))]


@value(FieldError, "options", is_part=False)
class Options(Value):
    """How the agent thinks.

    Attributes:
        seconds: at most so long about one stroke; less when the game's clock asks for it.
        shots: simulate about so many shots for each stroke instead, whatever time that takes: the same seed then makes
            the same choices. 0: as many as fit into the seconds.
        cpu: count seconds of this process's processor time, not of the wall clock: for fair measurements.
        safeties: consider everything beside straight pots. ways: play a pot in many ways, not in two.
        banks: aim banks, kicks, combinations and caroms, not only come upon them. jumps: over balls, where balls fly.
        polish: look for better strokes near the best ones. even_draws: play copies under draws of the noise that are
            spread evenly, not under independent ones. safety_odds: reckon safeties as games bear them out.

    Raises:
        FieldError: an option that does not exist, or a value that is not allowed.
    """

    seconds: Annotated[float, number(LEAST_SECONDS, MOST_SECONDS)] = 1.0
    shots: Annotated[int, integer(0, MOST_SHOTS), BeforeValidator(_whole)] = 0
    cpu: Switch = False
    safeties: Switch = True
    ways: Switch = True
    banks: Switch = True
    jumps: Switch = True
    polish: Switch = True
    even_draws: Switch = True
    safety_odds: Switch = True


USUAL: Final = Options()
"""The agent as it is shipped."""
