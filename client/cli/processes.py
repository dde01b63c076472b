"""Child processes that never outlive the command that started them.

They end with the `with` block; when the command is told to terminate, the block is left in order. On Linux
the kernel also ends them if the command is killed outright.
"""

import contextlib
import os
import signal
import subprocess
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import FrameType

from client.arena.confine import confined

PATIENCE = 10.0
"""Seconds from SIGTERM to SIGKILL; a server closes its database in far less."""


class Child:
    """A process with its standard error, and its output, in a file, behind what earlier ones wrote there."""

    def __init__(self, name: str, command: Sequence[str], log: Path, environment: Mapping[str, str]) -> None:
        self.name = name
        self._log = log
        with log.open("ab") as sink:
            self._begin = sink.tell()
            self._process = subprocess.Popen(
                confined(command, orphaned=signal.SIGTERM),
                stdin=subprocess.DEVNULL,
                stdout=sink,
                stderr=subprocess.STDOUT,
                env=os.environ | environment,
            )

    @property
    def exit_code(self) -> int | None:
        """The exit code, or None while it runs."""
        return self._process.poll()

    def wait(self, seconds: float) -> int | None:
        """Wait for its end; the exit code, or None when it still runs."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            self._process.wait(seconds)
        return self.exit_code

    def stop(self) -> None:
        """End it: SIGTERM, and SIGKILL if that is not enough."""
        if self.exit_code is None:
            self._process.terminate()
            if self.wait(PATIENCE) is None:
                self._process.kill()
                self._process.wait()

    def written(self) -> list[str]:
        """The lines it has written."""
        with self._log.open("rb") as log:
            log.seek(self._begin)
            return log.read().decode(errors="replace").splitlines()

    def last_words(self, lines: int = 15) -> str:
        """The end of what it wrote, for an error message."""
        return "\n".join(f"  {self.name}: {line}" for line in self.written()[-lines:]) or f"  {self.name} wrote nothing"


@contextlib.contextmanager
def children() -> Iterator[list[Child]]:
    """A list of children to add to; all of them are stopped when the block is left, the last first."""
    started: list[Child] = []
    with termination_as_exception():
        try:
            yield started
        finally:
            for child in reversed(started):
                child.stop()


@contextlib.contextmanager
def termination_as_exception() -> Iterator[None]:
    """Leave the block by SystemExit on SIGTERM and SIGHUP, unless they are ignored, as under nohup."""

    def leave(number: int, _frame: FrameType | None) -> None:
        raise SystemExit(128 + number)

    ours = [each for each in (signal.SIGTERM, signal.SIGHUP) if signal.getsignal(each) == signal.SIG_DFL]
    for each in ours:
        signal.signal(each, leave)
    try:
        yield
    finally:
        for each in ours:
            signal.signal(each, signal.SIG_DFL)
