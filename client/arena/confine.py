"""Run a command under limits: ``python -I -S confine.py '{"memory": …, "cpus": […]}' COMMAND ARGUMENT …``.

A program of its own, with nothing but the standard library: limits set here hold from the command's first
instruction, and the process that starts it may have threads (where code between fork and exec is not safe).
"""

import ctypes
import json
import os
import resource
import signal
import sys

PR_SET_PDEATHSIG = 1
"""Linux prctl: the signal to receive when the parent dies."""


def main() -> None:
    """Set the limits, and become the command."""
    limits, command = json.loads(sys.argv[1]), sys.argv[2:]
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_PDEATHSIG, signal.SIGKILL, 0, 0, 0)
        if os.getppid() != limits["parent"]:  # it died before the line above
            sys.exit(1)
        if limits["cpus"]:
            os.sched_setaffinity(0, limits["cpus"])
    for kind, limit in ((resource.RLIMIT_AS, limits["memory"]), (resource.RLIMIT_FSIZE, limits["file"])):
        if limit is not None:
            resource.setrlimit(kind, (limit, limit))
    try:
        os.execvp(command[0], command)
    except OSError as error:
        sys.exit(f"{command[0]!r} cannot be run: {error}")


if __name__ == "__main__":
    main()
