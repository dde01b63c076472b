"""What was read last, kept from one request to the next: values by name, each belonging to a number that only grows."""

import threading
from collections import OrderedDict
from collections.abc import Callable, Mapping
from typing import Generic, TypeVar

V = TypeVar("V")


class VersionedCache(Generic[V]):
    """For all threads; the values least recently looked for are forgotten first.

    Args:
        most: values that are kept.
        number: the number that a value belongs to; the value of a greater one takes its place.
    """

    def __init__(self, most: int, number: Callable[[V], int]) -> None:
        self._most = most
        self._number = number
        self._kept: OrderedDict[str, V] = OrderedDict()
        self._lock = threading.Lock()

    def get(self, name: str) -> V | None:
        """What is known under a name; there may be later values."""
        with self._lock:
            if name in self._kept:
                self._kept.move_to_end(name)
            return self._kept.get(name)

    def keep(self, values: Mapping[str, V]) -> None:
        """Keep values as they were committed, unless later ones are known already."""
        with self._lock:
            for name, value in values.items():
                known = self._kept.get(name)
                if known is None or self._number(known) < self._number(value):
                    self._kept[name] = value
                    self._kept.move_to_end(name)
            while len(self._kept) > self._most:
                self._kept.popitem(last=False)

    def forget(self, name: str) -> None:
        """Keep nothing under a name."""
        with self._lock:
            self._kept.pop(name, None)
