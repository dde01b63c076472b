"""Places at which the process can be told to die, for tests of what a crash leaves behind.

`POOLIAD_FAILPOINT=shot-moved:3` kills the process, as `kill -9` does, when it comes to that place for the third time.
Unless the environment names one when the server starts, coming to such a place does nothing, and nothing that a
client sends changes that.
"""

import itertools
import os
import signal
from collections.abc import Callable
from typing import Final

from server.errors import SettingsError

POINTS: Final = (
    "turn-delivered",  # in the transaction that delivers a turn
    "turn-committed",  # after it, before the answer
    "shot-admitted",  # the request is checked, nothing is simulated
    "shot-simulated",  # simulated, nothing is stored
    "shot-advanced",  # in the transaction, the game is written
    "shot-moved",  # in the transaction, the move is written too
    "shot-kept",  # in the transaction, the answer is written too
    "shot-committed",  # after it, before anybody is woken
    "shot-woken",  # the players are woken, the answer is not sent
)

Failpoint = Callable[[str], None]


def parse(text: str) -> Failpoint:
    """What to call at each place: `NAME` or `NAME:TIMES`; nothing happens anywhere for an empty text.

    Raises `SettingsError` for a place that there is not.
    """
    if not text:
        return _go_on
    name, _, times = text.partition(":")
    if name not in POINTS or not (times == "" or (times.isdecimal() and int(times) > 0)):
        raise SettingsError(f"failpoint = {text!r}: must be NAME or NAME:TIMES, NAME one of {', '.join(POINTS)}")
    return _deadly(name, int(times or 1))


def _go_on(_name: str) -> None:
    """Nothing."""


def _deadly(deadly: str, times: int) -> Failpoint:
    count = itertools.count(1)  # one step of it cannot be divided between threads

    def reach(name: str) -> None:
        if name == deadly and next(count) == times:
            os.kill(os.getpid(), signal.SIGKILL)

    return reach
