"""The file of a game that goes on, from which it can be taken up."""

import json
import os
import time
from pathlib import Path
from typing import IO

from client.arena.directory import flush_folder
from referee.record.canonical import canonical, parse
from tournament import GameResult

RESULT = ".result.json"
"""Beside a record: its game's result, with the simulated shots, which no record holds."""


class Notes:
    """The file of a game that goes on: lines of its record, and how much of the budgets is spent.

    Lines are handed to the system as they come, so that they survive this process; the disk gets them when the
    game is over. A machine that loses power takes the game up some strokes earlier, with the same noise.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._file: IO[bytes] | None = None
        self.lines: list[str] = []
        self.spent = (0, 0)
        for line in _complete_lines(path):
            if line.startswith('{"spent":'):
                first, second = parse(line)["spent"]
                self.spent = first, second
            else:
                self.lines.append(line)

    def add(self, line: str, spent: tuple[int, int]) -> None:
        """Keep a line of the record."""
        text = f"{line}\n" if spent == self.spent else f"{canonical({'spent': list(spent)})}\n{line}\n"
        self.spent = spent
        file = self._opened()
        file.write(text.encode())
        file.flush()

    def finish(self, record: str, result: GameResult) -> None:
        """The game is over: put result and record in their places, the record on the disk."""
        self.close()
        self._path.with_suffix(RESULT).write_text(json.dumps(result.to_dict()), encoding="utf-8")
        with self._path.open("wb") as file:
            file.write(record.encode())
            file.flush()
            os.fsync(file.fileno())
        self._path.rename(self._path.with_suffix(".jsonl"))
        flush_folder(self._path.parent)

    def set_aside(self) -> None:
        """Begin with nothing; what there was is kept beside it."""
        self.close()
        self._path.rename(self._path.with_suffix(f".{time.time_ns()}.diverged"))
        self.lines, self.spent = [], (0, 0)

    def _opened(self) -> IO[bytes]:
        """The file, what was torn off cut away."""
        if self._file is None:
            whole = "".join(f"{line}\n" for line in _complete_lines(self._path)).encode()
            self._file = self._path.open("r+b" if self._path.exists() else "w+b")
            self._file.truncate(len(whole))
            self._file.seek(len(whole))
        return self._file

    def close(self) -> None:
        """Let go of the file; what was handed to the system stays."""
        if self._file is not None:
            self._file.close()
            self._file = None


def _complete_lines(path: Path) -> list[str]:
    """The whole lines of a file; a line that a power cut left unfinished is dropped."""
    try:
        whole = path.read_bytes().rpartition(b"\n")[0]
    except FileNotFoundError:
        return []
    lines = []
    for line in whole.split(b"\n") if whole else []:
        try:
            parse(line.decode())
        except ValueError:
            break
        lines.append(line.decode())
    return lines
