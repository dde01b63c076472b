"""A command that is spoken to in lines: one is written to its standard input, one is read from its output."""

import contextlib
import os
import select
import signal
import subprocess
import time
from collections.abc import Sequence
from pathlib import Path

from client.errors import AgentFailed

LONGEST_LINE = 1024 * 1024
"""Bytes of one answer; a stroke needs two hundred."""
LEAVING_SECONDS = 2.0
"""Seconds a command gets to leave after its input is closed, and once more after SIGTERM."""
LAST_WORDS = 400
"""Characters of its standard error that an error message repeats."""


class LineProcess:
    """A running command, its standard error in a file.

    Args:
        command: program and arguments.
        errors: the file; written to at its end.

    Raises:
        AgentFailed: it cannot be started. All methods raise it when the command has left or takes too long.
    """

    def __init__(self, command: Sequence[str], errors: Path) -> None:
        self._command = list(command)
        self._errors = errors
        self._pending = b""
        self._begun_unasked = False
        try:
            with errors.open("ab") as sink:
                self._process = subprocess.Popen(
                    self._command,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=sink,
                    bufsize=0,
                    start_new_session=True,
                )
        except OSError as error:
            raise AgentFailed(f"{self._command} cannot be started: {error}") from error
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._to, self._from = self._process.stdin.fileno(), self._process.stdout.fileno()
        for end in (self._to, self._from):
            os.set_blocking(end, False)

    def send(self, line: str, deadline: float) -> None:
        """Write a line; `deadline` is of `time.monotonic`."""
        rest = memoryview(line.encode() + b"\n")
        while rest:
            self._await(self._to, select.POLLOUT, deadline, "does not read its standard input")
            try:
                rest = rest[os.write(self._to, rest) :]
            except BlockingIOError:
                continue
            except BrokenPipeError:
                raise self._left() from None

    def receive(self, deadline: float) -> str:
        """The next line, without its end."""
        while b"\n" not in self._pending:
            self._await(self._from, select.POLLIN, deadline, "gave no answer in time")
            chunk = os.read(self._from, 65536)
            if not chunk:
                raise self._left()
            self._pending += chunk
            if len(self._pending) > LONGEST_LINE:
                raise AgentFailed(f"{self._command} wrote a line of more than {LONGEST_LINE} bytes")
        line, _, self._pending = self._pending.partition(b"\n")
        if self._begun_unasked:
            self._begun_unasked = False
            return self.receive(deadline)
        return line.decode(errors="replace")

    def unasked(self) -> list[str]:
        """The lines it has written that nobody has read; they are gone then, and so is one it has only begun."""
        while len(self._pending) <= LONGEST_LINE and self._is_ready(self._from, select.POLLIN, 0.0):
            chunk = os.read(self._from, 65536)
            if not chunk:
                break
            self._pending += chunk
        *lines, self._pending = self._pending.split(b"\n")
        if self._pending:
            self._begun_unasked = True
            lines.append(self._pending)
        return [line.decode(errors="replace") for line in lines]

    def stop(self) -> None:
        """End it: its input is closed, then SIGTERM, then SIGKILL to it and what it has started."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        if self._has_left():
            self._kill()
            return
        self._process.terminate()
        self._has_left()
        self._kill()

    def _has_left(self) -> bool:
        try:
            self._process.wait(LEAVING_SECONDS)
        except subprocess.TimeoutExpired:
            return False
        return True

    def _kill(self) -> None:
        """Whatever is left of its process group."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(self._process.pid, signal.SIGKILL)
        self._process.wait()
        if self._process.stdout is not None:
            self._process.stdout.close()

    def _await(self, end: int, event: int, deadline: float, otherwise: str) -> None:
        left = deadline - time.monotonic()
        if left <= 0.0 or not self._is_ready(end, event, left):
            raise AgentFailed(f"{self._command} {otherwise}{self._words()}")

    @staticmethod
    def _is_ready(end: int, event: int, seconds: float) -> bool:
        poll = select.poll()
        poll.register(end, event)
        return bool(poll.poll(seconds * 1000.0))

    def _left(self) -> AgentFailed:
        """What to raise when it is gone, or has closed its output."""
        if not self._has_left():
            return AgentFailed(f"{self._command} closed its standard output{self._words()}")
        return AgentFailed(f"{self._command} left with exit code {self._process.returncode}{self._words()}")

    def _words(self) -> str:
        """Where its standard error is, and how that ends."""
        said = self._errors.read_text(errors="replace").strip()[-LAST_WORDS:]
        return f"; its standard error is in {self._errors}" + (f" and ends: {said}" if said else "")
