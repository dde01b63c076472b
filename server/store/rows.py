"""Rows as values: typed, and another one where a column changes."""

from dataclasses import dataclass
from typing import Any

from sqlalchemy import Row


@dataclass(frozen=True, slots=True)
class GameRow:
    """A row of `games`."""

    id: str
    match_id: str
    number: int
    noise_secret: str
    rack_secret: str
    noise_seed: str
    commitment: str
    breaker: int
    state: dict[str, Any]
    version: int
    status: str
    winner: int | None
    mover: str | None
    used_0: int
    used_1: int
    lag_0: int
    lag_1: int
    grace_0: int
    grace_1: int
    simulated_0: int
    simulated_1: int
    present_0: bool
    present_1: bool
    carried: int
    carried_grace: int
    delivered: bool
    available_at: int
    clock_from: int
    deadline: int | None
    started_at: int
    ended_at: int | None
    header: str
    ending: str | None
    seal: str | None
    head: str

    @classmethod
    def of(cls, row: Row[Any]) -> "GameRow":
        """From what `select(games)` gives."""
        return cls(**row._asdict())
