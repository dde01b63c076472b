"""The running games that this process saw last: what a version fixes is not read again, nor put together again."""

from dataclasses import replace
from typing import Final

from sqlalchemy import Connection

from server.services.play.live_game import LiveGame, clock_of, find_row, read
from server.services.runtime.cache import VersionedCache

MOST_KEPT: Final = 4096
"""Games, about 40 kB each: more than a server plays at once, or each stroke would read its game anew."""


class GameCache:
    """The balls, the score and the terms change with a game's version alone; its clocks are read every time."""

    def __init__(self) -> None:
        self._latest = VersionedCache[LiveGame](MOST_KEPT, lambda live: live.row.version)

    def find(self, connection: Connection, game_id: str, *, is_committed: bool = True) -> LiveGame:
        """The game with this id, remembered where it is known to be as it was committed; raises `NotFound`."""
        known = self._latest.get(game_id)
        if known is not None and (row := clock_of(connection, known.row)) is not None:
            return replace(known, row=row)
        live = read(connection, find_row(connection, game_id))
        if is_committed:
            self.keep(live)
        return live

    def keep(self, live: LiveGame) -> None:
        """Remember a game as it was committed; one that is over is forgotten."""
        if live.is_running:
            self._latest.keep({live.id: live})
        else:
            self._latest.forget(live.id)
