"""A game that is to be played, and whom to tell what goes wrong with a player."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from referee import GameSeeds, NoiseModel
from tournament import Due

Tell = Callable[[str, str], None]
"""Told of an entrant (its name) what went wrong with it (a sentence)."""


@dataclass(frozen=True, slots=True)
class GameTask:
    """A game to be played.

    Attributes:
        due: which. seeds: its secrets.
        table: parameters. noise: of this game.
        seconds: clock, None without. simulated_shots: budget, None without.
    """

    due: Due
    seeds: GameSeeds
    table: str | dict[str, Any]
    noise: NoiseModel
    seconds: float | None
    simulated_shots: int | None
