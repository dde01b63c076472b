"""A Python agent as a process: ``python -m client.arena.hosted_agents NAME [--seed N] [--options JSON]``.

Reads the messages of ``GET /v1/turns``, and ``refused``, from standard input, a JSON line each. A ``turn`` is answered
with a line on standard output: the action, and beside it ``simulated``, the shots that this process has simulated in
this game so far. What the agent prints goes to standard error, so that it cannot be taken for an answer.
"""

import argparse
import errno
import json
import os
import sys
from functools import partial
from typing import Any, BinaryIO

from client.agent import AgentFactory
from client.agents.registry import load
from client.errors import AgentFailed, NonsenseAnswer
from client.local_game import Lost, play_game
from client.session import AgentSession, GameSessions, Session
from physics import Table
from protocol import TURN_MESSAGE, GameOver, Turn, View
from referee import Action, EightBall, EndReason, NoiseModel
from referee.play import MatchSeed, nanoseconds
from referee.play.clock import Timing

REFUSED = b'{"type": "refused"'
"""How a line begins that says why the last action was not accepted."""
GONE = 70
"""Exit code when an agent cannot be asked again: its command is gone, or a file has reached the limit."""


def main() -> None:
    """Serve until standard input ends."""
    options = _parser().parse_args()
    find_here()
    answers = _private_output()
    factory = partial(load(options.name, options.seed), **json.loads(options.options))
    if options.check is not None:
        try:
            AgentSession(factory).start(_opening(options.check, Table.from_dict(json.loads(options.table))))
        except Exception as error:  # the session has shown the traceback
            sys.exit(f"{type(error).__name__}: {error}")
        return
    server = _LineHost(factory)
    for line in sys.stdin.buffer:
        answer = server.answer(line)
        if answer is not None:
            answers.write(json.dumps(answer).encode() + b"\n")
            answers.flush()


class _LineHost:
    """An agent's sessions, and the answers to the lines about them."""

    def __init__(self, factory: AgentFactory) -> None:
        self._sessions = GameSessions(factory)
        self._asked: Session | None = None

    def answer(self, line: bytes) -> dict[str, Any] | None:
        """What a line is answered with; None when nothing is expected."""
        if line.startswith(REFUSED):
            if self._asked is not None:
                self._asked.refused(str(json.loads(line)["reason"]))
            return None
        message = TURN_MESSAGE.validate_json(line)
        if isinstance(message, Turn):
            return self._turn(message)
        if isinstance(message, GameOver):
            self._sessions.over(message)
        return None

    def _turn(self, turn: Turn) -> dict[str, Any]:
        self._asked = session = self._sessions.of(turn.view)
        try:
            action = session.ask(turn.view)
        except NonsenseAnswer as error:
            return {"error": str(error)}
        except AgentFailed:  # it cannot be made, or the command behind it has left: so does this process
            sys.exit(GONE)
        except Exception as error:
            if isinstance(error, OSError) and error.errno == errno.EFBIG:
                sys.exit(GONE)  # it has filled its log or another file
            return {"error": f"{type(error).__name__}: {error}"}
        session.declared(session.undeclared)
        return action.to_dict() | {"simulated": session.budget.used}


def _opening(seconds: float, table: Table) -> View:
    """What the player who breaks sees, with so many seconds on its clock."""
    seen: list[View] = []

    def look(view: View) -> Action:
        seen.append(view)
        raise Lost(EndReason.FORFEIT)

    timing = Timing(nanoseconds(seconds), lambda: 0)
    play_game(EightBall(table), (look, look), MatchSeed.of(0).game(0), NoiseModel(1.0), timing=timing)
    return seen[0]


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
    words = "only make it and start it, in so many seconds; leaves with 1 if that fails"
    parser.add_argument("--check", type=float, metavar="SECONDS", help=words)
    parser.add_argument("--table", default='{"name": "olympiad"}', help="for --check, a JSON object")
    parser.add_argument("--options", default="{}", help="keyword arguments for the class, as a JSON object")
    return parser


if __name__ == "__main__":
    main()
