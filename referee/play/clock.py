"""Clock arithmetic as pure functions: what time is left, given what has been charged.

Whole nanoseconds, so that sums are exact and a clock at exactly zero is exactly out of time.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Self

SECOND_NS = 1_000_000_000
LEAST_SECONDS = 0.001
"""The shortest clock there is: less is nothing that anybody could play on, and far less no whole nanosecond."""
MOST_SECONDS = 86_400.0
"""The longest: a day for each player."""


@dataclass(frozen=True, slots=True)
class Clocks:
    """Both players' clocks in one game.

    Attributes:
        allowance_ns: time for each player.
        used_ns: time charged so far, by seat.
    """

    allowance_ns: int
    used_ns: tuple[int, int] = (0, 0)

    def __post_init__(self) -> None:
        if self.allowance_ns <= 0:
            raise ValueError(f"allowance_ns = {self.allowance_ns!r}: must be > 0")

    @classmethod
    def of_seconds(cls, seconds: float) -> Self:
        """Fresh clocks of so many seconds each."""
        return cls(nanoseconds(seconds))

    @classmethod
    def from_charges(cls, allowance_ns: int, charges: Iterable[tuple[int, int]]) -> Self:
        """Clocks after a ledger of (seat, nanoseconds)."""
        clocks = cls(allowance_ns)
        for seat, elapsed_ns in charges:
            clocks = clocks.charged(seat, elapsed_ns)
        return clocks

    def charged(self, seat: int, elapsed_ns: int) -> Self:
        """The clocks after ``seat`` has used ``elapsed_ns`` more.

        Raises:
            ValueError: a negative charge; time is never given back.
        """
        if elapsed_ns < 0:
            raise ValueError(f"elapsed_ns = {elapsed_ns!r}: must be >= 0; time is never given back")
        used = list(self.used_ns)
        used[seat] += elapsed_ns
        return replace(self, used_ns=(used[0], used[1]))

    def remaining_ns(self, seat: int) -> int:
        """What ``seat`` has left; zero or less is out of time."""
        return self.allowance_ns - self.used_ns[seat]

    def remaining_seconds(self, seat: int) -> float:
        """What ``seat`` has left, s, never below 0: for people and for the wire."""
        return max(0, self.remaining_ns(seat)) / SECOND_NS

    def is_out_of_time(self, seat: int) -> bool:
        """Whether ``seat`` has used the allowance up; exactly zero left is out of time."""
        return self.remaining_ns(seat) <= 0


@dataclass(frozen=True, slots=True)
class LagAllowance:
    """What a server gives back of a turn: the same for everybody, whatever a client says.

    Attributes:
        turn_ns: given back at most for one turn.
        game_ns: given back at most to one player in a game.
    """

    turn_ns: int = 0
    game_ns: int = 0

    def __post_init__(self) -> None:
        for name, value in (("turn_ns", self.turn_ns), ("game_ns", self.game_ns)):
            if value < 0:
                raise ValueError(f"{name} = {value!r}: must be >= 0")

    def left_ns(self, granted_ns: int) -> int:
        """What a turn may be given at most when the game has given ``granted_ns`` already."""
        return max(0, min(self.turn_ns, self.game_ns - granted_ns))

    def charge(self, measured_ns: int, granted_ns: int, grace_ns: int = 0) -> "Charge":
        """What a turn of ``measured_ns`` costs when the game has given ``granted_ns`` already.

        Args:
            measured_ns: from the moment the turn was available, the grace included.
            granted_ns: of lag, in earlier turns.
            grace_ns: given back for the wait until the turn was fetched; the lag is of what is left.
        """
        return Charge(measured_ns, min(measured_ns - grace_ns, self.left_ns(granted_ns)), grace_ns)


@dataclass(frozen=True, slots=True)
class Charge:
    """One turn on a clock.

    Attributes:
        measured_ns: how long it took, as the server saw it, from the moment it was available.
        lag_ns: what of it was given back for the way to the server and back.
        grace_ns: what of it was given back for the wait until the player fetched it.
    """

    measured_ns: int
    lag_ns: int
    grace_ns: int = 0

    @property
    def charged_ns(self) -> int:
        """What the player's clock lost."""
        return self.measured_ns - self.lag_ns - self.grace_ns


def nanoseconds(seconds: float) -> int:
    """Seconds to whole nanoseconds, rounded to nearest."""
    return round(seconds * SECOND_NS)
