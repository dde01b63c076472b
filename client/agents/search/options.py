"""What `search` can be told: `search:seconds=0.3,safeties=off`."""

import dataclasses
from collections.abc import Mapping
from typing import Any, Self


@dataclasses.dataclass(frozen=True, slots=True)
class Options:
    """How the agent thinks.

    Attributes:
        seconds: at most so long about one stroke; less when the game's clock asks for it.
        shots: simulate about so many shots for each stroke instead, whatever time that takes: the same seed then makes
            the same choices. 0: as many as fit into the seconds.
        cpu: count seconds of this process's processor time, not of the wall clock: for fair measurements.
        safeties: consider everything beside straight pots. ways: play a pot in many ways, not in two.
    """

    seconds: float = 1.0
    shots: int = 0
    cpu: bool = False
    safeties: bool = True
    ways: bool = True

    @classmethod
    def of(cls, given: Mapping[str, Any]) -> Self:
        """Options by name.

        Raises:
            ValueError: a name or a value that is none; the message says what is allowed.
        """
        names = [field.name for field in dataclasses.fields(cls)]
        for name in given:
            if name not in names:
                raise ValueError(f"option {name!r} does not exist; these do: {names}")
        return cls(**given)

    def __post_init__(self) -> None:
        for name in ("cpu", "safeties", "ways"):
            if not isinstance(getattr(self, name), bool):
                raise ValueError(f"{name} = {getattr(self, name)!r}: must be on or off")
        if not _is_number(self.seconds) or not LEAST_SECONDS <= self.seconds <= MOST_SECONDS:
            raise ValueError(f"seconds = {self.seconds!r}: must be in [{LEAST_SECONDS}, {MOST_SECONDS}]")
        if not _is_number(self.shots) or self.shots != int(self.shots) or not 0 <= self.shots <= MOST_SHOTS:
            raise ValueError(f"shots = {self.shots!r}: must be an integer from 0 to {MOST_SHOTS}")


LEAST_SECONDS, MOST_SECONDS, MOST_SHOTS = 0.001, 3600.0, 10**9


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
