"""What a player may ask of another without an organiser: bounds that keep one challenge from costing everybody."""

from typing import Any, Final

from sqlalchemy import func, select

from physics import Table
from protocol import MatchRequest
from server.errors import WrongStatus, invalid_field
from server.security.callers import Caller
from server.services.matches.player_seeds import CHALLENGED
from server.services.runtime.context import Writing
from server.store.locks import only_one
from server.store.tables import matches

MOST_WAITING: Final = 8
"""Challenges by one agent to another that may wait at once."""
USUAL: Final = 0.5 * (1.0 + 1e-9)
"""A parameter lies within half of its named table's, of which rounding takes nothing away. On tables far from every
real one a stroke can cost a thousand times a usual one."""


def require_usual_table(request: MatchRequest, caller: Caller) -> None:
    """Raise `Invalid` for a table whose parameters lie far from its named table's, unless an organiser asks."""
    if caller.is_organiser:
        return
    named = Table.from_dict({"name": request.table["name"]}).to_dict()
    for name, value in request.table.items():
        usual = named[name]
        if not isinstance(value, float | int) or isinstance(value, bool):
            continue
        if abs(value - usual) > USUAL * usual:
            allowed = f"from {0.5 * usual:g} to {1.5 * usual:g}, within half of {named['name']}'s {usual:g}"
            raise invalid_field(f"table.{name}", value, f"{allowed}; an organiser may give others")


def require_few(writing: Writing, request: MatchRequest, challenger: str | None) -> None:
    """Raise `WrongStatus` while enough challenges of the same agent to the same other one wait."""
    if challenger is None:
        return
    seat = request.agents.index(challenger)
    challenged = request.agents[1 - seat]
    only_one(writing.connection, f"challenges of {challenger} to {challenged}")
    ours = (matches.c.status == CHALLENGED) & (matches.c.challenger == challenger)
    waiting = writing.connection.scalar(select(func.count()).select_from(matches).where(ours, _plays(challenged)))
    if waiting is not None and waiting >= MOST_WAITING:
        raise WrongStatus(
            f"{waiting} of your challenges to {challenged} wait: must be at most {MOST_WAITING}; abort one"
        )


def _plays(agent_id: str) -> Any:
    return (matches.c.seat_0 == agent_id) | (matches.c.seat_1 == agent_id)
