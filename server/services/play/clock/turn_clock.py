"""When a turn is over although nobody plays it: out of time, or nobody there."""

from dataclasses import dataclass, replace
from typing import Any, Final

from sqlalchemy import Row

from referee.game import Game
from referee.play import LagAllowance
from server.services.play.live_game import LiveGame
from server.services.runtime.context import Writing

HELD: Final = 2**62
"""A time that never comes (ns since 1970, in the year 2116): what waits for the server to listen is dated here."""


@dataclass(frozen=True, slots=True)
class TurnClock:
    """What a turn may take, ns.

    Attributes:
        remaining: on the player's clock.
        lag: given back for the way at most. grace: given back for the wait until it is fetched at most.
        carried: of it charged before the server stopped; carried_grace: given back then.
        present: whether the player was ever there in this game.
    """

    remaining: int
    lag: int
    grace: int = 0
    carried: int = 0
    carried_grace: int = 0
    present: bool = True

    def runs_out(self, clock_from: int) -> int:
        """When the turn is out of time, its clock running since `clock_from`."""
        return clock_from + self.remaining + self.lag - self.carried


def first_turn(writing: Writing, match: Row[Any]) -> TurnClock:
    """The first turn of a game."""
    lag = LagAllowance(match.lag_turn, match.lag_game)
    return TurnClock(match.allowance, lag.left_ns(0), writing.context.grace.left_ns(0), present=False)


def running_turn(live: LiveGame) -> TurnClock:
    """The turn that a game waits for."""
    seat = live.game.turn
    return TurnClock(
        remaining=live.clocks.remaining_ns(seat),
        lag=live.fixture.lag.left_ns(live.granted[seat]),
        carried=live.row.carried,
        carried_grace=live.row.carried_grace,
        present=live.is_present[seat],
    )


def carried_on(writing: Writing, live: LiveGame, until: int) -> TurnClock:
    """The turn that a game waits for, which stood still since then; what is left of its grace may be used later."""
    given = live.grace_until(until)
    granted, whole = live.graces[live.game.turn], writing.context.grace
    return replace(
        running_turn(live),
        carried=live.row.carried + live.running_for(until),
        carried_grace=given,
        grace=max(0, min(whole.turn_ns - given, whole.game_ns - granted - given)),
    )


def available(writing: Writing, clock: TurnClock) -> dict[str, Any]:
    """The columns of a turn that waits to be fetched: it is charged from now on but for the grace.

    Not from the fetch: a table is read without a token, and whoever has read it thinks.
    """
    clock_from = writing.now + clock.grace
    deadline = clock.runs_out(clock_from)
    if not clock.present:
        deadline = min(deadline, writing.now + writing.context.no_show_after)
    return {
        "delivered": False,
        "available_at": writing.now,
        "clock_from": clock_from,
        "deadline": deadline,
        "carried": clock.carried,
        "carried_grace": clock.carried_grace,
    }


def held(clock: TurnClock) -> dict[str, Any]:
    """The columns of a turn while nobody can fetch it: neither clock nor grace runs until it is made available."""
    return {
        "delivered": False,
        "available_at": HELD,
        "clock_from": HELD,
        "deadline": clock.runs_out(HELD),
        "carried": clock.carried,
        "carried_grace": clock.carried_grace,
    }


def delivered(clock: TurnClock, available_at: int, clock_from: int) -> dict[str, Any]:
    """The columns of a turn in its player's hands, the clock running since `clock_from`."""
    return {
        "delivered": True,
        "available_at": available_at,
        "clock_from": clock_from,
        "deadline": clock.runs_out(clock_from),
        "carried": clock.carried,
        "carried_grace": clock.carried_grace,
    }


def mover(match: Row[Any], game: Game) -> dict[str, Any]:
    """Whose turn it is."""
    return {"mover": (match.seat_0, match.seat_1)[game.turn]}
