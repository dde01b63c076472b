"""A game's clock in the database: read from its row and its match's, and as columns to be written."""

from typing import Any, Final

from sqlalchemy import Row

from protocol import ClockView
from referee.play.clock import Clocks, GameClock, LagAllowance, RunningTurn, nanoseconds
from server.settings import Settings
from server.store.rows import GameRow

HELD: Final = 2**62
"""A time that never comes (ns since 1970, in the year 2116): what waits for the server to listen is dated here."""
COMPARED: Final = ("delivered", "available_at", "clock_from", "carried", "carried_grace", "present_0", "present_1")
"""Columns of a clock that may change while a game's version stays."""
COLUMNS: Final = (
    *(f"{name}_{seat}" for name in ("used", "lag", "grace", "present") for seat in (0, 1)),
    *("delivered", "available_at", "clock_from", "carried", "carried_grace", "deadline"),
)
"""What `written` gives."""


def read(row: GameRow, match: Row[Any], turn: int | None) -> GameClock:
    """The clock of a game; `turn` is the seat that it waits for, None when it is over."""
    return GameClock(
        clocks=Clocks(match.allowance, (row.used_0, row.used_1)),
        lag=LagAllowance(match.lag_turn, match.lag_game),
        lag_ns=(row.lag_0, row.lag_1),
        grace_ns=(row.grace_0, row.grace_1),
        present=(row.present_0, row.present_1),
        turn=None if turn is None else _turn(row, turn),
    )


def fresh(match: Row[Any]) -> GameClock:
    """The clock of a game that begins."""
    return GameClock(Clocks(match.allowance), LagAllowance(match.lag_turn, match.lag_game))


def written(clock: GameClock, settings: Settings) -> dict[str, Any]:
    """The columns of a clock."""
    pairs = {"used": clock.clocks.used_ns, "lag": clock.lag_ns, "grace": clock.grace_ns, "present": clock.present}
    by_seat = {f"{name}_{seat}": pair[seat] for name, pair in pairs.items() for seat in (0, 1)}
    if clock.turn is None:
        return by_seat | {"deadline": None}
    return by_seat | {
        "delivered": clock.turn.is_delivered,
        "available_at": clock.turn.available_at,
        "clock_from": clock.turn.clock_from,
        "carried": clock.turn.carried_ns,
        "carried_grace": clock.turn.carried_grace_ns,
        "deadline": _deadline(clock, clock.turn, nanoseconds(settings.no_show_seconds)),
    }


def fetch_grace(settings: Settings) -> LagAllowance:
    """What is given back of a turn for the wait until its player fetches it."""
    return LagAllowance(nanoseconds(settings.fetch_grace), nanoseconds(settings.fetch_grace_game))


def views(clock: GameClock, now: int, simulations_left: tuple[int | None, int | None]) -> tuple[ClockView, ClockView]:
    """Both clocks as they stand now, with the simulated shots that are left by seat."""
    clocks, turn = clock.at(now), clock.turn
    running = turn.seat if turn is not None and turn.running_ns(now) > 0 else None
    first, second = (
        ClockView(
            seconds_left=clocks.remaining_seconds(seat),
            running=seat == running,
            simulations_left=simulations_left[seat],
        )
        for seat in (0, 1)
    )
    return first, second


def _turn(row: GameRow, seat: int) -> RunningTurn:
    return RunningTurn(seat, row.available_at, row.clock_from, row.delivered, row.carried, row.carried_grace)


def _deadline(clock: GameClock, turn: RunningTurn, no_show_ns: int) -> int:
    """When the game ends although nobody plays the turn: out of time, or nobody there. Never while it is held."""
    runs_out = clock.runs_out()
    if turn.available_at == HELD and not turn.is_delivered:
        return max(HELD, runs_out)
    if clock.present[turn.seat]:
        return runs_out
    return min(runs_out, turn.available_at + no_show_ns)
