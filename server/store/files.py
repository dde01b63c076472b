"""The files of an SQLite database: for their owner's eyes alone, and served by one process.

They hold the key that signs records, and the seeds of games that are being played.
"""

import fcntl
import os
import re
import stat
import sys
from pathlib import Path
from typing import Final

SUFFIXES: Final = ("", "-wal", "-shm", "-journal")
"""SQLite's files, by what is appended to the database's name: itself, its log, the log's index, a rollback journal."""
PRIVATE: Final = 0o600
OTHERS: Final = stat.S_IRWXG | stat.S_IRWXO


def create_private(path: str) -> None:
    """Create the database's file, unless it is there, readable and writable for its owner alone.

    SQLite gives the files beside it the same mode. A file that is there is not opened: closing it again would give
    back every lock that SQLite holds on it in this process (https://sqlite.org/howtocorrupt.html, 2.2).
    """
    try:
        os.close(os.open(os.path.realpath(path), os.O_RDWR | os.O_CREAT | os.O_EXCL, PRIVATE))
    except FileExistsError:
        return


def exposed(path: str) -> dict[str, str]:
    """Those of the database's files that others than the owner may read or write, each with its mode, as `0644`."""
    real = os.path.realpath(path)
    modes = {name: stat.S_IMODE(Path(name).stat().st_mode) for name in _present(real)}
    return {name: f"{mode:04o}" for name, mode in modes.items() if mode & OTHERS}


def exposure(path: str) -> str | None:
    """What to say about files that others may read, and what to do about it; None when there are none."""
    found = exposed(path)
    if not found:
        return None
    modes = ", ".join(f"{name} ({mode})" for name, mode in found.items())
    return (
        f"others may read the signing key and the seeds of running games: {modes}: must be 0600; "
        f"set it with: chmod 600 {' '.join(found)}"
    )


def free_bytes(path: str) -> int:
    """Bytes that the database's disk has left for this process."""
    disk = os.statvfs(Path(os.path.realpath(path)).parent)
    return disk.f_bavail * disk.f_frsize


def lock(path: str) -> int | None:
    """Lock the database's file for one server process; the descriptor that holds the lock, None when another has it.

    The lock belongs to the file, whatever name it was opened by, and ends with the process. On Linux it is apart from
    SQLite's own; elsewhere the two would collide, and a file beside the real one is locked instead.
    """
    create_private(path)
    real = os.path.realpath(path)
    target = real if sys.platform.startswith("linux") else f"{real}.lock"
    descriptor = os.open(target, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, PRIVATE)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        os.close(descriptor)
        return None
    return descriptor


def holder(path: str) -> str:
    """The number of the process that holds the lock, `unknown` where the system does not tell (`/proc/locks`)."""
    inode = str(Path(path).stat().st_ino)
    try:
        lines = Path("/proc/locks").read_text(encoding="ascii").splitlines()
    except OSError:
        return "unknown"
    held = re.compile(rf"\d+: FLOCK +ADVISORY +WRITE ([1-9]\d*) [0-9a-f]+:[0-9a-f]+:{inode} ")
    found = filter(None, map(held.match, lines))
    return next((match[1] for match in found), "unknown")


def _present(real: str) -> list[str]:
    return [name for suffix in SUFFIXES if Path(name := real + suffix).exists()]
