"""An agent in any language: a command that reads JSON lines and writes JSON lines.

It is started once for every game. It is told `game_started`, `turn`, `refused` and `game_over`, and answers each turn
with one line: what `POST /v1/games/{id}/shots` or `/decisions` would take, and if it likes the number of the turn, so
that no answer to another one can be taken for it. Before that it may ask for the physics:
`{"ask": "min_elevation", "phi": 270}` is answered as `POST /v1/min-elevation` would be. docs/agents.md has all of it.
"""

import contextlib
import json
import logging
import os
import tempfile
import time
import weakref
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import BaseModel, ValidationError

from client.adapters.lines import Left, LineProcess
from client.agent import Agent
from client.errors import AgentFailed, AgentUnstartable, NonsenseAnswer
from physics import PhysicsError
from protocol import (
    BatchRequest,
    DecisionRequest,
    GameOver,
    MinElevationRequest,
    ShotRequest,
    SimulateRequest,
    View,
    simulations,
)
from referee import Action, RefereeError

log = logging.getLogger("pooliad.agent")

LOGS = "POOLIAD_AGENT_LOGS"
"""Environment variable: the directory for the standard error of commands. Unless it is set every game gets a temporary
one, which stays only if something was written."""
HOSTED = "POOLIAD_HOSTED"
"""Environment variable: set where this process is an event's to end, with all that it has started."""
SILENCE = 60.0
"""Seconds a command may take where no clock runs."""
SHOWN = 200
"""Characters of a bad line that an error repeats."""


class StdioAgent(Agent):
    """Plays what a command says.

    When the command leaves, is silent until the clock is out, or answers nonsense, `choose` raises `AgentFailed`;
    the next time it is asked the command is started anew, without memory of the game. A command that leaves before it
    has read a line raises `AgentUnstartable`.

    Args:
        command: program and arguments; it is started in the current directory.
        logs: directory for its standard error, a file for each game; `POOLIAD_AGENT_LOGS` unless given.
        silence: s, how long an answer may take in a game without clocks.
    """

    def __init__(self, command: Sequence[str], *, logs: Path | None = None, silence: float = SILENCE) -> None:
        self._command = tuple(command)
        self._logs = logs
        self._silence = silence
        self._turn = 0
        self._process: LineProcess | None = None
        self._stop: weakref.finalize[..., Any] | None = None
        self._tidy: weakref.finalize[..., Any] | None = None

    def game_started(self, view: View) -> None:
        """Start the command, and tell it the game."""
        given = self._logs or os.environ.get(LOGS)
        directory = Path(given or tempfile.mkdtemp(prefix="pooliad-agent-"))
        directory.mkdir(parents=True, exist_ok=True)
        self._errors = directory / f"{view.game}-seat-{view.seat}.stderr"
        if not given:
            self._tidy = weakref.finalize(self, _remove_if_empty, self._errors)
        log.info("game %s: standard error of %s is in %s", view.game, list(self._command), self._errors)
        self._running(view, time.monotonic() + self._seconds(view))

    def choose(self, view: View) -> Action:
        """The command's answer to the turn."""
        deadline = time.monotonic() + self._seconds(view)
        process = self._running(view, deadline)
        try:
            for line in process.unasked(forbearing=True):
                log.warning("game %s: %s wrote unasked: %s", view.game, list(self._command), line[:SHOWN])
            self._turn += 1
            process.send(_message("turn", turn=self._turn, game=view.game, view=_plain(view)), deadline)
            return self._answer(process, view, deadline)
        except AgentFailed:
            self._end()
            raise

    def refused(self, view: View, reason: str) -> None:
        """Tell the command why its action was not accepted; the turn follows again."""
        if self._process is not None:
            self._process.send(_message("refused", reason=reason), time.monotonic() + self._seconds(view))

    def game_over(self, over: GameOver) -> None:
        """Tell the command the result if it is still there, and let it leave."""
        if self._process is not None:
            with contextlib.suppress(AgentFailed):
                self._process.send(over.model_dump_json(), time.monotonic() + self._silence)
            self._end()
        if self._tidy is not None:
            self._tidy()

    def _running(self, view: View, deadline: float) -> LineProcess:
        """The command, started and reading if it did not run."""
        if self._process is None:
            process = self._process = LineProcess(self._command, self._errors, own_session=HOSTED not in os.environ)
            self._stop = weakref.finalize(self, process.stop)
            try:
                process.send(_message("game_started", game=view.game, view=_plain(view)), deadline)
                process.await_reading(deadline)
            except Left as error:
                self._end()
                raise AgentUnstartable(f"{error}; it had not read a line") from None
            except AgentFailed:
                self._end()
                raise
        return self._process

    def _end(self) -> None:
        if self._stop is not None:
            self._stop()
        self._process = self._stop = None

    def _seconds(self, view: View) -> float:
        left = None if view.seat is None else view.clocks[view.seat].seconds_left
        return self._silence if left is None else left

    def _answer(self, process: LineProcess, view: View, deadline: float) -> Action:
        """The action in its next line that is no question, and names no other turn."""
        while True:
            line = process.receive(deadline)
            said = _read(line)
            turn = said.pop("turn", self._turn)
            if "ask" in said:
                process.send(self._told(said, view), deadline)
            elif turn == self._turn:
                return _action(said, line)
            else:
                log.warning("game %s: %s answered another turn: %s", view.game, list(self._command), line[:SHOWN])

    def _told(self, question: dict[str, Any], view: View) -> str:
        """The answer to a question about the physics; the table is the game's unless it names another."""
        name, asked = question["ask"], {key: value for key, value in question.items() if key != "ask"}
        try:
            if not isinstance(name, str) or name not in _QUESTIONS:
                raise AgentFailed(f"ask = {name!r}: must be one of {', '.join(_QUESTIONS)}")
            model, answer = _QUESTIONS[name]
            scene = {"table": view.table, **({} if "tables" in asked else {"balls": _plain(view)["balls"]})}
            return _message("answer", **_plain(answer(self, model.model_validate(scene | asked))))
        except (AgentFailed, ValidationError, PhysicsError, RefereeError) as error:
            return _message("error", reason=str(error))


