"""The running games that this process saw last: what a version fixes is not read again, nor put together again."""

import threading
from collections import OrderedDict
from dataclasses import replace

from sqlalchemy import Connection

from server.services.live import LiveGame, find_row, read

KEPT = 1024
"""Games, about 20 kB each."""


class SeenGames:
    """Games by id, the ones least recently looked for forgotten first.

    The balls, the score and the terms change with a game's version alone; its clocks are read every time.
    """

    def __init__(self) -> None:
        self._games: OrderedDict[str, LiveGame] = OrderedDict()
        self._lock = threading.Lock()

    def find(self, connection: Connection, game_id: str) -> LiveGame:
        """The game as it is committed (never from a transaction that has written); raises `NotFound`."""
        row = find_row(connection, game_id)
        known = self._games.get(game_id)
        if known is not None and known.row.version == row.version:
            return replace(known, row=row)
        live = read(connection, row)
        self.keep(live)
        return live

    def keep(self, live: LiveGame) -> None:
        """Remember a game as it was committed; one that is over is forgotten."""
        with self._lock:
            self._games.pop(live.id, None)
            if live.is_running:
                self._games[live.id] = live
                while len(self._games) > KEPT:
                    self._games.popitem(last=False)
