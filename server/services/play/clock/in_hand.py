"""Requests that are being worked on: a flag waits for those that came before it."""

from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager


class RequestsInHand:
    """For each game the arrival times (ns) of its requests in hand; read by threads, changed on the loop alone."""

    def __init__(self) -> None:
        self._arrivals: defaultdict[str, list[int]] = defaultdict(list)

    @contextmanager
    def working_on(self, game_id: str, arrived: int) -> Iterator[None]:
        """A request of this game is in hand as long as the block lasts."""
        self._arrivals[game_id].append(arrived)
        try:
            yield
        finally:
            self._arrivals[game_id].remove(arrived)
            if not self._arrivals[game_id]:
                del self._arrivals[game_id]

    def has_before(self, game_id: str, deadline: int) -> bool:
        """Whether a request that came before the deadline is being worked on: the mover's clock may have stopped."""
        return any(arrived < deadline for arrived in tuple(self._arrivals.get(game_id, ())))

    def clear_until(self, now: int) -> int:
        """Every request that was complete here before then is done."""
        return min([now, *(arrived for ours in tuple(self._arrivals.values()) for arrived in tuple(ours))])