def _remove_if_empty(errors: Path) -> None:
    """Nothing was written to this file: it goes, and its directory."""
    with contextlib.suppress(OSError):
        if errors.stat().st_size:
            return
        errors.unlink()
    with contextlib.suppress(OSError):
        errors.parent.rmdir()


def _simulated(agent: Agent, request: Any) -> BaseModel:
    return simulations.simulate(request, agent.simulator.simulate)


def _batch(agent: Agent, request: Any) -> BaseModel:
    return simulations.simulate_batch(request, agent.simulator.simulate_batch)


def _elevation(_agent: Agent, request: Any) -> BaseModel:
    return simulations.min_elevation(request)


_QUESTIONS: Mapping[str, tuple[type[BaseModel], Callable[[Agent, Any], BaseModel]]] = {
    "min_elevation": (MinElevationRequest, _elevation),
    "simulate": (SimulateRequest, _simulated),
    "simulate_batch": (BatchRequest, _batch),
}


def _message(kind: str, **fields: Any) -> str:
    """A line; JSON has no line ends within."""
    return json.dumps({"type": kind} | fields, allow_nan=False)


def _plain(message: BaseModel) -> dict[str, Any]:
    plain: dict[str, Any] = message.model_dump(mode="json")
    return plain


def _read(line: str) -> dict[str, Any]:
    try:
        said = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise NonsenseAnswer(f"the command answered {line[:SHOWN]!r}, which is no JSON: {error}") from None
    if not isinstance(said, dict):
        raise NonsenseAnswer(f"answer = {line[:SHOWN]!r}: must be an object with shot or decision")
    return said


def _action(said: dict[str, Any], line: str) -> Action:
    """A stroke or a decision, as the server would take it."""
    try:
        if "decision" in said:
            return DecisionRequest.model_validate(said).to_action()
        return ShotRequest.model_validate(said).to_action()
    except (ValidationError, PhysicsError, RefereeError) as error:
        raise NonsenseAnswer(f"the command answered {line[:SHOWN]!r}: {error}") from error
