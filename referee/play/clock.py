"""The arithmetic of a game's clock: what a turn costs, what is given back of it, when the time is up.

Whole nanoseconds, so that sums are exact and a clock at exactly zero is exactly out of time. The time of day is handed
in; nothing here reads it.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace
from typing import Self, TypeVar

T = TypeVar("T")

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
        return replace(self, used_ns=_with(self.used_ns, seat, self.used_ns[seat] + elapsed_ns))

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

    def left_ns(self, granted_ns: int, turn_granted_ns: int = 0) -> int:
        """What a turn may be given at most when the game has given ``granted_ns`` already.

        ``turn_granted_ns`` was given to this very turn, and is not yet among the game's.
        """
        return max(0, min(self.turn_ns, self.game_ns - granted_ns) - turn_granted_ns)

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


@dataclass(frozen=True, slots=True)
class RunningTurn:
    """The turn that a game waits for; moments in ns of one time, the server's.

    Attributes:
        seat: whose turn it is.
        available_at: when it could be fetched.
        clock_from: when the player's clock starts; the time between is the grace.
        is_delivered: whether the player has fetched it.
        carried_ns: what of it was charged before the game stood still.
        carried_grace_ns: what of it was given back before that, for the wait until it was fetched.
    """

    seat: int
    available_at: int
    clock_from: int
    is_delivered: bool
    carried_ns: int = 0
    carried_grace_ns: int = 0

    def running_ns(self, now: int) -> int:
        """How long the clock has run since it started, or since the game went on."""
        return max(0, now - self.clock_from)

    def grace_ns(self, until: int) -> int:
        """What was given back until then, for the wait until the turn was fetched."""
        return self.carried_grace_ns + max(0, min(until, self.clock_from) - self.available_at)


@dataclass(frozen=True, slots=True)
class GameClock:
    """A game's clocks, what was given back in it, and the turn that runs.

    Attributes:
        clocks: as charged so far, the running turn not counted.
        lag: what each turn is given back for the way to the server and back.
        lag_ns: of that, given back so far, by seat.
        grace_ns: given back so far for turns fetched late, by seat.
        present: whether each player ever fetched a turn of this game or played one.
        turn: the one that the game waits for; None: none does.
    """

    clocks: Clocks
    lag: LagAllowance = LagAllowance()
    lag_ns: tuple[int, int] = (0, 0)
    grace_ns: tuple[int, int] = (0, 0)
    present: tuple[bool, bool] = (False, False)
    turn: RunningTurn | None = None

    def charge(self, until: int) -> Charge:
        """What the running turn costs if it ends then; nothing when no turn runs."""
        if self.turn is None:
            return Charge(0, 0)
        return self._charge(self.turn.carried_ns + self.turn.running_ns(until), self.turn.grace_ns(until))

    def charge_of_action(self, arrived: int) -> Charge:
        """What the running turn costs if the action that ends it was complete at `arrived`.

        Nothing is given back of a turn that was never fetched: the player who acts knows the view from elsewhere, and
        did not wait for the fetch.
        """
        if self.turn is None or self.turn.is_delivered:
            return self.charge(arrived)
        ran = self.turn.carried_ns + max(0, arrived - self.turn.available_at)
        return self._charge(ran, self.turn.carried_grace_ns)

    def _charge(self, ran_ns: int, grace_ns: int) -> Charge:
        assert self.turn is not None
        return self.lag.charge(ran_ns + grace_ns, self.lag_ns[self.turn.seat], grace_ns)

    def is_too_late(self, arrived: int) -> bool:
        """Whether an action complete at `arrived` is out of time; exactly zero left is."""
        if self.turn is None:
            return False
        charge = self.charge_of_action(arrived)
        return self.clocks.charged(self.turn.seat, charge.charged_ns).is_out_of_time(self.turn.seat)

    def at(self, now: int) -> Clocks:
        """Both clocks as they stand then, the running turn counted."""
        if self.turn is None:
            return self.clocks
        return self.clocks.charged(self.turn.seat, self.charge(now).charged_ns)

    def runs_out(self) -> int:
        """When the running turn is out of time if nobody plays it."""
        assert self.turn is not None
        seat = self.turn.seat
        left = self.clocks.remaining_ns(seat) + self.lag.left_ns(self.lag_ns[seat])
        return self.turn.clock_from + left - self.turn.carried_ns

    def ended(self, charge: Charge, *, moved: bool) -> Self:
        """The clocks after the running turn, which cost `charge`; its player is present if it ended by a move."""
        if self.turn is None:
            return self
        seat = self.turn.seat
        return replace(
            self,
            clocks=self.clocks.charged(seat, charge.charged_ns),
            lag_ns=_with(self.lag_ns, seat, self.lag_ns[seat] + charge.lag_ns),
            grace_ns=_with(self.grace_ns, seat, self.grace_ns[seat] + charge.grace_ns),
            present=_with(self.present, seat, self.present[seat] or moved),
            turn=None,
        )

    def handed(self, seat: int, now: int) -> Self:
        """A new turn, in its player's hands at once: the clock runs from now on."""
        return replace(self, turn=RunningTurn(seat, now, now, is_delivered=True))

    def offered(self, seat: int, now: int, grace: LagAllowance) -> Self:
        """A new turn that waits to be fetched: it is charged from now on but for the grace.

        Not from the fetch: a table is read without a token, and a player who has read it thinks.
        """
        return self._offered(RunningTurn(seat, now, now, is_delivered=False), now, grace)

    def fetched(self, now: int) -> Self:
        """The running turn in its player's hands: its clock runs from now on at the latest."""
        assert self.turn is not None
        turn = replace(self.turn, is_delivered=True, clock_from=min(self.turn.clock_from, now))
        return replace(self, turn=turn, present=_with(self.present, turn.seat, True))

    def resumed(self, stopped: int, now: int, grace: LagAllowance) -> Self:
        """The running turn, which stood still from `stopped` on, waits to be fetched again.

        What is left of its grace may be used from now on.
        """
        return self._offered(self._stopped(stopped), now, grace)

    def held(self, stopped: int, until: int) -> Self:
        """The running turn, which stood still from `stopped` on: neither clock nor grace runs before `until`."""
        turn = replace(self._stopped(stopped), available_at=until, clock_from=until, is_delivered=False)
        return replace(self, turn=turn)

    def _stopped(self, at: int) -> RunningTurn:
        assert self.turn is not None
        ran, given = self.turn.running_ns(at), self.turn.grace_ns(at)
        return replace(self.turn, carried_ns=self.turn.carried_ns + ran, carried_grace_ns=given)

    def _offered(self, turn: RunningTurn, now: int, grace: LagAllowance) -> Self:
        left = grace.left_ns(self.grace_ns[turn.seat], turn.carried_grace_ns)
        return replace(self, turn=replace(turn, available_at=now, clock_from=now + left, is_delivered=False))


@dataclass(frozen=True, slots=True)
class Timing:
    """Clocks for a local game, read from a time that is handed in.

    Attributes:
        allowance_ns: for each player.
        now: nanoseconds that only grow; they are read before and after a player is asked.
    """

    allowance_ns: int
    now: Callable[[], int]


def _with(pair: tuple[T, T], seat: int, value: T) -> tuple[T, T]:
    """A pair with another value for one seat."""
    return (value, pair[1]) if seat == 0 else (pair[0], value)


def nanoseconds(seconds: float) -> int:
    """Seconds to whole nanoseconds, rounded to nearest."""
    return round(seconds * SECOND_NS)
