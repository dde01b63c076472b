"""The budget of simulated shots in a game: counted where the server simulates, believed where players declare."""

from dataclasses import replace

from sqlalchemy import Connection, case, select, true, update

from server.errors import BudgetSpent, GameFinished, Unauthorized
from server.http.commands import Answer, Command, once, usable_key
from server.security.callers import Caller
from server.services.play.live_game import LiveGame, hold
from server.services.runtime.context import Context
from server.store.tables import games

COUNTED = Answer(200, b"")
"""What is kept of a request that was counted: what it simulates comes out the same when it is sent again."""


def count(context: Context, command: Command, game_id: str | None, shots: int) -> None:
    """Count shots about to be simulated for one of the game's players, once however often the request comes.

    Without a game there is nothing to count, and no key is needed. Raises `BadHeader` and `KeyReused` as every command
    does, `Unauthorized`, `NotFound`, `Forbidden`, `GameFinished`, and `BudgetSpent` when fewer are left; nothing is
    counted then.
    """
    if command.key is not None:
        usable_key(command)
    if game_id is not None:
        if command.caller.is_stranger:
            raise Unauthorized("a game's budget is its players': there is no token that says whose shot this is")
        with context.writing() as writing:
            once(writing.connection, command, lambda: _count(writing.connection, command.caller, game_id, shots))


def _count(connection: Connection, caller: Caller, game_id: str, shots: int) -> Answer:
    live = hold(connection, game_id)
    seat = live.seat_of(caller)
    if not live.is_running:
        raise GameFinished(f"game {live.id} is {live.row.status}")
    simulated = games.c[f"simulated_{seat}"]
    fits = true() if live.match.simulations is None else simulated + shots <= live.match.simulations
    this = update(games).where(games.c.id == live.id, fits)
    if connection.execute(this.values({simulated: simulated + shots})).rowcount != 1:
        raise _spent(live, seat, shots)
    return COUNTED


def declare(connection: Connection, live: LiveGame, seat: int, shots: int) -> LiveGame:
    """Add what a player declares for a stroke, in the transaction that stores it; the game with its counters then.

    Never refused: the stroke has been simulated, and what it met is not to be learnt from a refusal. Where shots were
    counted since the budget was looked at, the rest of it is spent.
    """
    budget = live.match.simulations
    if not shots and budget is None:
        return live
    this = games.c.id == live.id
    if shots:
        simulated = games.c[f"simulated_{seat}"]
        total = simulated + shots
        spent = total if budget is None else case((total > budget, budget), else_=total)
        connection.execute(update(games).where(this).values({simulated: spent}))
    counters = connection.execute(select(games.c.simulated_0, games.c.simulated_1).where(this)).one()
    return replace(live, row=replace(live.row, simulated_0=counters.simulated_0, simulated_1=counters.simulated_1))


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
