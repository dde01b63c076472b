"""How often one caller may ask: a bucket for each, filled at a steady rate, emptied by requests.

The buckets are this process's own: behind several processes a caller may ask as often at each of them.
"""

import math
import threading
from dataclasses import dataclass

from server.errors import TooManyRequests
from server.services.runtime.time import TimeSource

SECOND = 1e9
MOST_BUCKETS = 10_000
"""Callers remembered; then those who could ask anew without limit are forgotten."""


@dataclass(slots=True)
class _Bucket:
    left: float
    at: int


class Rates:
    """The buckets.

    Args:
        rate: requests a second that a bucket is filled with.
        burst: requests that a full bucket holds.
        time: when now is.
    """

    def __init__(self, rate: float, burst: float, time: TimeSource) -> None:
        self._rate, self._burst, self._time = rate, burst, time
        self._buckets: dict[str, _Bucket] = {}
        self._lock = threading.Lock()

    def take(self, key: str, cost: float = 1.0) -> None:
        """Let a request pass that counts `cost`; raises `TooManyRequests`, which says how long to wait.

        A request that costs more than a bucket holds passes when the bucket is full.
        """
        with self._lock:
            bucket = self._filled(key)
            needed = min(cost, self._burst)
            if bucket.left >= needed:
                bucket.left -= cost
                return
            seconds = math.ceil((needed - bucket.left) / self._rate)
        raise TooManyRequests(key, seconds, f"{self._rate:g} requests a second, {self._burst:g} at once")

    def _filled(self, key: str) -> _Bucket:
        now = self._time.now()
        bucket = self._buckets.get(key)
        if bucket is None:
            if len(self._buckets) >= MOST_BUCKETS:
                self._forget(now)
            bucket = self._buckets[key] = _Bucket(self._burst, now)
        bucket.left = min(self._burst, bucket.left + (now - bucket.at) / SECOND * self._rate)
        bucket.at = now
        return bucket

    def _forget(self, now: int) -> None:
        """Drop the buckets that are full by now: a new one is no different. If there are none, drop all."""
        kept = {
            key: bucket
            for key, bucket in self._buckets.items()
            if bucket.left + (now - bucket.at) / SECOND * self._rate < self._burst
        }
        self._buckets = kept if len(kept) < MOST_BUCKETS else {}
