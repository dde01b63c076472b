"""Events played by lot, for tests of formats, standings and reports."""

import random
from collections.abc import Callable
from typing import Any

from referee.game import EndReason
from tournament import Due, Entrant, GameResult, Spec, Tournament

Chooser = Callable[[Due], int | None]
"""Who wins a game: a seat, or None for a draw."""


def spec_of(entrants: int, **terms: Any) -> Spec:
    """Terms with entrants a, b, c …"""
    return Spec("event", tuple(Entrant(name_of(index)) for index in range(entrants)), **terms)


def name_of(index: int) -> str:
    """a … z, then a1 … z1 and so on."""
    return chr(ord("a") + index % 26) + (str(index // 26) if index >= 26 else "")


def result_of(due: Due, winner: int | None, **more: Any) -> GameResult:
    """A game that ended with this winner."""
    reason = EndReason.EIGHT_MADE if winner is not None else EndReason.STALEMATE
    return GameResult(
        due.pair.id,
        due.leg,
        due.pair.players,
        due.breaker,
        winner,
        reason,
        noise=due.pair.noise,
        attempt=due.attempt,
        **more,
    )


def by_lot(seed: int, draws: bool = True) -> Chooser:
    """Any outcome with equal chances."""
    chance = random.Random(seed)
    return lambda due: chance.choice([0, 1, None] if draws else [0, 1])


def play(event: Tournament, choose: Chooser, most: int = 100_000) -> Tournament:
    """Play what is due, in order, until nothing is."""
    for _ in range(most):
        if event.finished:
            return event
        event = event.with_results(*(result_of(due, choose(due)) for due in event.due))
    raise AssertionError(f"not finished after {most} turns")
