"""Which processor cores an agent's process gets: some that no other arena process of this machine has."""

import fcntl
import os
import tempfile
from pathlib import Path
from typing import IO


class CoreLease:
    """Cores held until ``release``, or until this process ends.

    Each is a locked file, so that workers that know nothing of each other never take the same. When fewer are free
    than wanted, nothing is held and the process may use them all.

    Args:
        count: how many; None for no limit.
    """

    def __init__(self, count: int | None) -> None:
        self._held: dict[int, IO[str]] = {}
        if count is not None and hasattr(os, "sched_getaffinity"):
            self._take(count)

    @property
    def cpus(self) -> list[int]:
        """Numbers of the cores; empty: all."""
        return sorted(self._held)

    def release(self) -> None:
        """Give them back."""
        for file in self._held.values():
            file.close()
        self._held = {}

    def _take(self, count: int) -> None:
        folder = Path(tempfile.gettempdir()) / f"pooliad-cores-{os.getuid()}"
        folder.mkdir(mode=0o700, exist_ok=True)
        for cpu in sorted(os.sched_getaffinity(0)):
            file = (folder / str(cpu)).open("w")
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                file.close()
                continue
            self._held[cpu] = file
            if len(self._held) == count:
                return
        self.release()
