"""The ledger of a game's clocks: what each turn took, what of it was given back, and what was charged."""

from collections.abc import Sequence
from typing import Any, Final

from sqlalchemy import Row, insert, select

from protocol import ChargeView, ClockLedger, SeatLedger
from referee.play.clock import SECOND_NS, Charge
from server.services.play.live_game import LiveGame, find
from server.services.runtime.context import Context, Writing
from server.services.runtime.time import date_time
from server.store.prepared import Prepared
from server.store.tables import charges


def read(context: Context, game_id: str) -> ClockLedger:
    """The ledger of a game, running or over; raises `NotFound`."""
    ours = select(charges).where(charges.c.game_id == game_id).order_by(charges.c.sequence)
    with context.database.reading() as connection:
        live = find(connection, game_id)
        rows = connection.execute(ours).all()
    now = context.time.now()
    settings = context.settings
    return ClockLedger(
        game=live.id,
        seconds=live.match.allowance / SECOND_NS,
        simulations=live.match.simulations,
        lag_turn_seconds=live.match.lag_turn / SECOND_NS,
        lag_game_seconds=live.match.lag_game / SECOND_NS,
        grace_seconds=settings.fetch_grace,
        grace_game_seconds=settings.fetch_grace_game,
        no_show_seconds=settings.no_show_seconds,
        clocks=live.clock_views(now),
        players=(_seat(live, 0), _seat(live, 1)),
        charges=_charges(rows),
    )


def enter(writing: Writing, live: LiveGame, move: int | None, charge: Charge) -> None:
    """Write down what a turn of a game cost; `move` is the number of the move that ended it, None from outside."""
    row = {"game_id": live.id, "seat": live.game.turn, "move": move, "created_at": writing.now}
    parts = {"measured": charge.measured_ns, "lag": charge.lag_ns, "grace": charge.grace_ns}
    _ENTER.run(writing.connection, row | parts)


_ENTER: Final = Prepared(insert(charges))


def _seat(live: LiveGame, seat: int) -> SeatLedger:
    return SeatLedger(
        charged_ns=live.clock.clocks.used_ns[seat],
        lag_ns=live.clock.lag_ns[seat],
        grace_ns=live.clock.grace_ns[seat],
        simulated=(live.row.simulated_0, live.row.simulated_1)[seat],
    )


def _charges(rows: Sequence[Row[Any]]) -> tuple[ChargeView, ...]:
    return tuple(
        ChargeView(
            seat=row.seat,
            move=row.move,
            measured_ns=row.measured,
            lag_ns=row.lag,
            grace_ns=row.grace,
            charged_ns=row.measured - row.lag - row.grace,
            at=date_time(row.created_at),
        )
        for row in rows
    )
