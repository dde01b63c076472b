"""A Python agent as a process: ``python -m client.arena.hosted_agents NAME [--seed N] [--options JSON]``.

Reads the messages of ``GET /v1/turns``, and ``refused``, from standard input, a JSON line each. A ``turn`` is answered
with a line on standard output: the action, and beside it ``simulated``, the shots that this process has simulated in
this game so far. What the agent prints goes to standard error, so that it cannot be taken for an answer.
"""

import argparse
import json
import os
import sys
import traceback
from functools import partial
from typing import Any, BinaryIO

from client.agent import AgentFactory
from client.agents.registry import load
from client.errors import AgentFailed, NonsenseAnswer
from client.players import Instance
from protocol import TURN_MESSAGE, GameOver, Turn, View
from referee import Action, SimulationBudget

REFUSED = b'{"type": "refused"'
"""How a line begins that says why the last action was not accepted."""
GONE = 70
"""Exit code when the command behind an agent is gone."""


def main() -> None:
    """Serve until standard input ends."""
    options = _parser().parse_args()
    find_here()
    answers = _private_output()
    factory = partial(load(options.name, options.seed), **json.loads(options.options))
    server = _LineHost(factory)
    for line in sys.stdin.buffer:
        answer = server.answer(line)
        if answer is not None:
            answers.write(json.dumps(answer).encode() + b"\n")
            answers.flush()


class _LineHost:
    """An agent's instances, one a game."""

    def __init__(self, factory: AgentFactory) -> None:
        self._factory = factory
        self._instances: dict[str, Instance] = {}
        self._asked: Instance | None = None

    def answer(self, line: bytes) -> dict[str, Any] | None:
        """What a line is answered with; None when nothing is expected."""
        if line.startswith(REFUSED):
            self._refused(str(json.loads(line)["reason"]))
            return None
        message = TURN_MESSAGE.validate_json(line)
        if isinstance(message, Turn):
            return self._turn(message)
        if isinstance(message, GameOver):
            self._over(message)
        return None

    def _turn(self, turn: Turn) -> dict[str, Any]:
        try:
            self._asked = instance = self._of(turn)
            action = instance.choose(turn.view)
            if not isinstance(action, Action):
                raise TypeError(f"choose returned {action!r}, which is no client.Action")
        except AgentFailed as error:
            traceback.print_exc()
            if not isinstance(error, NonsenseAnswer):  # the command behind it has left: so does this process
                sys.exit(GONE)
            return {"error": str(error)}
        except Exception as error:
            traceback.print_exc()
            return {"error": f"{type(error).__name__}: {error}"}
        return action.to_dict() | {"simulated": instance.budget.used}

    def _of(self, turn: Turn) -> Instance:
        instance = self._instances.setdefault(turn.game, Instance(self._factory, SimulationBudget()))
        _limit(instance.budget, turn.view)
        return instance

    def _refused(self, reason: str) -> None:
        try:
            if self._asked is not None:
                self._asked.refused(reason)
        except Exception:
            traceback.print_exc()

    def _over(self, over: GameOver) -> None:
        instance = self._instances.pop(over.game, None)
        try:
            if instance is not None:
                instance.game_over(over)
        except Exception:
            traceback.print_exc()


def _limit(budget: SimulationBudget, view: View) -> None:
    """Let the budget grant what the referee says is left, and never more than it did.

    This process may have joined in the middle of the game. Shots that it has not told of yet, because its agent
    failed after them, are still in what is left.
    """
    left = None if view.seat is None else view.clocks[view.seat].simulations_left
    if left is not None:
        granted = budget.used + left
        budget.allowed = granted if budget.allowed is None else min(budget.allowed, granted)


def find_here() -> None:
    """Find modules in the current directory too, but last: none may stand in for an installed one."""
    here = os.getcwd()  # noqa: PTH109 - as text, for the import system
    if here not in sys.path:
        sys.path.append(here)


def _private_output() -> BinaryIO:
    """Standard output for answers alone; everything else that is printed goes to standard error."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    return answers


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="python -m client.arena.hosted_agents", description="Serve an agent line by line."
    )
    parser.add_argument("name", help="as for `pooliad agent run`")
    parser.add_argument("--seed", type=int, help="makes a shipped agent repeat its choices")
    parser.add_argument("--options", default="{}", help="keyword arguments for the class, as a JSON object")
    return parser


if __name__ == "__main__":
    main()
