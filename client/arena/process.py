"""An agent as a supervised process: it may crash, hang, flood or lie, and costs its entrant a game at most."""

import contextlib
import json
import os
import select
import signal
import subprocess
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from client.adapters.stdio import LOGS
from client.arena.confine import confined
from client.arena.cores import CoreLease
from client.arena.hosting import Hosting
from referee import Action, EndReason, SimulationBudget
from referee.play.local import Lost
from referee.record.canonical import parse
from referee.wire import GameOver, Turn, View

LONGEST_ANSWER = 65_536
"""Bytes in a line of an answer; an action has a few hundred."""
LARGEST_FILE = 2**30
"""Bytes an agent's process may write into one file, its log included: a loop that prints must not fill the disk."""
LEAVING_SECONDS = 2.0
"""How long a process gets to end when its input is closed."""
NEWS_SECONDS = 1.0
"""How long it may take to read news that needs no answer."""
LOOK_EVERY = 0.25
"""Seconds between looks whether a process that is silent still runs."""


class ProcessSeat:
    """``client.arena.serving`` at the table.

    A turn is a line ``{"type": "turn", "game": …, "view": …}`` on its standard input, as ``GET /v1/turns`` gives it;
    the answer is the action as a line on its standard output, ``simulated`` beside it if it counts simulated shots.
    ``{"type": "refused", "reason": …}`` and ``game_over`` messages are not answered.

    Args:
        hosting: the agent and its limits.
        seed: for agents of this package.
        log: where its standard error goes; nowhere if None.
        tell: told what goes wrong, in a sentence.
    """

    def __init__(self, hosting: Hosting, seed: int, log: Path | None, tell: Callable[[str], None]) -> None:
        self._hosting = hosting
        self._command = hosting.command(seed)
        self._log = log
        self._tell = tell
        self._lease = CoreLease(hosting.cores)
        self._process: subprocess.Popen[bytes] | None = None
        self._unread = b""
        self._budget = SimulationBudget()
        self._simulated = 0
        self._asked = False

    def begin(self, budget: SimulationBudget) -> None:
        """Have it run, so that it can load while the other seat does; one that failed is started again."""
        self._budget, self._simulated, self._asked = budget, 0, False
        self._require_process()

    def ask(self, view: View, seconds: float | None) -> Action:
        """Its answer to a turn."""
        limit = self._hosting.answer_seconds if seconds is None else seconds
        end = time.monotonic() + limit
        process = self._require_process()
        self._asked = True
        try:
            self._drop_stale(process)
            self._send(process, Turn(game=view.game, view=view).model_dump_json().encode() + b"\n", end)
            line = self._receive(process, end)
        except TimeoutError:
            reason = EndReason.STALL if seconds is None else EndReason.TIME_OUT
            self._stop(f"gave no answer within {limit:.1f} s and was stopped")
            raise Lost(reason) from None
        except (BrokenPipeError, EOFError):
            self._stop(f"ended ({_status(process)}) in the middle of a game")
            raise Lost(EndReason.CRASH) from None
        return self._action(line)

    def refused(self, reason: str) -> None:
        """Tell it why its answer was not accepted."""
        self._tell_if_there(json.dumps({"type": "refused", "reason": reason}))

    def over(self, message: GameOver) -> None:
        """Tell it, if it was asked in this game and still runs."""
        self._tell_if_there(message.model_dump_json())

    def interrupt(self) -> None:
        """Kill it, from any thread; whoever is waiting for its answer sees it end."""
        process = self._process
        if process is not None:
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.killpg(process.pid, signal.SIGKILL)

    def close(self) -> None:
        """End it: by the end of its input, and by force if that is not enough."""
        if self._process is not None and self._process.stdin is not None:
            with contextlib.suppress(OSError):
                self._process.stdin.close()
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(LEAVING_SECONDS)
        self._kill()
        self._lease.release()

    def _tell_if_there(self, line: str) -> None:
        """Send what needs no answer; what it does with the news is its own affair."""
        if self._process is not None and self._asked:
            with contextlib.suppress(TimeoutError, BrokenPipeError):
                self._send(self._process, line.encode() + b"\n", time.monotonic() + NEWS_SECONDS)

    def _require_process(self) -> subprocess.Popen[bytes]:
        if self._process is None:
            self._process = self._started()
            self._unread, self._simulated = b"", 0
        return self._process

    def _started(self) -> subprocess.Popen[bytes]:
        memory = self._hosting.memory_mb
        command = confined(
            self._command,
            memory=None if memory is None else memory * 2**20,
            file=LARGEST_FILE,
            cpus=self._lease.cpus,
        )
        with self._log.open("ab") if self._log else open(os.devnull, "wb") as sink:  # noqa: PTH123
            process = subprocess.Popen(
                command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=sink,
                env=os.environ | self._variables(),
                start_new_session=True,
                bufsize=0,
            )
        assert process.stdin is not None
        assert process.stdout is not None
        for pipe in (process.stdin, process.stdout):
            os.set_blocking(pipe.fileno(), False)
        return process

    def _variables(self) -> dict[str, str]:
        """What its environment has beside ours; a command's own standard error lies beside the log."""
        logs = {} if self._log is None else {LOGS: str(self._log.with_suffix(""))}
        return logs | _threads(self._hosting.cores) | dict(self._hosting.environment)

    def _drop_stale(self, process: subprocess.Popen[bytes]) -> None:
        """Throw away what it said unasked: it must not pass for the answer to this turn."""
        assert process.stdout is not None
        said, self._unread = self._unread, b""
        while more := process.stdout.read(LONGEST_ANSWER):
            said += more
            if len(said) > LONGEST_ANSWER:
                self._stop(f"said more than {LONGEST_ANSWER} bytes without being asked and was stopped")
                raise Lost(EndReason.FORFEIT)
        if said:
            self._tell(f"said {said[:60]!r} without being asked")

    def _send(self, process: subprocess.Popen[bytes], data: bytes, end: float) -> None:
        assert process.stdin is not None
        while data:
            _wait([], [process.stdin.fileno()], end)
            data = data[os.write(process.stdin.fileno(), data) :]

    def _receive(self, process: subprocess.Popen[bytes], end: float) -> bytes:
        """The next line."""
        assert process.stdout is not None
        while b"\n" not in self._unread:
            if len(self._unread) > LONGEST_ANSWER:
                self._stop(f"answered with more than {LONGEST_ANSWER} bytes and was stopped")
                raise Lost(EndReason.FORFEIT)
            _wait_for_answer(process, end)
            more = os.read(process.stdout.fileno(), LONGEST_ANSWER)
            if not more:
                raise EOFError
            self._unread += more
        line, _, self._unread = self._unread.partition(b"\n")
        return line

    def _action(self, line: bytes) -> Action:
        """What the line says; raises what ``parse`` and ``Action.from_dict`` raise."""
        answer: Any = parse(line.decode())
        if isinstance(answer, dict) and set(answer) == {"error"}:
            raise ValueError(f"the agent failed: {answer['error']}")
        if isinstance(answer, dict) and "simulated" in answer:
            self._count(answer.pop("simulated"))
        return Action.from_dict(answer)

    def _count(self, simulated: Any) -> None:
        """Charge the budget with what it says it simulated since it was asked first in this game.

        The count can only grow. It is the process's own: one that joins a game that was broken off begins at 0,
        whatever the budget has lost before.
        """
        if isinstance(simulated, bool) or not isinstance(simulated, int) or simulated < self._simulated:
            raise ValueError(f"simulated = {simulated!r}: an integer, at least {self._simulated}")
        self._budget.spend(simulated - self._simulated)
        self._simulated = simulated

    def _stop(self, what: str) -> None:
        self._tell(what)
        self._kill()

    def _kill(self) -> None:
        """End it and whatever it started in its session."""
        process, self._process = self._process, None
        if process is None:
            return
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        for pipe in (process.stdin, process.stdout):
            if pipe is not None:
                with contextlib.suppress(OSError):
                    pipe.close()


