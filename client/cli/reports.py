"""What an agent's process tells the command that started it about its bad answers: a journal, as they happen."""

import logging
import os
import traceback
from pathlib import Path
from typing import Final

from client.arena.journal import Journal

REPORTS: Final = "POOLIAD_AGENT_REPORTS"
"""Environment variable: the file in which `pooliad agent run` reports its agent's bad answers."""


class Reporter(logging.Handler):
    """Writes what sessions log (`client.session.log`) as entries: `words`, `error` in a line, its `traceback`."""

    def __init__(self, path: Path) -> None:
        super().__init__(logging.WARNING)
        self._journal = Journal(path)

    def emit(self, record: logging.LogRecord) -> None:
        """Append an entry; a full disk is no reason for the agent to fail."""
        kind = getattr(record, "kind", None)
        if kind is None:
            return
        error = record.exc_info[1] if record.exc_info else None
        fields = {
            "words": record.getMessage(),
            "error": None if error is None else f"{type(error).__name__}: {error}",
            "traceback": None if error is None else "".join(traceback.format_exception(error)),
        }
        try:
            self._journal.append(kind, **fields)
        except OSError:
            self.handleError(record)


def report_if_asked() -> None:
    """Have this process report bad answers, if the command that started it wants that."""
    if path := os.environ.get(REPORTS):
        logging.getLogger("pooliad.agent").addHandler(Reporter(Path(path)))
