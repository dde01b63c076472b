"""The budget of simulated shots in a game: counted where the server simulates, believed where players declare."""

from sqlalchemy import true, update

from server.errors import BudgetSpent, GameFinished
from server.security.callers import Caller
from server.services.context import Context
from server.services.live import LiveGame, hold
from server.store.tables import games


def count(context: Context, caller: Caller, game_id: str | None, shots: int) -> None:
    """Count shots about to be simulated for one of the game's players; without a game there is nothing to count.

    Raises `NotFound`, `Forbidden`, `GameFinished`, and `BudgetSpent` when fewer are left; nothing is counted then.
    """
    if game_id is None:
        return
    with context.writing() as writing:
        live = hold(writing.connection, game_id)
        seat = live.seat_of(caller)
        if not live.is_running:
            raise GameFinished(f"game {live.id} is {live.row.status}")
        simulated = games.c[f"simulated_{seat}"]
        fits = true() if live.match.simulations is None else simulated + shots <= live.match.simulations
        this = update(games).where(games.c.id == live.id, fits)
        if writing.connection.execute(this.values({simulated: simulated + shots})).rowcount != 1:
            raise _spent(live, seat, shots)


def require_left(live: LiveGame, seat: int, shots: int) -> None:
    """Raise `BudgetSpent` when a player declares more shots than the budget has left."""
    left = live.simulations_left(seat)
    if left is not None and shots > left:
        raise _spent(live, seat, shots)


def _spent(live: LiveGame, seat: int, shots: int) -> BudgetSpent:
    left = live.simulations_left(seat)
    return BudgetSpent(
        f"{shots} simulated shots are more than the {left} that are left in game {live.id}",
        field="simulations",
        value=shots,
        allowed=f"at most {left} in this game",
    )