def _wait(reading: list[int], writing: list[int], end: float) -> None:
    """Wait until one of the descriptors is ready; raises ``TimeoutError`` at ``end``."""
    left = end - time.monotonic()
    if left <= 0 or not any(select.select(reading, writing, [], left)):
        raise TimeoutError


def _wait_for_answer(process: subprocess.Popen[bytes], end: float) -> None:
    """The same for the process's output; raises ``EOFError`` when it has ended without a word.

    Its end is looked for by itself: a child that it left behind may hold its output open.
    """
    assert process.stdout is not None
    output = [process.stdout.fileno()]
    while process.poll() is None:
        with contextlib.suppress(TimeoutError):
            _wait(output, [], min(end, time.monotonic() + LOOK_EVERY))
            return
        if time.monotonic() >= end:
            raise TimeoutError
    if not select.select(output, [], [], 0.0)[0]:
        raise EOFError


def _status(process: subprocess.Popen[bytes]) -> str:
    """How a process that has closed its output ended, in words."""
    try:
        code = process.wait(LEAVING_SECONDS)
    except subprocess.TimeoutExpired:
        return "its output is closed"
    return f"exit code {code}" if code >= 0 else f"signal {signal.Signals(-code).name}"


def _threads(cores: int | None) -> dict[str, str]:
    """Numerical libraries start a thread for each core they see; with a limit, for each they have."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    return {} if cores is None else dict.fromkeys(names, str(cores))
