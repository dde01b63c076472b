"""A command that is spoken to in lines: one is written to its standard input, one is read from its output."""

import contextlib
import fcntl
import os
import select
import signal
import struct
import subprocess
import termios
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

from client.errors import AgentFailed, AgentUnstartable

LONGEST_LINE = 1024 * 1024
"""Bytes of one answer unless told; a stroke needs two hundred."""
CHUNK = 65_536
"""Bytes read at a time."""
LEAVING_SECONDS = 2.0
"""Seconds a command gets to leave after its input is closed, and once more after SIGTERM."""
LOOK_EVERY = 0.25
"""Seconds between looks whether a command that is silent still runs."""
READING_EVERY = 0.005
"""Seconds between looks whether a command that was just started has read its first line."""
LAST_WORDS = 400
"""Bytes of its standard error that an error message repeats."""


class Silent(AgentFailed):
    """It gave no answer in time, or did not read what it was told."""


class Left(AgentFailed):
    """It has ended, or closed an end of its pipes."""


class Flooded(AgentFailed):
    """It wrote more than a line may have, or more unasked."""


class LineProcess:
    """A running command.

    Args:
        command: program and arguments.
        errors: file for its standard error, written to at its end; nowhere if None.
        name: what errors call it; the command unless given.
        environment: variables beside those of this process.
        longest: bytes of a line, and of all that it writes unasked.
        own_session: whether it leads a session of its own, so that what it has started ends with it. Else both belong
            to the session of this process, and end with that.

    Raises:
        AgentUnstartable: it cannot be started. Methods raise `Silent`, `Left` and `Flooded`; all deadlines are of
            `time.monotonic`.
    """

    def __init__(
        self,
        command: Sequence[str],
        errors: Path | None,
        *,
        name: str | None = None,
        environment: Mapping[str, str] | None = None,
        longest: int = LONGEST_LINE,
        own_session: bool = True,
    ) -> None:
        self._name = name or str(list(command))
        self._errors = errors
        self._longest = longest
        self._leads = own_session
        self._pending = b""
        self._begun_unasked = False
        try:
            with Path(errors or os.devnull).open("ab") as sink:
                self._process = subprocess.Popen(
                    list(command),
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=sink,
                    env=os.environ | dict(environment or {}),
                    bufsize=0,
                    start_new_session=own_session,
                )
        except OSError as error:
            raise AgentUnstartable(f"{self._name} cannot be started: {error}") from error
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._to, self._from = self._process.stdin.fileno(), self._process.stdout.fileno()
        for end in (self._to, self._from):
            os.set_blocking(end, False)

    def send(self, line: str, deadline: float) -> None:
        """Write a line."""
        rest = memoryview(line.encode() + b"\n")
        while rest:
            left = deadline - time.monotonic()
            if left <= 0.0 or not _is_ready(self._to, select.POLLOUT, left):
                raise Silent(f"{self._name} does not read its standard input{self._words()}")
            try:
                rest = rest[os.write(self._to, rest) :]
            except BlockingIOError:
                continue
            except BrokenPipeError:
                raise self._left("input") from None

    def await_reading(self, deadline: float) -> None:
        """Wait until it has read what was sent, which shows that it runs; or until the deadline."""
        while _unread(self._to) and time.monotonic() < deadline:
            if self._process.poll() is not None:
                raise self._left()
            time.sleep(READING_EVERY)

    def receive(self, deadline: float) -> str:
        """The next line, without its end."""
        while b"\n" not in self._pending:
            self._await_output(deadline)
            self._read_more()
        line, _, self._pending = self._pending.partition(b"\n")
        if self._begun_unasked:
            self._begun_unasked = False
            return self.receive(deadline)
        return line.decode(errors="replace")

    def unasked(self, *, forbearing: bool = False) -> list[str]:
        """The lines it has written that nobody has read; they are gone then, and so is one it has only begun.

        Args:
            forbearing: of too much only the beginning is read, and `Flooded` is not raised.
        """
        while _is_ready(self._from, select.POLLIN, 0.0):
            if forbearing and len(self._pending) + CHUNK > self._longest:
                break
            if not self._has_read():  # it has closed its output: whoever speaks to it next is told
                break
        *lines, self._pending = self._pending.split(b"\n")
        if self._pending:
            self._begun_unasked = True
            lines.append(self._pending)
        return [line.decode(errors="replace") for line in lines]

    def interrupt(self) -> None:
        """Kill it and what it has started, from any thread; whoever waits for its answer sees it end."""
        with contextlib.suppress(ProcessLookupError, PermissionError):
            if self._leads:
                os.killpg(self._process.pid, signal.SIGKILL)
            else:
                self._process.kill()

    def stop(self) -> None:
        """End it: its input is closed, then SIGTERM, then SIGKILL to it and what it has started."""
        if self._process.stdin is not None:
            self._process.stdin.close()
        if not self._has_left():
            self._process.terminate()
            self._has_left()
        self.kill()

    def kill(self) -> None:
        """End it and whatever it has started, at once."""
        self.interrupt()
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                pipe.close()

    def _has_left(self) -> bool:
        try:
            self._process.wait(LEAVING_SECONDS)
        except subprocess.TimeoutExpired:
            return False
        return True

    def _await_output(self, deadline: float) -> None:
        """Wait until there is something to read.

        Its end is looked for by itself: a child that it left behind may hold its output open.
        """
        while (left := deadline - time.monotonic()) > 0.0:
            has_left = self._process.poll() is not None
            if _is_ready(self._from, select.POLLIN, 0.0 if has_left else min(left, LOOK_EVERY)):
                return
            if has_left:
                raise self._left()
        raise Silent(f"{self._name} gave no answer in time{self._words()}")

    def _read_more(self) -> None:
        if not self._has_read():
            raise self._left()

    def _has_read(self) -> bool:
        """Read a chunk; False at the end of its output."""
        chunk = os.read(self._from, CHUNK)
        self._pending += chunk
        if len(self._pending) > self._longest:
            raise Flooded(f"{self._name} wrote more than {self._longest} bytes")
        return bool(chunk)

    def _left(self, end: str = "output") -> Left:
        """What to raise when it is gone, or has closed this end."""
        if not self._has_left():
            return Left(f"{self._name} closed its standard {end}{self._words()}")
        code = self._process.returncode
        how = f"exit code {code}" if code >= 0 else f"signal {signal.Signals(-code).name}"
        return Left(f"{self._name} left with {how}{self._words()}")

    def _words(self) -> str:
        """Where its standard error is, and how that ends."""
        if self._errors is None or not self._errors.exists():
            return ""
        with self._errors.open("rb") as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - LAST_WORDS))
            said = file.read(LAST_WORDS).decode(errors="replace").strip()
        return f"; its standard error is in {self._errors}" + (f" and ends: {said}" if said else "")


def _is_ready(end: int, event: int, seconds: float) -> bool:
    """Whether a descriptor is ready within so many seconds; of any number, as `select` is not."""
    poll = select.poll()
    poll.register(end, event)
    return bool(poll.poll(seconds * 1000.0))


def _unread(end: int) -> int:
    """Bytes in a pipe that nobody has read yet."""
    return int(struct.unpack("i", fcntl.ioctl(end, termios.FIONREAD, b"\0" * 4))[0])
