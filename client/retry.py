"""When to send a request again, and after how long.

A request is repeated only if repeating it cannot do anything twice: it only reads, or it carries an
`Idempotency-Key`. Pauses double from `first_pause` to `longest_pause`, each shortened by a random half so
that clients that failed together do not come back together; a server's `Retry-After` is the least that is
waited.
"""

import random
from collections.abc import Callable
from dataclasses import dataclass

from client.errors import ApiError, ConnectionFailed, PooliadError

REPEATABLE_STATUSES = frozenset({408, 429, 502, 503, 504})
"""Statuses that mean "later": slow body, too many requests, a server that restarts or drains."""


@dataclass(frozen=True, slots=True)
class Retry:
    """How patient a client is.

    Args:
        attempts: how often one request is sent at most; 1 turns repetition off.
        first_pause: s, pause before the second attempt; it doubles from there.
        longest_pause: s, where doubling stops; a `Retry-After` beyond it is obeyed up to `longest_demand`.
        longest_demand: s; a server that asks for more than this is not waited for: the error is raised.
        uniform: source of jitter, numbers in [0, 1).
    """

    attempts: int = 10
    first_pause: float = 0.1
    longest_pause: float = 5.0
    longest_demand: float = 120.0
    uniform: Callable[[], float] = random.random

    def __post_init__(self) -> None:
        if self.attempts < 1:
            raise ValueError(f"attempts = {self.attempts}: must be an integer of at least 1")

    def pause(self, failures: int, error: PooliadError) -> float | None:
        """Seconds to wait after the `failures`-th failure (1, 2, ...), or None when it is final."""
        if failures >= self.attempts or not _is_passing(error):
            return None
        demand = error.retry_after if isinstance(error, ApiError) else 0.0
        if demand > self.longest_demand:
            return None
        doubled = min(self.longest_pause, self.first_pause * 2.0 ** (failures - 1))
        return max(demand, doubled * (1.0 - 0.5 * self.uniform()))


def _is_passing(error: PooliadError) -> bool:
    """Whether the same request may succeed later."""
    if isinstance(error, ApiError):
        return error.status in REPEATABLE_STATUSES
    return isinstance(error, ConnectionFailed)
