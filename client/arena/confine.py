"""Run a command under limits: what `confined` makes is run as ``python -I -S confine.py LIMITS COMMAND ARGUMENT …``.

A program of its own, with nothing but the standard library: limits set here hold from the command's first
instruction, and the process that starts it may have threads (where code between fork and exec is not safe).
"""

import ctypes
import json
import os
import resource
import signal
import sys
from collections.abc import Sequence

PR_SET_PDEATHSIG = 1
"""Linux prctl: the signal to receive when the parent dies."""
IGNORED_BY_PYTHON = (signal.SIGPIPE, signal.SIGXFSZ)
"""Signals that the interpreter ignores from its start; what is ignored stays so in the command it becomes."""


def confined(
    command: Sequence[str],
    *,
    memory: int | None = None,
    file: int | None = None,
    cpus: Sequence[int] = (),
    orphaned: int = signal.SIGKILL,
) -> list[str]:
    """The command line that runs `command` as a child of this process under limits.

    Args:
        command: program and arguments.
        memory, file: bytes of its memory, and of any file it writes; no limit if None.
        cpus: the cores it may use; all that this process may if empty.
        orphaned: the signal it gets when this process dies (Linux).
    """
    limits = {"memory": memory, "file": file, "cpus": list(cpus), "parent": os.getpid(), "orphaned": int(orphaned)}
    return [sys.executable, "-I", "-S", __file__, json.dumps(limits), *command]


def end_with_parent(parent: int, orphaned: int) -> None:
    """Have this process sent a signal when its parent dies; end it at once if that has happened."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, orphaned, 0, 0, 0)
        if os.getppid() != parent:  # it died before the line above
            os._exit(1)


def main() -> None:
    """Set the limits, and become the command."""
    limits, command = json.loads(sys.argv[1]), sys.argv[2:]
    end_with_parent(limits["parent"], limits["orphaned"])
    if limits["cpus"]:
        os.sched_setaffinity(0, limits["cpus"])
    for kind, limit in ((resource.RLIMIT_AS, limits["memory"]), (resource.RLIMIT_FSIZE, limits["file"])):
        if limit is not None:
            resource.setrlimit(kind, (limit, limit))
    for each in IGNORED_BY_PYTHON:
        signal.signal(each, signal.SIG_DFL)
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.exit(f"{command[0]!r} cannot be run: {error}")


if __name__ == "__main__":
    main()
