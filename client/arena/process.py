"""An agent as a supervised process: it may crash, hang, flood or lie, and costs its entrant a game at most."""

import contextlib
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from client.adapters.lines import Flooded, Left, LineProcess, Silent
from client.adapters.stdio import HOSTED, LOGS
from client.arena.confine import confined
from client.arena.cores import CoreLease
from client.arena.hosting import Hosting
from client.errors import AgentFailed
from client.local_game import Lost
from client.session import Session
from protocol import GameOver, Turn, View
from referee import Action, EndReason, SimulationBudget
from referee.record.canonical import parse

LONGEST_ANSWER = 65_536
"""Bytes in a line of an answer; an action has a few hundred."""
LARGEST_FILE = 2**30
"""Bytes an agent's process may write into one file, its log included: a loop that prints must not fill the disk."""
NEWS_SECONDS = 1.0
"""How long it may take to read news that needs no answer."""
SHOWN = 60
"""Characters of what it said unasked that a report repeats."""


class ProcessSeat(Session):
    """``client.arena.hosted_agents`` at the table.

    A turn is a line ``{"type": "turn", "game": …, "view": …}`` on its standard input, as ``GET /v1/turns`` gives it;
    the answer is the action as a line on its standard output, ``simulated`` beside it if it counts simulated shots.
    ``{"type": "refused", "reason": …}`` and ``game_over`` messages are not answered.

    Args:
        hosting: the agent and its limits.
        seed: for agents of this package.
        log: where its standard error goes; nowhere if None.
        tell: told what goes wrong, in a sentence.
        clocks: whether the game's clocks bound its answers; else `answer_seconds` of its hosting does.
    """

    def __init__(
        self, hosting: Hosting, seed: int, log: Path | None, tell: Callable[[str], None], *, clocks: bool = True
    ) -> None:
        self._hosting = hosting
        self._command = hosting.command(seed)
        self._log = log
        self._tell = tell
        self._lease = CoreLease(hosting.cores)
        self._clocks = clocks
        self._process: LineProcess | None = None
        super().begin(SimulationBudget())
        self._simulated = 0

    def begin(self, budget: SimulationBudget) -> None:
        """Have it run, so that it can load while the other seat does; one that failed is started again."""
        super().begin(budget)
        self._simulated = 0
        self._require_process()

    def ask(self, view: View) -> Action:
        """Its answer to a turn."""
        seconds = None if view.seat is None or not self._clocks else view.clocks[view.seat].seconds_left
        limit = self._hosting.answer_seconds if seconds is None else seconds
        deadline = time.monotonic() + limit
        process = self._require_process()
        self.last = view
        try:
            if said := process.unasked():  # it must not pass for the answer to this turn
                self._tell(f"said {said[0][:SHOWN]!r} without being asked")
            process.send(Turn(game=view.game, view=view).model_dump_json(), deadline)
            answer = process.receive(deadline)
        except Silent:
            self._kill(f"gave no answer within {limit:.1f} s and was stopped")
            raise Lost(EndReason.STALL if seconds is None else EndReason.TIME_OUT) from None
        except Left as error:
            self._kill(f"{error}")
            raise Lost(EndReason.CRASH) from None
        except Flooded as error:
            self._kill(f"{error} and was stopped")
            raise Lost(EndReason.FORFEIT) from None
        return self._action(answer)

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
            process.interrupt()

    def close(self) -> None:
        """End it: by the end of its input, and by force if that is not enough."""
        if self._process is not None:
            self._process.stop()
            self._process = None
        self._lease.release()

    def _tell_if_there(self, line: str) -> None:
        """Send what needs no answer; what it does with the news is its own affair."""
        if self._process is not None and self.last is not None:
            with contextlib.suppress(AgentFailed):
                self._process.send(line, time.monotonic() + NEWS_SECONDS)

    def _require_process(self) -> LineProcess:
        if self._process is None:
            self._process = self._started()
            self._simulated = 0
        return self._process

    def _started(self) -> LineProcess:
        memory = self._hosting.memory_mb
        command = confined(
            self._command,
            memory=None if memory is None else memory * 2**20,
            file=LARGEST_FILE,
            cpus=self._lease.cpus,
        )
        return LineProcess(
            command, self._log, name=self._hosting.agent, environment=self._variables(), longest=LONGEST_ANSWER
        )

    def _variables(self) -> dict[str, str]:
        """What its environment has beside ours; a command's own standard error lies beside the log."""
        logs = {} if self._log is None else {LOGS: str(self._log.with_suffix(""))}
        return {HOSTED: "1"} | logs | _threads(self._hosting.cores) | dict(self._hosting.environment)

    def _action(self, line: str) -> Action:
        """What the line says; raises what ``parse`` and ``Action.from_dict`` raise."""
        answer: Any = parse(line)
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
        self.budget.spend(simulated - self._simulated)
        self._simulated = simulated

    def _kill(self, why: str) -> None:
        """End it and whatever it started, and say why."""
        self._tell(why)
        process, self._process = self._process, None
        if process is not None:
            process.kill()


def _threads(cores: int | None) -> dict[str, str]:
    """Numerical libraries start a thread for each core they see; with a limit, for each they have."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")
    return {} if cores is None else dict.fromkeys(names, str(cores))
